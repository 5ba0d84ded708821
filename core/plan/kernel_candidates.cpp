// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/kernel_candidates.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "core/fourier/transforms/padded_size.h"

namespace pellucid::plan {

KernelCandidates::KernelCandidates(int axis, std::span<const FieldSummary> fields, LinearCue cue)
    : m_cue(cue), m_samples(fields.front().support.size()[axis]), m_axis(std::size_t(axis)),
      m_fields(fields), m_folded((std::size_t(m_samples) + 3) / 2, 0.0) {
    for (const FieldSummary &field : fields)
        for (int n = 0; n < m_samples; ++n)
            m_folded[std::size_t(std::abs(n - m_samples / 2))] +=
                field.energy.axis[m_axis][std::size_t(n)] / double(fields.size());
}

const KernelCandidate &KernelCandidates::at(const fourier::KernelChoice &choice, double padding) {
    auto &slot = m_cache[{fourier::kernelName(choice), padding}];
    if (!slot)
        slot = std::make_unique<KernelCandidate>(make(choice, padding));
    return *slot;
}

KernelCandidate KernelCandidates::make(const fourier::KernelChoice &choice, double padding) const {
    const int padded = fourier::paddedSize(m_samples, padding);
    // Small axes get more padding than they need, and the kernel may use it. Kernels with the least
    // aliasing are made for a field that leaves some margin.
    const double actual = std::clamp(double(padded) / m_samples, 1.05, std::max(2.5, padding));
    auto kernel = fourier::makeKernel(choice, actual, m_folded);
    std::optional<fourier::MomentKernel> moment;
    if (m_cue == LinearCue::present)
        moment.emplace(kernel, double(padded) / m_samples);
    // The worst of the fields; block amplitudes depend on the kernel only.
    AxisError error;
    for (const FieldSummary &field : m_fields) {
        AxisError e = axisError(kernel, padded, field.energy.axis[m_axis]);
        if (moment)
            addMomentError(e, kernel, *moment, padded,
                           field.slabs ? (*field.slabs)[m_axis]
                                       : evenSlabProducts(field.energy.axis[m_axis]));
        e.brightest = std::max(error.brightest, e.brightest);
        e.moment = std::max(error.moment, e.moment);
        e.brightestMoment = std::max(error.brightestMoment, e.brightestMoment);
        error = std::move(e);
    }
    return {std::move(kernel), padded, std::move(error)};
}

} // namespace pellucid::plan
