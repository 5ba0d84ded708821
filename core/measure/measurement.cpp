// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/measure/measurement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/files/table_cell.h"
#include "core/mpr/reslice.h"

namespace pellucid::measure {

namespace {

// A region within its plane. *Units*: mm from its centre, along the plane's axes.
struct Region {
    Region(const Measurement &m)
        : center(0.5 * (m.pointsMm[0] + m.pointsMm[1])), axes(m.axes),
          isEllipse(m.kind == Kind::ellipse) {
        const glm::dvec3 half = 0.5 * (m.pointsMm[1] - m.pointsMm[0]);
        a = std::abs(glm::dot(half, axes.right));
        b = std::abs(glm::dot(half, axes.up));
    }
    bool holds(const glm::dvec2 &p) const {
        if (isEllipse)
            return p.x * p.x * b * b + p.y * p.y * a * a <= a * a * b * b;
        return std::abs(p.x) <= a && std::abs(p.y) <= b;
    }
    double areaMm2() const { return (isEllipse ? std::numbers::pi : 4.0) * a * b; }

    glm::dvec3 center;
    mpr::Axes axes;
    double a, b;
    bool isEllipse;
};

// Mean and standard deviation in one pass without cancellation (Welford).
class Accumulator {
public:
    void add(double value) {
        if (std::isnan(value))
            return;
        ++m_values.count;
        const double before = value - m_values.mean;
        m_values.mean += before / double(m_values.count);
        m_squares += before * (value - m_values.mean);
        m_values.minimum = std::min(m_values.minimum, value);
        m_values.maximum = std::max(m_values.maximum, value);
    }
    std::optional<RegionValues> result(bool areSamples) {
        if (m_values.count == 0)
            return std::nullopt;
        if (m_values.count > 1)
            m_values.standardDeviation = std::sqrt(m_squares / double(m_values.count - 1));
        m_values.areSamples = areSamples;
        return m_values;
    }

private:
    RegionValues m_values{0, 0.0, 0.0, std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity()};
    double m_squares = 0.0;
};

// The samples with their centres in the region, from the slice nearest to it.
std::optional<RegionValues> samplesIn(const Region &region, const volume::Volume &volume,
                                      int across) {
    const volume::Lattice &lattice = volume.lattice();
    const volume::GridSize n = lattice.size();
    std::array<int, 3> low{}, high{};
    const glm::dvec3 center = lattice.voxel({region.center}).v;
    const double slice = std::round(center[across]);
    if (!(slice >= 0.0 && slice < n[across]))
        return std::nullopt;
    const glm::dvec3 normal = lattice.voxel({region.center + region.axes.toViewer()}).v - center;
    for (int d = 0; d < 3; ++d) {
        double least = center[d], most = center[d];
        for (const double u : {-region.a, region.a})
            for (const double v : {-region.b, region.b}) {
                glm::dvec3 corner =
                    lattice.voxel({region.center + u * region.axes.right + v * region.axes.up}).v;
                // In a skewed stack a move to the slice along the normal also changes the position
                // in it.
                corner += (slice - corner[across]) / normal[across] * normal;
                least = std::min(least, corner[d]);
                most = std::max(most, corner[d]);
            }
        low[d] = int(std::clamp(std::floor(least), 0.0, double(n[d])));
        high[d] = int(std::clamp(std::ceil(most), -1.0, n[d] - 1.0));
    }
    low[across] = high[across] = int(slice);
    Accumulator accumulator;
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i) {
                const glm::dvec3 d =
                    lattice.patient(volume::VoxelIndex{i, j, k}).mm - region.center;
                if (region.holds({glm::dot(d, region.axes.right), glm::dot(d, region.axes.up)}))
                    accumulator.add(volume.value({i, j, k}));
            }
    return accumulator.result(true);
}

std::optional<RegionValues> valuesIn(const Region &region, const volume::Volume &volume) {
    const volume::Lattice &lattice = volume.lattice();
    const glm::dvec3 normal = region.axes.toViewer();
    if (mpr::scrollRange(lattice, normal).hasSlices) {
        int across = 0;
        for (int d = 1; d < 3; ++d)
            if (std::abs(glm::dot(lattice.step(d), normal)) / lattice.spacingMm(d) >
                std::abs(glm::dot(lattice.step(across), normal)) / lattice.spacingMm(across))
                across = d;
        if (const auto samples = samplesIn(region, volume, across))
            return samples;
        // A region between sample centres still has interpolated values.
    }
    const double step = lattice.shortestStepMm();
    // Limited to the extent of the volume, however large the region is.
    const glm::dvec3 toVolume = lattice.center().mm - region.center;
    const auto steps = [&](double half, const glm::dvec3 &axis) {
        const double middle = glm::dot(toVolume, axis), reach = lattice.radiusMm();
        return std::pair(int(std::ceil(std::max(-half, middle - reach) / step)),
                         int(std::floor(std::min(half, middle + reach) / step)));
    };
    const auto [firstColumn, lastColumn] = steps(region.a, region.axes.right);
    const auto [firstRow, lastRow] = steps(region.b, region.axes.up);
    Accumulator accumulator;
    for (int r = firstRow; r <= lastRow; ++r)
        for (int c = firstColumn; c <= lastColumn; ++c)
            if (const glm::dvec2 p(c * step, r * step); region.holds(p))
                accumulator.add(double(mpr::valueAt(
                    volume, {region.center + p.x * region.axes.right + p.y * region.axes.up})));
    return accumulator.result(false);
}

// This form stays precise near 0 and 180 degrees.
double degreesBetween(const glm::dvec3 &a, const glm::dvec3 &b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

std::string figure(const std::optional<double> &value) {
    return value ? fmt::format("{:.6g}", *value) : std::string();
}

} // namespace

PointCount pointCount(Kind kind) {
    switch (kind) {
    case Kind::text:
        return {1, 1};
    case Kind::angle:
        return {3, 3};
    case Kind::cobbAngle:
        return {4, 4};
    case Kind::polyline:
        return {2, maxPolylinePoints};
    case Kind::distance:
    case Kind::ellipse:
    case Kind::rectangle:
    case Kind::arrow:
        break;
    }
    return {2, 2};
}

bool isAnnotation(Kind kind) {
    return kind == Kind::arrow || kind == Kind::text;
}

bool isRegion(Kind kind) {
    return kind == Kind::ellipse || kind == Kind::rectangle;
}

Result measure(const Measurement &m, const volume::Volume &volume) {
    Result result;
    switch (m.kind) {
    case Kind::distance:
    case Kind::polyline:
        result.lengthMm = 0.0;
        for (std::size_t n = 1; n < m.pointsMm.size(); ++n)
            *result.lengthMm += glm::distance(m.pointsMm[n - 1], m.pointsMm[n]);
        break;
    case Kind::angle:
        result.angleDegrees =
            degreesBetween(m.pointsMm[0] - m.pointsMm[1], m.pointsMm[2] - m.pointsMm[1]);
        break;
    case Kind::cobbAngle: {
        const double between =
            degreesBetween(m.pointsMm[1] - m.pointsMm[0], m.pointsMm[3] - m.pointsMm[2]);
        result.angleDegrees = std::min(between, 180.0 - between);
        break;
    }
    case Kind::arrow:
    case Kind::text:
        break;
    case Kind::ellipse:
    case Kind::rectangle: {
        const Region region(m);
        result.areaMm2 = region.areaMm2();
        result.values = valuesIn(region, volume);
        break;
    }
    }
    return result;
}

std::optional<RegionValues> valuesOf(const volume::Volume &volume,
                                     const volume::Coverage &coverage) {
    constexpr int half = (volume::Coverage::whole + 1) / 2;
    Accumulator accumulator;
    std::size_t at = 0;
    const volume::VoxelBox &box = coverage.box;
    for (int k = box.lo.k; k < box.hi.k; ++k)
        for (int j = box.lo.j; j < box.hi.j; ++j)
            for (int i = box.lo.i; i < box.hi.i; ++i, ++at)
                if (at < coverage.shares.size() && coverage.shares[at] >= half)
                    accumulator.add(volume.value({i, j, k}));
    return accumulator.result(true);
}

std::string toCsv(const std::vector<Measurement> &measurements, const volume::Volume &volume) {
    const bool hasSpacing = volume.notes().hasSpacing;
    const std::string_view place = volume::spacingPlaceName(volume.notes().spacingPlace);
    const std::string where = place.empty() ? "" : fmt::format(" {}", place);
    std::string out = fmt::format("name,kind,length {0}{3},angle deg,area {1}{3},mean,"
                                  "standard deviation,minimum,maximum,unit,values,points {2}\r\n",
                                  hasSpacing ? "mm" : "pixels", hasSpacing ? "mm2" : "pixels2",
                                  hasSpacing ? "LPS mm" : "pixels", where);
    for (const Measurement &m : measurements) {
        const Result r = measure(m, volume);
        const auto value = [&](double RegionValues::*what) {
            return r.values ? std::optional(*r.values.*what) : std::nullopt;
        };
        std::string points;
        for (const glm::dvec3 &p : m.pointsMm)
            points +=
                fmt::format("{}{:.3f} {:.3f} {:.3f}", points.empty() ? "" : "; ", p.x, p.y, p.z);
        out += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{}\r\n", files::csvField(files::tableCell(m.name)),
            kindName(m), figure(r.lengthMm), figure(r.angleDegrees), figure(r.areaMm2),
            figure(value(&RegionValues::mean)), figure(value(&RegionValues::standardDeviation)),
            figure(value(&RegionValues::minimum)), figure(value(&RegionValues::maximum)),
            r.values ? volume::unitName(volume.unit()) : "",
            r.values ? fmt::format("{}{}", r.values->count,
                                   r.values->areSamples ? " samples" : " interpolated")
                     : std::string(),
            files::csvField(points));
    }
    return out;
}

} // namespace pellucid::measure
