// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <QString>

namespace pellucid::ui {

/// Translates the names of built-in presets, classes and windows; other names are shown as they
/// are: `shownText`.
QString translatedName(const std::string &english);

} // namespace pellucid::ui
