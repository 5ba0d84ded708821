// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/modality_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>

namespace pellucid::dicom {

namespace {

using decoder::FrameHeader;
using decoder::InstanceHeader;
using decoder::Rescale;

// Padding must not count as tissue, but some scanners write a padding value that is also a tissue
// value (0 in a CT of signed HU). Between these bounds it counts as tissue.
constexpr double lowestTissueHu = -900.0, highestTissueHu = 4000.0;

template <class T> bool isMissing(T value) {
    if constexpr (std::is_same_v<T, float>)
        return std::isnan(value);
    else
        return value == missingValue<T>();
}

double rescaled(const InstanceHeader &h, int frame, int stored) {
    if (!h.modalityTable.empty()) {
        const int at =
            std::clamp(stored - h.modalityTableFirst, 0, int(h.modalityTable.size()) - 1);
        return h.modalityTable[std::size_t(at)];
    }
    const Rescale &r = h.frames[std::size_t(frame)].rescale;
    return r.slope * stored + r.intercept;
}

struct Padding {
    int low = 0, high = 0;
    bool holds(int stored) const { return stored >= low && stored <= high; }
};

std::optional<Padding> paddingOf(const InstanceHeader &h, volume::ValueUnit unit) {
    if (!h.paddingValue)
        return std::nullopt;
    int value = *h.paddingValue, limit = h.paddingLimit.value_or(value);
    if (h.isSigned()) { // some writers store it as unsigned
        value = value > 32767 ? value - 65536 : value;
        limit = limit > 32767 ? limit - 65536 : limit;
    }
    if (unit == volume::ValueUnit::hounsfield) {
        const double hu = rescaled(h, 0, value);
        if (hu > lowestTissueHu && hu < highestTissueHu)
            return std::nullopt;
    }
    return Padding{std::min(value, limit), std::max(value, limit)};
}

} // namespace

bool fitsInt16(const InstanceHeader &h, const ValueScale &scale) {
    if (scale.factor != 1.0)
        return false;
    if (!h.modalityTable.empty())
        return *std::max_element(h.modalityTable.begin(), h.modalityTable.end()) <= 32767;
    const double top = h.isSigned() ? std::exp2(h.bitsStored - 1) - 1 : std::exp2(h.bitsStored) - 1;
    const double bottom = h.isSigned() ? -std::exp2(h.bitsStored - 1) : 0.0;
    return std::all_of(h.frames.begin(), h.frames.end(), [&](const FrameHeader &f) {
        const Rescale &r = f.rescale;
        if (r.slope != std::round(r.slope) || r.intercept != std::round(r.intercept))
            return false;
        const double a = r.slope * bottom + r.intercept, b = r.slope * top + r.intercept;
        return scale.unit == volume::ValueUnit::hounsfield
                   ? std::abs(r.slope) == 1.0
                   : std::max(a, b) <= 32767 && std::min(a, b) >= -32767;
    });
}

template <class T>
bool writeValues(const decoder::DecodedFile &image, int frame, const ValueScale &scale, T *out,
                 volume::Narrowing &narrowing) {
    const InstanceHeader &h = image.header;
    const std::size_t plane = std::size_t(h.rows) * h.columns;
    // Read each sample once: the decoder may still change it.
    const volatile std::uint16_t *in = image.samples.data() + plane * std::size_t(frame);
    const auto padding = paddingOf(h, scale.unit);
    for (std::size_t n = 0; n < plane; ++n) {
        const std::uint16_t code = in[n];
        const int stored = h.isSigned() ? int(std::int16_t(code)) : int(code);
        if (padding && padding->holds(stored)) {
            out[n] = missingValue<T>();
            continue;
        }
        const double value = scale.factor * rescaled(h, frame, stored);
        if constexpr (std::is_same_v<T, float>)
            out[n] = narrowing.narrow(value);
        else if (std::abs(value) <= 32767.0) // the lowest code marks missing samples
            out[n] = T(value);
        else
            return false;
    }
    return true;
}

template <class T> void fillMissing(std::vector<T> &samples) {
    T lowest = std::numeric_limits<T>::max();
    bool any = false, all = true;
    for (const T v : samples)
        if (isMissing(v)) {
            any = true;
        } else {
            lowest = std::min(lowest, v);
            all = false;
        }
    if (any)
        std::replace_if(samples.begin(), samples.end(), isMissing<T>, all ? T(0) : lowest);
}

template bool writeValues(const decoder::DecodedFile &, int, const ValueScale &, std::int16_t *,
                          volume::Narrowing &);
template bool writeValues(const decoder::DecodedFile &, int, const ValueScale &, float *,
                          volume::Narrowing &);
template void fillMissing(std::vector<std::int16_t> &);
template void fillMissing(std::vector<float> &);

} // namespace pellucid::dicom
