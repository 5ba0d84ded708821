// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/subtraction/rigid_registration.h"

namespace pellucid::subtraction {

/// A volume on the lattice of another: interpolated linearly where the transformed sample is within
/// it, else NaN. *Shape*: one value per sample of the lattice. *Throws* Error{outOfMemory},
/// Cancelled.
std::vector<float> resampledOnto(const volume::Lattice &lattice, const volume::Volume &volume,
                                 const RigidTransform &toVolume,
                                 const task::Progress &progress = {});

/// The factors of a weighted sum of two volumes.
struct Weights {
    static constexpr double largest = 2.0; ///< of the magnitudes
    double minuend = 1.0, subtrahend = -1.0;
    bool operator==(const Weights &) const = default;
};

/// *Throws* Error{usage} for a weight out of range.
void validate(const Weights &weights);

/// `minuend - subtrahend`, or another weighted sum, on the minuend's lattice; 0 where the
/// subtrahend is not. Values have no unit: a difference of 0 HU is not water. Volumes of 16 bits on
/// one lattice give 16 bits if the weights are whole and every value fits. *Throws* Error{usage}
/// for weights out of range, Error{unusable} if the volumes do not overlap, Error{outOfMemory},
/// Cancelled.
volume::Volume difference(const volume::Volume &minuend, const volume::Volume &subtrahend,
                          const RigidTransform &toSubtrahend = {}, const Weights &weights = {},
                          const task::Progress &progress = {});

/// A volume on the lattice of another, to check an alignment: its lowest value where it is not.
/// *Throws* as `difference`.
volume::Volume onLatticeOf(const volume::Volume &minuend, const volume::Volume &subtrahend,
                           const RigidTransform &toSubtrahend, const task::Progress &progress = {});

/// Whether the subtrahend is aligned first.
enum class Registering { none, rigid };

/// A difference and how it was made.
struct Subtraction {
    volume::Volume difference;
    std::optional<Registration> registration; ///< set if the subtrahend was aligned
    /// Not aligned, although the frames of reference differ: the volumes may not fit.
    bool needsAlignment = false;
};

/// `difference`, after `registerRigidly` if the subtrahend is aligned first. *Throws* as both.
Subtraction subtract(const volume::Volume &minuend, const volume::Volume &subtrahend,
                     Registering registering, const Weights &weights = {},
                     const task::Progress &progress = {});

} // namespace pellucid::subtraction
