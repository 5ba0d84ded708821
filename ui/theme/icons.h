// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QIcon>

#include "ui/theme/theme.h"

namespace pellucid::ui {

/// An icon from resources/icons in a theme's colors: text by default, accent when checked, muted
/// when disabled. Sharp at any pixel density.
QIcon themedIcon(const QString &name, const Theme &theme);

/// Sets the icons of a window's actions, which only the tool bar shows.
void setActionIcons(QObject &window, const Theme &theme);

} // namespace pellucid::ui
