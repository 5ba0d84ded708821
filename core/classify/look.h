// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/classify/tissue_class.h"

namespace pellucid::classify {

/// More are not told apart, and each may cost a spectrum.
inline constexpr std::size_t mostClasses = 64;

/// What of a volume is shown: its density through a transfer function; or, if there are any, the
/// sum of weight times class in the colours of the classes.
struct Look {
    TransferFunction transferFunction;
    std::vector<TissueClass> classes;
    bool operator==(const Look &) const = default;
};

/// *Throws* Error{usage} naming what is out of its range.
void validate(const Look &look);

/// The classes with a weight: the others cost nothing.
std::vector<TissueClass> visibleClasses(const Look &look);

/// Whether the picture of a look needs three channels, and whether it has no colour at all.
bool mixesColors(const Look &look);
bool isGrey(const Look &look);

} // namespace pellucid::classify
