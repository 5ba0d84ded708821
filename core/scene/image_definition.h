// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::scene {

/// The interpolation between samples. `cubic` is Keys' cubic convolution with a = -1/2 (Catmull-Rom
/// along each axis of the lattice); beyond a cut face it has a single negative lobe, one sample
/// wide. `linear` is the limit of a trilinear ray caster as its steps become finer. `bandLimited`
/// is the sinc. `spline` is the interpolating cubic B-spline; it rings on both sides of a cut face,
/// by +2.7 % two samples away. The shader shaders/lib/factors.glsl has the same order. *Source*:
/// Keys 1981.
enum class Reconstruction { cubic, linear, bandLimited, spline };

/// The definition of an image, independent of the method that computes it: the projection's
/// spectrum is P(s) = D(s) prod_d K(a_d.s) t(2 pixel |s|) H(|s|). Engines and the exact reference
/// share this definition and nothing else.
struct ImageDefinition {
    Reconstruction reconstruction = Reconstruction::cubic;
    /// F, the share of the band in which the roll-off falls, 0..1.
    double rollOff = 0.05;
    /// A, 0 to `maxDetail`: amplifies structures finer than `detailMm`, see `detailFactor`.
    double detail = 0.0;
    double detailMm = 2.0;

    bool operator==(const ImageDefinition &) const = default;
};

inline constexpr double maxDetail = 4.0;
/// The size of detail for a volume of this radius: 2 mm, or less for a small one.
double defaultDetailMm(double radiusMm);

/// H = 1 + A u/(1 + u), u = (2 pi r |s|)^2: the image plus A times its difference from a smoothed
/// one. From 1 for large structures to 1 + A for fine ones. *Units*: r (`detailMm`): mm, |s|
/// (`perMm`): cycles per mm.
double detailFactor(const ImageDefinition &definition, double perMm);
/// By how much the factor can raise a relative error: it is nowhere below 1.
double detailGain(const ImageDefinition &definition);

/// t(q): 1 below q = 1 - F, then a raised cosine that falls to 0 at q = 1, then 0.
double rollOffFactor(double rollOff, double q);

/// K(q) for one axis, with q = a_d.s in cycles per sample. linear: sinc^2 q; cubic: sinc^2 q
/// (3 sinc^2 q - 2 sinc 2q); spline: 3 sinc^4 q/(2 + cos 2 pi q); bandLimited: t(2|q|).
double reconstructionFactor(const ImageDefinition &definition, double q);

/// The radius of a sample's footprint: two for `cubic` and one for `linear`, where the footprint
/// ends; six for `spline`, where it has fallen to 4e-4; 2/F, at most 128, for `bandLimited`, whose
/// tapered sinc rings farther. *Units*: samples.
double reconstructionReach(const ImageDefinition &definition);

} // namespace pellucid::scene
