// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace pellucid::ui {

/// What the buttons of the tool bar show.
enum class ToolBarStyle { icons, words, both };

/// Choices for the whole program, stored in the user's settings.
struct Preferences {
    QString language; ///< "en", "zh_TW"; empty: the system's
    QString theme = "dark";
    ToolBarStyle toolBar = ToolBarStyle::icons;
    /// Stores opened paths and the last session.
    bool remembersStudies = true;
    /// Reopens the last session at startup; otherwise, the start page offers it.
    bool resumesAtStart = false;
    /// Off by default: window titles are visible to other people and programs.
    bool showsPatient = false;

    bool operator==(const Preferences &) const = default;

    static Preferences load();
    void save() const;
};

} // namespace pellucid::ui
