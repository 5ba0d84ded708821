// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/classify/class_samples.h"
#include "core/classify/density_field.h"
#include "core/classify/look.h"

namespace pellucid::classify {

inline constexpr std::array<Color, 3> primaries{
    {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};

/// The fields whose projections make the picture of a look: as many as its colors have rank, each
/// times a color. Projection is linear: the sum of the fields is projected once, whatever the
/// number of classes. *Source*: Cheng 2007, eq. 32 and 34.
struct ShownFields {
    std::vector<DensityField> channels; ///< one to three
    std::array<Color, 3> colors;        ///< one for each channel
    /// Whether the picture is grey.
    bool isGrey() const { return channels.size() == 1 && colors.front() == Color{}; }
};

/// Fields of two colors as fields of red, green and blue; others as they are. *Throws*
/// Error{outOfMemory}, Cancelled.
ShownFields inPrimaries(ShownFields fields, const task::Progress &progress = {});

/// The largest number of bytes held at once while the fields of a look of this many samples are
/// made, including the result.
std::size_t peakBytes(const Look &look, std::size_t samples);

/// `runner`: may be null if no class has steps or a segment. *Throws* Error{outOfMemory},
/// Cancelled.
ShownFields shownFields(const volume::Volume &volume, const FieldWindow &window, const Look &look,
                        StepRunner *runner, const task::Progress &progress = {});

/// The field of one class without its weight and color. *Throws* Error{outOfMemory}, Cancelled.
DensityField classField(const volume::Volume &volume, const FieldWindow &window,
                        const TissueClass &tissue, StepRunner *runner,
                        const task::Progress &progress = {});

} // namespace pellucid::classify
