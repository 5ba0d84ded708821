// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QIcon>

namespace pellucid::ui {

/// An icon from resources/icons in the colors of the current theme: text by default, accent when
/// checked, muted when disabled. Sharp at any pixel density.
QIcon themedIcon(const QString &name);

} // namespace pellucid::ui
