// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/density_field.h"

namespace pellucid::shading {

/// The gradient at a sample, per `stepMm` of distance, LPS: stepMm times the sum over d of b_d
/// times the central difference along d, where the b_d are the rows of the inverse of the matrix
/// with columns a_d. The field is zero outside its lattice. *Shape*: n within the lattice, or one
/// sample beyond.
glm::dvec3 gradientAt(const volume::Field &field, const volume::VoxelIndex &n, double stepMm);

/// A field on a lattice that is larger by one sample on every side, with the same centre, so that
/// its gradient fits.
classify::DensityField grown(const classify::DensityField &field);
/// Whether the gradient's support is within the field's lattice.
bool holdsGradient(const classify::DensityField &field);

/// |gradientAt| of every sample, on the field's own lattice, which must contain it: an upper bound
/// on the gradient along any direction. *Throws* Error{outOfMemory}, Cancelled. *Source*: Totsuka
/// 1993, eq. 10 and 11.
classify::DensityField gradientMagnitude(const classify::DensityField &field, double stepMm,
                                         const task::Progress &progress = {});

} // namespace pellucid::shading
