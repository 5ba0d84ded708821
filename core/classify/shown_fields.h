// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/classify/tissue_class.h"

namespace pellucid::classify {

/// What of a volume is shown: its density through the transfer function, or, with any class, the
/// sum of the classes' fields by their weights, in their colours.
struct Look {
    TransferFunction transferFunction;
    std::vector<TissueClass> classes;
    bool operator==(const Look &) const = default;
};

/// *Throws* Error{usage} naming what is out of its range.
void validate(const Look &look);

/// The fields whose projections make the picture of a look: one, times a colour, or one each for
/// red, green and blue where colours mix. Projecting is linear: the sum of the fields is projected
/// once, whatever the number of classes. *Source*: Cheng 2007, eq. 32 and 34.
struct ShownFields {
    std::vector<DensityField> channels; ///< one or three
    Color color;                        ///< of a single channel
    /// Whether the picture is grey.
    bool isGrey() const { return channels.size() == 1 && color == Color{}; }
};

/// Whether the picture of a look needs three channels, and whether it has no colour at all.
bool mixesColors(const Look &look);
bool isGrey(const Look &look);

/// Bytes held at once while the fields of a look of so many samples are made, the result included.
std::size_t peakBytes(const Look &look, std::size_t samples);

/// *Throws* Error{outOfMemory}, Cancelled.
ShownFields shownFields(const volume::Volume &volume, const FieldWindow &window, const Look &look,
                        const task::Progress &progress = {});

} // namespace pellucid::classify
