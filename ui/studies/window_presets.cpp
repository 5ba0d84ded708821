// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/studies/window_presets.h"

#include <algorithm>

#include "core/volume/statistics.h"

namespace pellucid::ui {

std::vector<WindowPreset> windowPresets(const volume::Volume &volume) {
    if (volume.unit() != volume::ValueUnit::hounsfield)
        return {};
    return {{{50, 100, "Brain"}, 1},
            {{40, 350, "Abdomen"}, 2},
            {{25, 350, "Mediastinum"}, 3},
            {{300, 1500, "Bone"}, 4},
            {{-500, 1400, "Lung"}, 5}};
}

volume::ValueWindow automaticWindow(const volume::Volume &volume) {
    const auto q = volume::quantiles(volume, {0.005, 0.995});
    return {0.5 * (q[0] + q[1]), std::max(q[1] - q[0], 1e-6), "Auto"};
}

volume::ValueWindow initialWindow(const volume::Volume &volume) {
    if (!volume.notes().windows.empty()) {
        volume::ValueWindow window = volume.notes().windows.front();
        if (window.name.empty())
            window.name = "File";
        return window;
    }
    if (volume.unit() == volume::ValueUnit::hounsfield)
        return windowPresets(volume)[1].window;
    return automaticWindow(volume);
}

} // namespace pellucid::ui
