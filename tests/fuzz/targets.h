// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace pellucid::fuzz {

/// Processes any bytes; it may only refuse them with task::Error.
using Target = void (*)(std::span<const std::byte> bytes);

struct NamedTarget {
    const char *name;
    Target run;
};

/// Every target; its corpus and its regressions are in folders of its name.
const std::vector<NamedTarget> &targets();

/// Creates the Qt application, whose plugins include SQLite, on the first call.
void needApplication();

} // namespace pellucid::fuzz
