// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::render {

/// What lies between the samples. `cubic` is Keys' cubic convolution with a = -1/2 (Catmull-Rom
/// along each axis of the lattice): beyond a cut face it has one negative lobe of a sample, and
/// nothing else. `linear` is what an infinitely fine trilinear ray caster shows, `bandLimited` the
/// sinc, `spline` the interpolating cubic B-spline, which rings on both sides of a cut face: +2.7 %
/// two samples away. *Source*: Keys 1981.
enum class Reconstruction { cubic, linear, bandLimited, spline };

/// What an image is, independently of how it is computed (NUMERICS of the projection: the image is
/// the integral of P(s) = D(s) prod_d K(a_d.s) t(2 pixel |s|)). Engines and the exact reference
/// share this definition and nothing else.
struct ImageDefinition {
    Reconstruction reconstruction = Reconstruction::cubic;
    /// F: the roll-off's share of the band, 0..1.
    double rollOff = 0.05;

    bool operator==(const ImageDefinition &) const = default;
};

/// t(q): 1 below 1 - F, a raised cosine down to 0 at q = 1, 0 beyond.
double rollOffFactor(double rollOff, double q);

/// K(q) of one axis, q = a_d.s in cycles per sample. linear: sinc^2 q; cubic: sinc^2 q (3 sinc^2 q
/// - 2 sinc 2q); spline: 3 sinc^4 q/(2 + cos 2 pi q); band-limited: t(2|q|).
double reconstructionFactor(const ImageDefinition &definition, double q);

/// How far a sample's footprint reaches, in samples, if it ends there: two for `cubic`, one for
/// `linear`; six for `spline`, which has fallen to 4e-4 there. The tapered sinc rings for longer.
double reconstructionReach(const ImageDefinition &definition);

/// A length that the response of a raised-cosine edge over a share F of the band has faded after,
/// in samples of that band: 4/F, and never more than 256.
double ringingPixels(double rollOff);

} // namespace pellucid::render
