// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mpr/plane.h"
#include "core/volume/volume.h"

namespace pellucid::measure {

/// `projectedDistance`: in the plane of a projection, where nothing says how deep its ends lie.
enum class Kind { distance, angle, ellipse, rectangle, projectedDistance };

/// What somebody drew on a plane of the patient.
struct Measurement {
    Kind kind = Kind::distance;
    std::string name;
    /// *Shape*: the ends of a distance; the first leg's end, the vertex and the second leg's end of
    /// an angle; two opposite corners of the box around an ellipse or of a rectangle.
    std::vector<glm::dvec3> pointsMm;
    /// Of the plane that it was drawn on; sides and half axes of a region lie along them.
    mpr::Axes axes;

    bool operator==(const Measurement &) const = default;
};

/// How many points a measurement of this kind has.
std::size_t pointCount(Kind kind);
bool isRegion(Kind kind);

/// The values in a region. Where its plane is one of the lattice's own, they are those of the
/// samples of the nearest slice whose centres lie in it; else values between samples (linear), a
/// shortest step of the lattice apart. The standard deviation is that of a sample (n - 1).
struct RegionValues {
    std::size_t count = 0;
    double mean = 0.0, standardDeviation = 0.0, minimum = 0.0, maximum = 0.0;
    bool areSamples = true; ///< of one slice; else between samples
};

/// *Units*: mm, degrees, mm^2, value units.
struct Result {
    std::optional<double> lengthMm, angleDegrees, areaMm2;
    std::optional<RegionValues> values; ///< none where the region holds no part of the volume
};

Result measure(const Measurement &measurement, const volume::Volume &volume);

/// *Throws* Error{unusable} for what is not a list of measurements.
std::vector<Measurement> measurementsFromJson(const std::string &text);
std::string toJson(const std::vector<Measurement> &measurements);

/// A table with a row for each measurement, its result, and its points. Decimal points, commas
/// between columns, texts in quotes, lines end with CR LF (RFC 4180).
/// Lengths of images without a pixel spacing are in pixels, and the headings say so.
std::string toCsv(const std::vector<Measurement> &measurements, const volume::Volume &volume);

/// The word of a kind in files.
std::string kindName(Kind kind);

} // namespace pellucid::measure
