// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "core/picture/projection_image.h"
#include "core/scene/tone.h"

namespace pellucid::picture {

/// The two image values that a tone maps to black and white.
struct ToneRange {
    double low = 0.0, high = 1.0;
    bool operator==(const ToneRange &) const = default;
};

/// Multi-scale contrast as digital radiography applies it: the picture is split into bands of
/// structures by size; those of fine structures are amplified, strong ones less than weak ones, and
/// those of large structures are weakened. *Source*: Vuylsteke and Schoeters 1994.
struct Contrast {
    double detail = 0.0, latitude = 0.0;
    /// The brightness of the thickest part, which amplitudes are compared with; *units*: image.
    double bright = 1.0;
    /// The image value that compression leaves unchanged.
    double middle = 0.0;
    double fineMm = 2.0; ///< see scene::Exposure

    bool isOff() const { return detail <= 0.0 && latitude <= 0.0; }
    bool operator==(const Contrast &) const = default;
};

/// How image values become grey: contrast, then the range, then x^exponent.
struct Display {
    ToneRange range;
    bool inverted = false;
    double exponent = 1.0;
    Contrast contrast;
    /// The image value of air, which is black. Up to `airFade` above it, pixels fade to black;
    /// 0: they do not.
    double air = 0.0, airFade = 0.0;
    bool operator==(const Display &) const = default;
};

/// The display of a tone for a line of sight. The ends of the range are the user's where set.
/// *Requires*: the tone has an exposure.
Display displayOf(const scene::Tone &tone, const glm::dquat &orientation);
/// The same without contrast processing, so that grey is linear in the image values.
Display plainDisplayOf(const scene::Tone &tone, const glm::dquat &orientation);

} // namespace pellucid::picture
