// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace pellucid::presets {

/// A preset in resources/presets: its file name and text.
struct BuiltInFile {
    std::string name, text;
};

/// Ordered by name; names start with a number.
const std::vector<BuiltInFile> &builtInFiles();

} // namespace pellucid::presets
