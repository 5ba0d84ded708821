// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

namespace pellucid::classify {

struct TissueClass;

/// The other class of a step that combines two: one of the same look, or one of the step's own.
struct Operand {
    std::string name;                         ///< of a class of the look; empty: `own`
    std::shared_ptr<const TissueClass> own{}; ///< immutable
    /// Compares own classes by content.
    bool operator==(const Operand &other) const;
};

} // namespace pellucid::classify
