// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include <glm/vec3.hpp>

namespace pellucid::scene {

/// The brightness of a study, measured from its own projections along the patient's axes. Displays
/// take their automatic settings from it; between the axes they are mixed by the squares of the
/// line of sight's components, so that the picture does not flicker while it turns.
struct Exposure {
    /// For one line of sight. *Units*: image values; `low` and `high` after the contrast
    /// processing.
    struct Axis {
        double air = 0.0;                ///< beside the body
        double dark = 0.0, bright = 1.0; ///< the body's 1 % and 99 % quantiles
        double low = 0.0, high = 1.0;    ///< become black and white
        double exponent = 1.0;           ///< of the display curve between them
        bool operator==(const Axis &) const = default;
    };
    /// Along the patient's x, y and z.
    std::array<Axis, 3> axes;
    /// The detail and latitude that they were measured with, 0..1.
    double detail = 0.0, latitude = 0.0;
    /// Structures of this size and finer count as fine detail.
    double fineMm = 2.0;
    /// The box of the body's shadows, from the middle of the volume; *units*: mm, LPS. Empty (low
    /// not below high) if nothing is shown.
    glm::dvec3 lowMm{0.0}, highMm{0.0};
    bool operator==(const Exposure &) const = default;
};

/// How the float image becomes grey: [low, high] in image units, or automatic; bright on dark, or
/// inverted like a film.
struct Tone {
    std::optional<double> low, high;
    bool inverted = false;
    /// Multi-scale contrast, 0..1: how much fine structures are amplified, and how much large
    /// differences in thickness are compressed. Automatic if absent; 0 and 0 leave the image as it
    /// is.
    std::optional<double> detail, latitude;
    /// Where the brightness was measured before; otherwise it is measured for the picture.
    std::optional<Exposure> exposure;
    bool operator==(const Tone &) const = default;
};

} // namespace pellucid::scene
