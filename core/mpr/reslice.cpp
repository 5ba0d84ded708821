// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpr/reslice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace pellucid::mpr {

namespace {

template <class T>
float interpolate(const T *samples, const volume::GridSize &n, const glm::dvec3 &p) {
    if (p.x < -0.5 || p.y < -0.5 || p.z < -0.5 || p.x > n.i - 0.5 || p.y > n.j - 0.5 ||
        p.z > n.k - 0.5 || std::isnan(p.x + p.y + p.z))
        return std::numeric_limits<float>::quiet_NaN();
    const auto split = [](double at, int count, int &low, int &high) {
        const double clamped = std::clamp(at, 0.0, double(count - 1));
        low = std::min(int(clamped), count - 1);
        high = std::min(low + 1, count - 1);
        return float(clamped - low);
    };
    int x0, x1, y0, y1, z0, z1;
    const float fx = split(p.x, n.i, x0, x1), fy = split(p.y, n.j, y0, y1),
                fz = split(p.z, n.k, z0, z1);
    const auto row = [&](int y, int z) {
        const T *r = samples + (std::size_t(z) * n.j + y) * n.i;
        return float(r[x0]) + fx * (float(r[x1]) - float(r[x0]));
    };
    const float a = row(y0, z0), b = row(y1, z0), c = row(y0, z1), d = row(y1, z1);
    const float ab = a + fy * (b - a), cd = c + fy * (d - c);
    return ab + fz * (cd - ab);
}

} // namespace

SliceImage reslice(const volume::Volume &volume, const Plane &plane) {
    const volume::Lattice &lattice = volume.lattice();
    SliceImage image{plane.width, plane.height,
                     std::vector<float>(std::size_t(plane.width) * plane.height)};
    const glm::dvec3 first = lattice.voxel(plane.at(0, 0)).v;
    const glm::dvec3 alongRow = lattice.voxel(plane.at(1, 0)).v - first;
    const glm::dvec3 downColumn = lattice.voxel(plane.at(0, 1)).v - first;
    volume.visit([&](auto samples) {
        tbb::parallel_for(0, plane.height, [&](int r) {
            float *out = image.values.data() + std::size_t(r) * plane.width;
            const glm::dvec3 start = first + double(r) * downColumn;
            for (int c = 0; c < plane.width; ++c)
                out[c] = interpolate(samples.data(), lattice.size(), start + double(c) * alongRow);
        });
    });
    return image;
}

float valueAt(const volume::Volume &volume, volume::PatientPoint point) {
    return volume.visit([&](auto samples) {
        return interpolate(samples.data(), volume.lattice().size(),
                           volume.lattice().voxel(point).v);
    });
}

} // namespace pellucid::mpr
