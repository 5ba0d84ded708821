// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>

namespace pellucid::ui {

/// Names a widget and gives it the background of a panel (role "panel" in the style sheet).
inline void setPanelBackground(QWidget &widget, const QString &name) {
    widget.setObjectName(name);
    widget.setProperty("role", "panel");
    // QWidget subclasses draw no background of a style sheet without it.
    widget.setAttribute(Qt::WA_StyledBackground);
}

} // namespace pellucid::ui
