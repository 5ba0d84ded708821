// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/classify/color_basis.h"
#include "core/classify/tissue_class.h"

namespace pellucid::classify {

/// An atlas of the whole body has some hundred segments.
inline constexpr std::size_t maxClasses = 1000;

/// How a volume is shown: its density through a transfer function, or, if there are classes, the
/// sum of weight times class in the colors of the classes.
struct Look {
    TransferFunction transferFunction;
    std::vector<TissueClass> classes;
    bool operator==(const Look &) const = default;
};

/// *Throws* Error{usage} naming the value that is out of range.
void validate(const Look &look);

/// Whether values alone do not decide about any of the classes: it has steps, or a segment.
bool haveRegions(const std::vector<TissueClass> &classes);

/// The classes with a nonzero weight; the others cost nothing.
std::vector<TissueClass> visibleClasses(const Look &look);

/// The basis of the visible classes' colors, with one entry of amounts per class; white if there
/// are none.
ColorBasis colorBasisOf(const Look &look);
/// The number of fields that the picture of a look needs: the rank of its colors.
std::size_t channelsOf(const Look &look);
/// Whether the picture has no color.
bool isGrey(const Look &look);

} // namespace pellucid::classify
