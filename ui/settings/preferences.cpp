// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/settings/preferences.h"

#include <algorithm>

#include <QSettings>

namespace pellucid::ui {

Preferences Preferences::load() {
    const QSettings settings;
    const Preferences defaults;
    Preferences p;
    p.language = settings.value("language", defaults.language).toString();
    p.theme = settings.value("theme", defaults.theme).toString() == "light" ? "light" : "dark";
    p.toolBar =
        ToolBarStyle(std::clamp(settings.value("toolBar", int(defaults.toolBar)).toInt(), 0, 2));
    p.remembersStudies = settings.value("remembersStudies", defaults.remembersStudies).toBool();
    p.resumesAtStart = settings.value("resumesAtStart", defaults.resumesAtStart).toBool();
    p.showsPatient = settings.value("showsPatientInTitle", defaults.showsPatient).toBool();
    return p;
}

void Preferences::save() const {
    QSettings settings;
    settings.setValue("language", language);
    settings.setValue("theme", theme);
    settings.setValue("toolBar", int(toolBar));
    settings.setValue("remembersStudies", remembersStudies);
    settings.setValue("resumesAtStart", resumesAtStart);
    settings.setValue("showsPatientInTitle", showsPatient);
}

} // namespace pellucid::ui
