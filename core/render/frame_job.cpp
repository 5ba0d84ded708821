// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/frame_job.h"

#include <cmath>
#include <numbers>

namespace pellucid::render {

using fourier::stripLanes;

std::vector<std::complex<double>> rotations(int count, double turns) {
    std::vector<std::complex<double>> result(count);
    const double angle = 2.0 * std::numbers::pi * (turns - std::floor(turns));
    const double re = std::cos(angle), im = std::sin(angle);
    // Rotating step by step in double keeps 1e-13.
    double x = 1.0, y = 0.0;
    for (auto &r : result) {
        r = {x, y};
        const double next = x * re - y * im;
        y = x * im + y * re;
        x = next;
    }
    return result;
}

RadialFactors::RadialFactors(const scene::ImageDefinition &image, double pixelMm)
    : rollOffShare(image.rollOff), detail(image.detail),
      // The band ends at |s| = 1/(2 pixel).
      detailWidth(image.detail > 0.0 ? std::numbers::pi * image.detailMm / pixelMm : 0.0) {}

double RadialFactors::at(double radius) const {
    const double x = radius * detailWidth, u = x * x;
    return scene::rollOffFactor(rollOffShare, radius) * (1.0 + detail * u / (1.0 + u));
}

GridTables::GridTables(const plan::SliceGrid &size, const RadialFactors &radial, int count)
    : grid(size), factors(radial), alongRows(size.rows), halfColumns(size.columns / 2) {
    for (const auto &factor : rotations(size.columns / 2, 1.0 / size.columns))
        unpackReal.emplace_back(factor);
    const auto radius = [&](int column, int row) {
        return std::hypot(2.0 * column / size.columns, 2.0 * row / size.rows);
    };
    // The Nyquist row and column are on the edge of the disc, where the roll-off is 0.
    for (int strip = 0; strip < count; ++strip) {
        const int first = strip * stripLanes, last = first + stripLanes - 1;
        StripBounds bounds;
        while (bounds.outerRow + 1 < size.rows / 2 && radius(first, bounds.outerRow + 1) < 1.0)
            ++bounds.outerRow;
        while (factors.detail <= 0.0 && bounds.innerRow < bounds.outerRow &&
               radius(last, bounds.innerRow + 1) <= 1.0 - factors.rollOffShare)
            ++bounds.innerRow;
        bounds.rollOff = rollOff.size();
        for (int row = bounds.innerRow + 1; row <= bounds.outerRow; ++row)
            for (int column = first; column <= last; ++column)
                rollOff.push_back(float(factors.at(radius(column, row))));
        strips.push_back(bounds);
    }
}

} // namespace pellucid::render
