// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <QString>

namespace pellucid::ui {

/// The names of presets, classes and windows that come with the program; others stay as they are.
QString translatedName(const std::string &english);

} // namespace pellucid::ui
