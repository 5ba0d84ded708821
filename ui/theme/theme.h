// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QHash>
#include <QString>

class QApplication;
class QWidget;

namespace pellucid::ui {

/// The colors of a theme by role, as resources/styles/colors.json names them.
class Theme {
public:
    /// Reads a theme of the file: "dark" or "light".
    static Theme named(const QString &name);
    /// The theme that was applied last; dark at first. Widgets that paint read it in each paint
    /// event.
    static const Theme &current();

    /// *Throws* std::logic_error for a role that the file does not have.
    QColor color(const QString &role) const;
    /// Sets palette, font and style sheet of the whole program; its widgets are painted again.
    void apply(QApplication &application) const;

private:
    QHash<QString, QColor> m_colors;
};

/// Draws a window's title bar in the current theme, where the system lets programs do so.
void matchTitleBar(const QWidget &window);

/// The background of every medical picture is black in both themes.
inline constexpr QRgb pictureBackground = qRgb(0, 0, 0);

} // namespace pellucid::ui
