// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/studies/window_presets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <QSettings>

#include "core/volume/statistics.h"

namespace pellucid::ui {

namespace {

using volume::ValueUnit;
using volume::ValueWindow;

constexpr auto listKey = "displayWindows";
constexpr std::array<std::pair<ValueUnit, const char *>, 2> unitKeys{
    {{ValueUnit::hounsfield, "HU"}, {ValueUnit::uptake, "SUV"}}};

const ValueWindow abdomen{40, 350, "Abdomen"};
const ValueWindow lowUptake{2.5, 5, "SUV 0 to 5"};

} // namespace

std::vector<WindowPreset> defaultWindowPresets() {
    return {{{50, 100, "Brain"}},
            {abdomen},
            {{25, 350, "Mediastinum"}},
            {{300, 1500, "Bone"}},
            {{-500, 1400, "Lung"}},
            {{40, 40, "Stroke"}},
            {{75, 215, "Subdural"}},
            {{300, 600, "Angiography"}},
            {lowUptake, ValueUnit::uptake},
            {{5, 10, "SUV 0 to 10"}, ValueUnit::uptake},
            {{10, 20, "SUV 0 to 20"}, ValueUnit::uptake}};
}

std::vector<WindowPreset> windowPresets() {
    QSettings settings;
    if (!settings.contains(QString(listKey) + "/size"))
        return defaultWindowPresets();
    std::vector<WindowPreset> presets;
    const int count = std::min(settings.beginReadArray(listKey), int(maxWindowPresets));
    for (int n = 0; n < count; ++n) {
        settings.setArrayIndex(n);
        const double center = settings.value("center").toDouble(),
                     width = settings.value("width").toDouble();
        const std::string name = settings.value("name").toString().toStdString();
        const QString unit = settings.value("unit").toString();
        const auto known = std::find_if(unitKeys.begin(), unitKeys.end(),
                                        [&](const auto &key) { return unit == key.second; });
        if (std::isfinite(center) && std::isfinite(width) && width > 0.0 && !name.empty() &&
            known != unitKeys.end())
            presets.push_back({{center, width, name}, known->first});
    }
    settings.endArray();
    return presets;
}

void storeWindowPresets(const std::vector<WindowPreset> &presets) {
    QSettings settings;
    settings.remove(listKey);
    if (presets == defaultWindowPresets())
        return;
    settings.beginWriteArray(listKey, int(presets.size()));
    for (std::size_t n = 0; n < presets.size(); ++n) {
        const WindowPreset &preset = presets[n];
        settings.setArrayIndex(int(n));
        settings.setValue("name", QString::fromStdString(preset.window.name));
        settings.setValue("center", preset.window.center);
        settings.setValue("width", preset.window.width);
        settings.setValue("unit", QString::fromUtf8(volume::unitName(preset.unit).data()));
    }
    settings.endArray();
}

ValueWindow automaticWindow(const volume::Volume &volume) {
    const auto q = volume::quantiles(volume, {0.005, 0.995});
    return {0.5 * (q[0] + q[1]), std::max(q[1] - q[0], 1e-6), "Auto", volume.notes().darkIsHigh};
}

ValueWindow initialWindow(const volume::Volume &volume) {
    const auto shown = [&](ValueWindow window) {
        window.isInverted = volume.notes().darkIsHigh;
        return window;
    };
    // The windows that PET scanners write are rarely those that readers use.
    if (volume.unit() == ValueUnit::uptake)
        return shown(lowUptake);
    if (!volume.notes().windows.empty()) {
        ValueWindow window = volume.notes().windows.front();
        if (window.name.empty())
            window.name = "File";
        return shown(window);
    }
    if (volume.unit() == ValueUnit::hounsfield)
        return shown(abdomen);
    return automaticWindow(volume);
}

} // namespace pellucid::ui
