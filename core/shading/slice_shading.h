// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/shading/shading.h"
#include "core/volume/lattice.h"

namespace pellucid::shading {

/// The scale of cue and light. It is that of the volume's whole lattice, whatever part or coarser
/// copy is rendered.
struct ShadingScale {
    double radiusMm = 1.0; ///< R, see Lattice::radiusMm
    double stepMm = 1.0;   ///< the shortest step
};
/// The scale of a volume's own lattice.
ShadingScale shadingScale(const volume::Lattice &lattice);

/// The shading of one view as operations on slices of the spectra of f and of |g|:
///   d(x) = slope (W.x) + sum over terms of weight exp(-i 2 pi offset (W.x))
/// Every term is a slice, `offset` from the central one along W. The image of channel c is that of
///   d (ambient_c f + magnitude_c |g| + gradient_c . (stepMm grad f)).
/// *Source*: Totsuka 1993, eq. 3 to 5, 11 and section 3.1 on sine waves.
struct SliceShading {
    struct Term {
        double offset; ///< cycles per mm
        std::complex<double> weight;
    };
    struct Channel {
        double ambient = 1.0, magnitude = 0.0;
        glm::dvec3 gradient{0.0}; ///< LPS
        bool operator==(const Channel &) const = default;
    };
    std::vector<Term> terms{{0.0, 1.0}};
    double slope = 0.0; ///< 1/mm
    std::array<Channel, 3> channels;

    /// Whether it leaves f unchanged.
    bool isPlain() const;
    /// Whether all channels are the same.
    bool isGrey() const;
};

/// The shading in the view of a camera. *Shape*: axes are its [U V W].
SliceShading sliceShading(const Shading &shading, const glm::dmat3 &axes,
                          const ShadingScale &scale);

} // namespace pellucid::shading
