// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error/picture_slice.h"
#include "core/scene/image_definition.h"
#include "core/volume/lattice.h"

namespace pellucid::error {

/// The energy, within the shown part of a picture, of what the grid of its slice folds back into
/// it: the tails that the roll-off leaves beyond a period. The frequencies of the grid do not
/// contain it. By stationary phase, at a distance of r pixels from a source in direction phi, the
/// tail has the energy
///   |A(phi)|^2 / (4 pi^2 r^3) g(F r),   g(x) = min(1, 1/(2 (x^2 - 1)^2)) beyond x = 1,
/// per pixel, with A the slice in the roll-off in that direction, before the roll-off, in cycles
/// per pixel. A is measured, so that a regular pattern, whose parts add up, has the tails that it
/// has. Band-limited reconstruction ends at the lattice's own band along each axis, whose tails
/// stay in a line along the projected axis: the energy |A|^2/(4 pi^2 r^2) g, summed across, per
/// pixel of the line. The sources are where the picture has fine detail. *Units*: of the picture
/// squared, times mm^2.
struct FoldedTails {
    double expected = 0.0; ///< the tails of different copies in any phase
    /// The tails of all copies, and the two waves of each, in phase, with the largest A of each
    /// direction.
    double most = 0.0;
};
FoldedTails foldedTails(const picture::PeriodPicture &period, const PictureSlice &slice,
                        const scene::ImageDefinition &image, const volume::Lattice &lattice);

} // namespace pellucid::error
