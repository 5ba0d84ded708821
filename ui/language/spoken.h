// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <QString>

namespace pellucid::ui {

/// What the core says in English, in the user's language: reasons and warnings, with the names and
/// numbers in them, also where one stands within another. What is not known stays as it is.
QString spoken(const QString &english);
QString spoken(const std::string &english);

/// The names of presets, classes and windows that come with the program; others stay as they are.
QString spokenName(const std::string &english);

} // namespace pellucid::ui
