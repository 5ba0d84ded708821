// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mpr/plane.h"
#include "core/volume/volume.h"

namespace pellucid::measure {

/// `projectedDistance`: in the plane of a projection; the depth of its ends is unknown.
enum class Kind { distance, angle, ellipse, rectangle, projectedDistance };

/// A measurement drawn on a plane in patient space.
struct Measurement {
    Kind kind = Kind::distance;
    std::string name;
    /// *Shape*: for a distance, its ends; for an angle, the first leg's end, the vertex and the
    /// second leg's end; for an ellipse or a rectangle, two opposite corners of its box.
    std::vector<glm::dvec3> pointsMm;
    /// The axes of the plane that it was drawn on; the sides or half axes of a region are parallel
    /// to them.
    mpr::Axes axes;

    bool operator==(const Measurement &) const = default;
};

/// The number of points of a kind.
std::size_t pointCount(Kind kind);
bool isRegion(Kind kind);

/// The values in a region. If its plane is parallel to one of the lattice's own: those samples of
/// the nearest slice whose centres are in the region. Otherwise values interpolated linearly, the
/// lattice's shortest step apart. The standard deviation is the sample's (n - 1).
struct RegionValues {
    std::size_t count = 0;
    double mean = 0.0, standardDeviation = 0.0, minimum = 0.0, maximum = 0.0;
    bool areSamples = true; ///< samples of one slice, not interpolated values
};

/// *Units*: mm, degrees, mm^2, value units.
struct Result {
    std::optional<double> lengthMm, angleDegrees, areaMm2;
    std::optional<RegionValues> values; ///< not set if the region is outside the volume
};

Result measure(const Measurement &measurement, const volume::Volume &volume);

/// *Throws* Error{unusable} if the text is not a list of measurements.
std::vector<Measurement> measurementsFromJson(const std::string &text);
std::string toJson(const std::vector<Measurement> &measurements);

/// A table with a row for each measurement, its result and its points. Decimal points, columns
/// separated by commas, quoted texts, lines ended by CR LF (RFC 4180). Lengths in images without a
/// pixel spacing are in pixels, and the headings say so.
std::string toCsv(const std::vector<Measurement> &measurements, const volume::Volume &volume);

/// The name of a kind in files.
std::string kindName(Kind kind);

} // namespace pellucid::measure
