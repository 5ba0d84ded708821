// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/modality_values.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <type_traits>

namespace pellucid::dicom {

namespace {

using decoding::FrameHeader;
using decoding::InstanceHeader;
using decoding::Rescale;

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
    int low = 1, high = 0; // none
    bool holds(int stored) const { return stored >= low && stored <= high; }
};

Padding paddingOf(const InstanceHeader &h, volume::ValueUnit unit) {
    if (!h.paddingValue)
        return {};
    int value = *h.paddingValue, limit = h.paddingLimit.value_or(value);
    if (h.isSigned()) { // some writers store it as unsigned
        value = value > 32767 ? value - 65536 : value;
        limit = limit > 32767 ? limit - 65536 : limit;
    }
    if (unit == volume::ValueUnit::hounsfield) {
        const double hu = rescaled(h, 0, value);
        if (hu > lowestTissueHu && hu < highestTissueHu)
            return {};
    }
    return {std::min(value, limit), std::max(value, limit)};
}

// A whole slope and intercept, small enough for 32-bit arithmetic on 16-bit codes.
struct WholeRescale {
    std::int32_t slope = 1, intercept = 0;
};
std::optional<WholeRescale> wholeRescale(const InstanceHeader &h, int frame, double factor) {
    const Rescale &r = h.frames[std::size_t(frame)].rescale;
    const bool isWhole = h.modalityTable.empty() && factor == 1.0 &&
                         r.slope == std::round(r.slope) && std::abs(r.slope) <= 0x1p14 &&
                         r.intercept == std::round(r.intercept) && std::abs(r.intercept) <= 0x1p29;
    return isWhole ? std::optional(WholeRescale{int(r.slope), int(r.intercept)}) : std::nullopt;
}

// The values of most CT and MR files. False if one does not fit.
bool writeWhole(std::span<const std::uint16_t> in, bool isSigned, const Padding &padding,
                const WholeRescale &rescale, std::int16_t *out) {
    std::array<std::uint16_t, 4096> codes;
    // Pointers and masks, so that compilers make vector code: a third less time.
    std::uint16_t *const code = codes.data();
    const std::int32_t flip = isSigned ? 0x8000 : 0; // extends the sign
    while (!in.empty()) {
        const std::size_t count = std::min(in.size(), codes.size());
        // The decoder may still change the samples, so each is read once, into a copy.
        std::memcpy(code, in.data(), count * sizeof(std::uint16_t));
        std::atomic_signal_fence(std::memory_order_seq_cst);
        std::int32_t misfits = 0;
        for (std::size_t n = 0; n < count; ++n) {
            const std::int32_t stored = (code[n] ^ flip) - flip,
                               value = rescale.slope * stored + rescale.intercept;
            const std::int32_t isPadding =
                -std::int32_t(unsigned(stored >= padding.low) & unsigned(stored <= padding.high));
            // The lowest code marks missing samples.
            misfits |=
                ~isPadding & -std::int32_t(unsigned(value < -32767) | unsigned(value > 32767));
            out[n] =
                std::int16_t((value & ~isPadding) | (missingValue<std::int16_t>() & isPadding));
        }
        if (misfits != 0)
            return false;
        in = in.subspan(count);
        out += count;
    }
    return true;
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
bool writeValues(const decoding::DecodedFile &image, int frame, const ValueScale &scale, T *out,
                 volume::Narrowing &narrowing) {
    const InstanceHeader &h = image.header;
    const std::size_t plane = std::size_t(h.rows) * h.columns;
    const auto frameSamples = image.samples.subspan(plane * std::size_t(frame), plane);
    const Padding padding = paddingOf(h, scale.unit);
    if constexpr (std::is_same_v<T, std::int16_t>)
        if (const auto rescale = wholeRescale(h, frame, scale.factor))
            return writeWhole(frameSamples, h.isSigned(), padding, *rescale, out);
    // Read each sample once: the decoder may still change it.
    const volatile std::uint16_t *in = frameSamples.data();
    for (std::size_t n = 0; n < plane; ++n) {
        const std::uint16_t code = in[n];
        const int stored = h.isSigned() ? int(std::int16_t(code)) : int(code);
        if (padding.holds(stored)) {
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
    constexpr T none = std::numeric_limits<T>::max();
    T lowest = none;
    std::size_t missing = 0;
    for (const T v : samples) {
        const bool is = isMissing(v);
        missing += std::size_t(is);
        if constexpr (std::is_integral_v<T>)
            lowest = std::min<T>(lowest, T(v ^ -T(is))); // the lowest turns into the largest
        else
            lowest = std::min(lowest, is ? none : v);
    }
    if (missing > 0)
        std::replace_if(samples.begin(), samples.end(), isMissing<T>,
                        missing == samples.size() ? T(0) : lowest);
}

template bool writeValues(const decoding::DecodedFile &, int, const ValueScale &, std::int16_t *,
                          volume::Narrowing &);
template bool writeValues(const decoding::DecodedFile &, int, const ValueScale &, float *,
                          volume::Narrowing &);
template void fillMissing(std::vector<std::int16_t> &);
template void fillMissing(std::vector<float> &);

} // namespace pellucid::dicom
