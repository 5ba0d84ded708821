// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/kernel_candidates.h"

#include <algorithm>
#include <optional>

#include "core/fourier/transforms/padded_size.h"

namespace pellucid::plan {

KernelCandidates::KernelCandidates(int axis, std::span<const field::Summary> fields, LinearCue cue)
    : m_cue(cue), m_samples(fields.front().support.size()[axis]), m_axis(std::size_t(axis)),
      m_fields(fields) {}

const KernelCandidate &KernelCandidates::at(const fourier::KernelChoice &choice, double padding) {
    auto &slot = m_cache[{fourier::kernelName(choice), padding}];
    if (!slot)
        slot = std::make_unique<KernelCandidate>(make(choice, padding));
    return *slot;
}

KernelCandidate KernelCandidates::make(const fourier::KernelChoice &choice, double padding) const {
    const int padded = fourier::paddedSize(m_samples, padding);
    // Small axes get more padding than they need, and the kernel may use some of it.
    const double actual = std::min(double(padded) / m_samples, std::max(2.5, padding));
    fourier::Kernel kernel = fourier::makeKernel(choice, actual);
    std::optional<fourier::MomentKernel> moment;
    if (m_cue == LinearCue::present)
        moment.emplace(kernel, double(padded) / m_samples);
    // Tilted slices make the faces of a period smaller than the product of their sides; with the
    // distance between slices, no face is too large.
    const volume::Lattice &lattice = m_fields.front().lattice;
    const double stepMm = m_axis == 2 ? lattice.sliceDistanceMm() : lattice.spacingMm(int(m_axis));
    AxisError error = axisError(kernel, padded, m_samples, stepMm);
    if (moment)
        for (const field::Summary &field : m_fields)
            addMomentError(error, kernel, *moment, padded,
                           field.slabs ? (*field.slabs)[m_axis]
                                       : field::evenSlabProducts(field.energy.axis[m_axis]));
    return {std::move(kernel), padded, std::move(error)};
}

} // namespace pellucid::plan
