// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QIcon>

#include "ui/theme/theme.h"

namespace pellucid::ui {

/// An icon of resources/icons in the colours of a theme: text where it rests, accent where it is
/// switched on, muted where it cannot be used. Sharp at any density.
QIcon themedIcon(const QString &name, const Theme &theme);

/// The commands of a window get theirs, on its tool bar alone.
void giveIcons(QObject &window, const Theme &theme);

} // namespace pellucid::ui
