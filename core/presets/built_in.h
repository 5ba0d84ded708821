// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace pellucid::presets {

/// A preset of resources/presets: its file's name and text.
struct BuiltInFile {
    std::string name, text;
};

/// In the order of their names, which begin with a number.
const std::vector<BuiltInFile> &builtInFiles();

} // namespace pellucid::presets
