// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace pellucid::ui {

/// What stands on the buttons of the tool bar.
enum class ToolBarStyle { icons, words, both };

/// What a person chooses once for the whole program; kept in the user's settings.
struct Preferences {
    QString language; ///< "en", "zh_TW"; empty: the system's
    QString theme = "dark";
    ToolBarStyle toolBar = ToolBarStyle::icons;
    /// Paths that were opened, and what was open last.
    bool remembersStudies = true;
    /// The start begins with what was open last; else it offers it.
    bool resumesAtStart = false;
    /// Off by default: titles are seen by others, and by other programs.
    bool showsPatient = false;

    bool operator==(const Preferences &) const = default;

    static Preferences load();
    void save() const;
};

} // namespace pellucid::ui
