// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reference/slice_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include "core/fourier/transforms/padded_size.h"
#include "core/fourier/transforms/transform.h"

namespace pellucid::reference {

namespace {

// The response of a raised cosine over the share F of the band falls as 1/(r (1 - (F r)^2)), at r
// samples of that band (`scene::rollOffFactor`, transformed). At 4/F it is below a fifteenth of
// that of a sharp edge, and falls as 1/r^3 from there. A roll-off over less than 1/64 counts as
// 1/64, because the response of a sharp edge never fades.
double fadingLength(double rollOff) {
    return 4.0 / std::max(1.0 / 64.0, rollOff);
}

} // namespace

Period periodOf(const volume::Lattice &lattice, const scene::Camera &camera,
                const scene::ImageDefinition &image) {
    const double extent = 2.0 * lattice.radiusMm() / camera.pixelMm;
    double margin = 6.0 * fadingLength(image.rollOff);
    // The lattice's own band is tapered too. Along an axis of the lattice its tails lie on one line
    // and cancel less: at six fading lengths, 2e-5 of a point was cut off.
    if (image.reconstruction == scene::Reconstruction::bandLimited)
        margin = 8.0 * fadingLength(image.rollOff) *
                 std::max(1.0, lattice.longestStepMm() / camera.pixelMm);
    // The filter that amplifies detail falls by e every `detailMm`.
    if (image.detail > 0.0)
        margin += 30.0 * image.detailMm / camera.pixelMm;
    const auto pixels = [&](int size, double panMm) {
        const double needed =
            std::max(extent, 0.5 * (extent + size) + std::abs(panMm) / camera.pixelMm);
        return fourier::smoothEvenSize(int(std::ceil(needed + margin)));
    };
    return {pixels(camera.width, camera.panMm.x), pixels(camera.height, camera.panMm.y)};
}

std::size_t sliceBytes(const volume::Lattice &lattice, const scene::Camera &camera,
                       const scene::ImageDefinition &image) {
    const Period period = periodOf(lattice, camera, image);
    // The slice, its transform on the period, and the image.
    return 3 * sizeof(double) * std::size_t(period.columns) * std::size_t(period.rows);
}

std::vector<double> sliceImage(const SpectrumSampler &spectrum, const volume::Lattice &lattice,
                               const scene::Camera &camera, const scene::ImageDefinition &image) {
    const Period period = periodOf(lattice, camera, image);
    const int columns = period.columns, rows = period.rows;
    const double du = 1.0 / (columns * camera.pixelMm), dv = 1.0 / (rows * camera.pixelMm);
    const double limit = 0.5 / camera.pixelMm;
    const glm::dmat3 axes = camera.axes();
    const double firstU = camera.panMm.x - 0.5 * (camera.width - 1) * camera.pixelMm;
    const double firstV = camera.panMm.y + 0.5 * (camera.height - 1) * camera.pixelMm;

    const int stride = columns / 2 + 1;
    std::vector<std::complex<double>> slice(std::size_t(rows) * stride);
    tbb::parallel_for(0, rows, [&](int r) {
        const int ky = r <= rows / 2 ? r : r - rows;
        if (ky == rows / 2)
            return;
        const double sv = -ky * dv;
        std::vector<glm::dvec3> frequencies;
        std::vector<int> at;
        std::vector<double> weight;
        for (int kx = 0; kx < columns / 2; ++kx) {
            const double su = kx * du;
            const double radius = std::sqrt(su * su + sv * sv) / limit;
            if (radius >= 1.0)
                break;
            const glm::dvec3 s = su * axes[0] + sv * axes[1];
            double w = scene::rollOffFactor(image.rollOff, radius) *
                       scene::detailFactor(image, std::hypot(su, sv)) * du * dv;
            for (int d = 0; d < 3; ++d)
                w *= scene::reconstructionFactor(image, glm::dot(lattice.step(d), s));
            if (w == 0.0)
                continue; // beyond the band of the lattice
            frequencies.push_back(s);
            at.push_back(kx);
            weight.push_back(w);
        }
        std::vector<std::complex<double>> values(frequencies.size());
        spectrum(frequencies, values);
        for (std::size_t n = 0; n < values.size(); ++n) {
            const double su = at[n] * du;
            const double angle = 2.0 * std::numbers::pi * (su * firstU + sv * firstV);
            slice[std::size_t(r) * stride + at[n]] = weight[n] * values[n] * std::polar(1.0, angle);
        }
    });
    const fourier::InverseTransform2d<double> inverse(rows, columns);
    std::vector<double> plane(std::size_t(rows) * columns);
    inverse.run(slice.data(), plane.data());
    std::vector<double> result(std::size_t(camera.height) * camera.width);
    for (int r = 0; r < camera.height; ++r)
        for (int c = 0; c < camera.width; ++c)
            result[std::size_t(r) * camera.width + c] =
                plane[std::size_t(r % rows) * columns + c % columns];
    return result;
}

} // namespace pellucid::reference
