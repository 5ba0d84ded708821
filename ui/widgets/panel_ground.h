// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>

namespace pellucid::ui {

/// Names a widget and gives it the ground of a panel (role "panel" in the style sheet).
inline void groundAsPanel(QWidget &widget, const QString &name) {
    widget.setObjectName(name);
    widget.setProperty("role", "panel");
    widget.setAttribute(Qt::WA_StyledBackground); // a QWidget of our own has none otherwise
}

} // namespace pellucid::ui
