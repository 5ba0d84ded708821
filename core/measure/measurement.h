// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mpr/plane.h"
#include "core/volume/coverage.h"
#include "core/volume/volume.h"

namespace pellucid::measure {

enum class Kind { distance, polyline, angle, cobbAngle, ellipse, rectangle, arrow, text };

/// A measurement or an annotation drawn on a plane in patient space.
struct Measurement {
    Kind kind = Kind::distance;
    std::string name; ///< of an arrow or a text: what it says
    /// *Shape*: for a distance, its ends; for a polyline, its corners in order; for an angle, the
    /// first leg's end, the vertex and the second leg's end; for a Cobb angle, the ends of the two
    /// lines; for an ellipse or a rectangle, two opposite corners of its box; for an arrow, its tip
    /// and its tail; for a text, its place.
    std::vector<glm::dvec3> pointsMm;
    /// The axes of the plane that it was drawn on; the sides or half axes of a region are parallel
    /// to them.
    mpr::Axes axes;
    /// Drawn in the picture of a projection: the depth of its points is unknown, and they are
    /// placed in one plane. Regions cannot be.
    bool isProjected = false;

    bool operator==(const Measurement &) const = default;
};

/// How many points a kind has, both ends included.
struct PointCount {
    std::size_t min, max;
};
PointCount pointCount(Kind kind);
inline constexpr std::size_t maxPolylinePoints = 1000;
bool isRegion(Kind kind);
/// Whether a kind says something in place of measuring.
bool isAnnotation(Kind kind);

/// The values in a region. If its plane is parallel to one of the lattice's own: those samples of
/// the nearest slice whose centres are in the region. Otherwise values interpolated linearly, the
/// lattice's shortest step apart. The standard deviation is the sample's (n - 1).
struct RegionValues {
    std::size_t count = 0;
    double mean = 0.0, standardDeviation = 0.0, minimum = 0.0, maximum = 0.0;
    bool areSamples = true; ///< samples of one slice, not interpolated values
};

/// *Units*: mm, degrees, mm^2, value units. A Cobb angle is the smaller one between its lines, at
/// most 90 degrees. An annotation has no figures.
struct Result {
    std::optional<double> lengthMm, angleDegrees, areaMm2;
    std::optional<RegionValues> values; ///< not set if the region is outside the volume
};

Result measure(const Measurement &measurement, const volume::Volume &volume);

/// The values of the samples that belong at least half to a region; none if there are none.
std::optional<RegionValues> valuesOf(const volume::Volume &volume,
                                     const volume::Coverage &coverage);

/// *Throws* Error{unusable} if the text is not a list of measurements.
std::vector<Measurement> measurementsFromJson(const std::string &text);
std::string toJson(const std::vector<Measurement> &measurements);

/// A table with a row for each measurement, its result and its points. Decimal points, columns
/// separated by commas, quoted texts, lines ended by CR LF (RFC 4180). Lengths in images without a
/// pixel spacing are in pixels, and the headings say so.
std::string toCsv(const std::vector<Measurement> &measurements, const volume::Volume &volume);

/// The name of a measurement's kind in tables, such as "distance" or "projected distance".
std::string kindName(const Measurement &measurement);

} // namespace pellucid::measure
