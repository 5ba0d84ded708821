// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace pellucid::fuzz {

/// What is done with any bytes: it may refuse them with task::Error, and nothing else.
using Target = void (*)(std::span<const std::byte> bytes);

struct NamedTarget {
    const char *name;
    Target run;
};

/// Every target; its corpus and its regressions lie in folders of its name.
const std::vector<NamedTarget> &targets();

/// Qt's, whose plugins have SQLite; made once.
void needApplication();

} // namespace pellucid::fuzz
