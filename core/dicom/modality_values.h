// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/decoding/client/decoder.h"
#include "core/volume/narrowing.h"

namespace pellucid::dicom {

// Converts stored values to modality values such as HU, by the rescale or the modality table of
// each file. A volume's samples are of type T, int16 or float.

/// The unit of a volume's values, and the factor that converts the files' values to it.
struct ValueScale {
    volume::ValueUnit unit = volume::ValueUnit::none;
    double factor = 1.0;
};

/// Marks samples that have no value: padding, and slices that have not arrived.
template <class T> constexpr T missingValue() {
    return std::numeric_limits<T>::has_quiet_NaN ? std::numeric_limits<T>::quiet_NaN()
                                                 : std::numeric_limits<T>::lowest();
}

/// Whether the values of a file probably fit int16 without loss. HU hardly ever use the full 16
/// bits that their header declares, so int16 is tried.
bool fitsInt16(const decoding::InstanceHeader &header, const ValueScale &scale);

/// Writes the values of one frame; padding becomes `missingValue`. False if a value does not fit T;
/// `out` is then partly written. *Shape*: out: rows x columns.
template <class T>
bool writeValues(const decoding::DecodedFile &image, int frame, const ValueScale &scale, T *out,
                 volume::Narrowing &narrowing);

/// Replaces missing values by the lowest other value, or by 0 if there is none.
template <class T> void fillMissing(std::vector<T> &samples);

} // namespace pellucid::dicom
