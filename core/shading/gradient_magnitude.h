// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/density_field.h"

namespace pellucid::shading {

/// The gradient at a sample, per `stepMm` of way, LPS: with a_d as the columns of a matrix and b_d
/// the rows of its inverse, stepMm sum over d of b_d times the central difference along d; the
/// field is zero outside its lattice. *Shape*: n within the lattice, or one sample beyond.
glm::dvec3 gradientAt(const volume::Volume &field, const volume::VoxelIndex &n, double stepMm);

/// A field on a lattice that is larger by one sample on every side, about the same centre, so that
/// its gradient has room.
classify::DensityField grown(const classify::DensityField &field);
/// Whether the gradient's support lies within the field's lattice.
bool holdsGradient(const classify::DensityField &field);

/// |gradientAt| of every sample, on the field's own lattice, which must hold it: nowhere is the
/// gradient along any direction longer. *Throws* Error{outOfMemory}, Cancelled.
/// *Source*: Totsuka 1993, eq. 10 and 11.
classify::DensityField gradientMagnitude(const classify::DensityField &field, double stepMm,
                                         const task::Progress &progress = {});

} // namespace pellucid::shading
