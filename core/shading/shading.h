// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/classify/tissue_class.h"
#include "core/task/reasons.h"

namespace pellucid::shading {

/// The shape of a depth cue. For a new kind, the compiler names the switches that lack it. Its word
/// is in `cueFromText` and in shading_json_nlohmann.cpp, its choice in ui/panels/shading_panel.cpp.
enum class CueKind {
    none,
    linear, ///< d = 1 + S t
    sine,   ///< d = 1 + S sin(pi/2 t)
    curve   ///< d = 1 + S (c(t) - 1), c through given values
};

/// The weight d at depth t = (W.x)/R: -1 at the far end of every view of the volume, +1 at the near
/// end; x from the centre of rotation, R the lattice's radius. *Source*: Totsuka 1993, 3.1.
struct DepthCue {
    CueKind kind = CueKind::none;
    double strength = 1.0; ///< S, 0..1
    /// For a curve: c at evenly spaced depths, far end first. It is interpolated by the sum of
    /// cosines c_k cos(k pi (t + 1)/2) through all values, where k is less than their number.
    std::vector<double> curve{1.0, 1.0, 1.0};
    bool operator==(const DepthCue &) const = default;

    /// Whether it changes anything.
    bool isActive() const;
    /// Whether it is active and linear: the slice then needs the moments of the spectrum.
    bool hasMoments() const { return isActive() && kind == CueKind::linear; }
    /// d at a depth, which may lie beyond the volume.
    double at(double t) const;
};

/// DepthCue::at, prepared for many depths.
std::function<double(double t)> cueFunction(const DepthCue &cue);

/// The number of values of a curve, which are 0 to 2. A curve costs up to twice as many slices.
inline constexpr std::size_t minCurveValues = 2, maxCurveValues = 8;
inline constexpr double largestCurveValue = 2.0;

/// The coefficients c_k of the cosines through the values of a curve. *Shape*: at least two values.
std::vector<double> cosinesOf(const std::vector<double> &values);

/// The frame of reference of a light's direction.
enum class LightFrame {
    viewer, ///< right, up, toward the viewer
    patient ///< LPS
};

/// A hemisphere of light with its pole in a direction: surfaces facing it get all of the light,
/// surfaces facing away none, perpendicular ones half. *Source*: Totsuka 1993, eq. 8 to 11.
struct Light {
    glm::dvec3 direction{0.0, 0.0, 1.0}; ///< towards the light, not zero; its length is ignored
    classify::Color color;
    double strength = 1.0; ///< 0..1
    LightFrame frame = LightFrame::viewer;
    bool operator==(const Light &) const = default;
};

inline constexpr std::size_t maxLights = 8;
inline constexpr double largestAmbient = 2.0;

/// Depth cue and lighting: the field f becomes
///   d (A f + sum over lights of S color 1/2 (|g| - g.L))
/// where g is the gradient of f per shortest step (`gradientMagnitude`). Without cue and lights and
/// with A = 1 it is f itself, at no cost.
struct Shading {
    DepthCue cue;
    double ambient = 1.0; ///< A, 0..2
    std::vector<Light> lights;
    bool operator==(const Shading &) const = default;

    /// Whether the fields are shown unchanged.
    bool isPlain() const;
    /// Whether there is an active light, which needs the |g| of the fields.
    bool isLit() const;
    /// Whether all lights are grey, so that a grey field makes a grey picture.
    bool isGrey() const;
};

/// *Throws* Error{usage} naming the value that is out of range.
void validate(const DepthCue &cue);
void validate(const Light &light);
void validate(const Shading &shading);

/// "none", "linear:S", "sine:S" or "curve:c0,c1,...", the far end first. *Throws* Error{usage}.
DepthCue cueFromText(const std::string &text);
/// "u,v,w[:#rrggbb[:S]]", the direction in the viewer's frame. *Throws* Error{usage}.
Light lightFromText(const std::string &text);

} // namespace pellucid::shading
