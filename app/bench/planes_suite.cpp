// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/suites.h"
#include "core/mpr/reslice.h"
#include "core/phantom/phantom.h"

namespace pellucid::bench {

namespace {

constexpr int side = 512, cuts = 15;

struct Case {
    std::string name;
    mpr::Axes axes;
    mpr::Slab slab;
};

// The exact value of a pixel: the mean or maximum of the interpolated volume along the slab's part
// inside it.
double exactValue(const volume::Volume &volume, volume::PatientPoint at, const glm::dvec3 &normal,
                  const mpr::Slab &slab) {
    if (!(slab.thicknessMm > 0.0))
        return double(mpr::valueAt(volume, at));
    constexpr int places = 2048;
    double sum = 0.0, maximum = -1e30;
    int count = 0;
    for (int n = 0; n < places; ++n) {
        const double mm = ((n + 0.5) / places - 0.5) * slab.thicknessMm;
        const auto value = double(mpr::valueAt(volume, {at.mm + mm * normal}));
        if (std::isnan(value))
            continue;
        sum += value;
        maximum = std::max(maximum, value);
        ++count;
    }
    return slab.mode == mpr::SlabMode::mean ? sum / count : maximum;
}

Row measureCuts(const volume::Volume &volume, const Case &of) {
    const volume::Lattice &lattice = volume.lattice();
    const glm::dvec3 normal = of.axes.toViewer();
    const auto planeAt = [&](int n) {
        // Different slices around the middle; on the scan's own slices if the plane has any.
        const mpr::ScrollRange range = mpr::scrollRange(lattice, normal);
        const double middle = glm::dot(lattice.center().mm, normal);
        return mpr::Plane{
            {lattice.center().mm + (range.moved(middle, n - cuts / 2) - middle) * normal},
            of.axes,
            0.5,
            side,
            side};
    };
    std::vector<double> times;
    mpr::SliceImage image;
    for (int n = 0; n < cuts; ++n) {
        const double start = millisecondsNow();
        image = mpr::reslice(volume, planeAt(n), {.slab = of.slab});
        times.push_back(millisecondsNow() - start);
    }
    // Checks one pixel in 256 of the last cut.
    std::vector<float> found;
    std::vector<double> truth;
    const mpr::Plane plane = planeAt(cuts - 1);
    for (int r = 4; r < side; r += 16)
        for (int c = 4; c < side; c += 16)
            if (const float value = image.values[std::size_t(r) * side + std::size_t(c)];
                !std::isnan(value)) {
                found.push_back(value);
                truth.push_back(exactValue(volume, plane.at(c, r), normal, of.slab));
            }
    Row row;
    row.suite = "planes";
    row.name = of.name;
    row.size = lattice.size();
    row.frameMs = median(times);
    fillError(row, compare(found, truth));
    return row;
}

} // namespace

void runPlanesSuite(const Report &report) {
    const volume::Volume volume = phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{512, 512, 256}}));
    const mpr::PlaneAxes turned = mpr::PlaneAxes()
                                      .turned(mpr::Orientation::axial, 0.5)
                                      .turned(mpr::Orientation::sagittal, 0.4);
    const struct {
        std::string name;
        mpr::Axes axes;
    } ways[] = {{"axial", mpr::standardAxes(mpr::Orientation::axial)},
                {"coronal", mpr::standardAxes(mpr::Orientation::coronal)},
                {"sagittal", mpr::standardAxes(mpr::Orientation::sagittal)},
                {"oblique", turned.of(mpr::Orientation::coronal)}};
    for (const auto &way : ways) {
        report(measureCuts(volume, {way.name + " 512^2", way.axes, {}}));
        for (const double mm : {5.0, 10.0, 20.0}) {
            report(measureCuts(
                volume,
                {fmt::format("{} {} mm mean", way.name, mm), way.axes, {mm, mpr::SlabMode::mean}}));
            report(measureCuts(volume, {fmt::format("{} {} mm MIP", way.name, mm),
                                        way.axes,
                                        {mm, mpr::SlabMode::maximum}}));
        }
    }
}

} // namespace pellucid::bench
