// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::render {

/// What lies between the samples. `linear` is what an infinitely fine trilinear ray caster shows,
/// `cubic` the interpolating cubic B-spline, `bandLimited` the sinc.
enum class Reconstruction { cubic, linear, bandLimited };

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

/// K(q) of one axis, q = a_d.s in cycles per sample. linear: sinc^2; cubic: 3 sinc^4/(2 + cos 2 pi
/// q); band-limited: t(2|q|).
double reconstructionFactor(const ImageDefinition &definition, double q);

} // namespace pellucid::render
