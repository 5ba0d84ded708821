// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/classify/tissue_class.h"

namespace pellucid::shading {

enum class CueKind {
    none,
    linear, ///< d = 1 + S t
    sine,   ///< d = 1 + S sin(pi/2 t)
    curve   ///< d = 1 + S (c(t) - 1), c through given values
};

/// The weight d of what lies at depth t = (W.x)/R: -1 at the far end of every view of the volume,
/// +1 at the near one; x from the centre of rotation, R the lattice's radius.
/// *Source*: Totsuka 1993, 3.1.
struct DepthCue {
    CueKind kind = CueKind::none;
    double strength = 1.0; ///< S, 0..1
    /// Of a curve: c at evenly spaced depths, the far end first; between them the sum of cosines
    /// c_k cos(k pi (t + 1)/2), k below their number, that goes through them.
    std::vector<double> curve{1.0, 1.0, 1.0};
    bool operator==(const DepthCue &) const = default;

    /// Whether it changes anything.
    bool isActive() const;
    /// d at a depth, which may lie beyond the volume.
    double at(double t) const;
};

/// DepthCue::at made ready for many depths.
std::function<double(double t)> cueFunction(const DepthCue &cue);

/// Of a curve's values, 0 to 2: as many slices as twice their number cost what they cost.
inline constexpr std::size_t fewestCurveValues = 2, mostCurveValues = 8;
inline constexpr double largestCurveValue = 2.0;

/// The coefficients c_k of the cosines through the values of a curve. *Shape*: two values or more.
std::vector<double> cosinesOf(const std::vector<double> &values);

/// What a light's direction is fixed to.
enum class LightFrame {
    viewer, ///< right, up, toward the viewer
    patient ///< LPS
};

/// A hemisphere of light whose pole lies in a direction: what faces it gets all, what turns away
/// nothing, what lies across half. *Source*: Totsuka 1993, eq. 8 to 11.
struct Light {
    glm::dvec3 direction{0.0, 0.0, 1.0}; ///< to the light, not zero; only its direction counts
    classify::Color color;
    double strength = 1.0; ///< 0..1
    LightFrame frame = LightFrame::viewer;
    bool operator==(const Light &) const = default;
};

inline constexpr std::size_t mostLights = 8;
inline constexpr double largestAmbient = 2.0;

/// What gives the image depth: the field f becomes
///   d (A f + sum over lights of S colour 1/2 (|g| - g.L))
/// with g the gradient of f per shortest step (`gradientMagnitude`). Without cue and lights and
/// with A = 1, f itself, at no cost.
struct Shading {
    DepthCue cue;
    double ambient = 1.0; ///< A, 0..2
    std::vector<Light> lights;
    bool operator==(const Shading &) const = default;

    /// Whether the fields are shown as they are.
    bool isPlain() const;
    /// Whether a light shines: the |g| of the fields is needed.
    bool isLit() const;
    /// Whether all lights are grey: a grey field gives a grey picture.
    bool isGrey() const;
};

/// *Throws* Error{usage} naming what is out of its range.
void validate(const Shading &shading);

/// "none", "linear:S", "sine:S" or "curve:c0,c1,...", the far end first. *Throws* Error{usage}.
DepthCue cueFromText(const std::string &text);
/// "u,v,w[:#rrggbb[:S]]", the direction in the viewer's frame. *Throws* Error{usage}.
Light lightFromText(const std::string &text);

/// A JSON object with `cue`, `ambient` and `lights`, each only if it is not the usual.
std::string toJson(const Shading &shading);
/// From such an object; keys of others are left alone. *Throws* Error{usage} with the JSON
/// pointer of what is wrong (`because::at`).
Shading shadingFromJson(const std::string &text);

} // namespace pellucid::shading
