// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "core/field/summary.h"
#include "core/plan/error_prediction.h"

namespace pellucid::plan {

/// A kernel for one axis of a layout, and its error.
struct KernelCandidate {
    fourier::Kernel kernel;
    int padded; ///< size of the padded axis, samples
    AxisError error;
};

/// Whether the fields are rendered with a linear depth cue, which needs moment kernels.
enum class LinearCue { none, present };

/// The kernels of one axis by choice and padding. Making one takes milliseconds, so each is made on
/// first use.
class KernelCandidates {
public:
    /// *Requires*: the fields outlive this object.
    KernelCandidates(int axis, std::span<const field::Summary> fields, LinearCue cue);

    /// The kernel of a choice for at least this padding, with the error of the worst field.
    const KernelCandidate &at(const fourier::KernelChoice &choice, double padding);

private:
    KernelCandidate make(const fourier::KernelChoice &choice, double padding) const;

    LinearCue m_cue;
    int m_samples;
    std::size_t m_axis;
    std::span<const field::Summary> m_fields;
    std::map<std::pair<std::string, double>, std::unique_ptr<KernelCandidate>> m_cache;
};

} // namespace pellucid::plan
