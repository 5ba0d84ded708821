// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "core/phantom/anatomy.h"
#include "core/phantom/ellipsoids.h"
#include "core/phantom/painter.h"

namespace pellucid::phantom {

using glm::dvec3;

volume::VolumeNotes phantomNotes(const std::string &title,
                                 std::vector<volume::ValueWindow> windows) {
    volume::VolumeNotes notes;
    notes.title = title;
    notes.modality = "CT";
    notes.windows = std::move(windows);
    return notes;
}

volume::Volume makeMetal(const volume::Lattice &lattice, const task::Progress &progress) {
    Painter painter(lattice, -1024.0, progress);
    const double r = inscribedRadiusMm(lattice);
    painter.paint(ellipsoid({0, 0, 0}, {0.85 * r, 0.7 * r, 0.85 * r}), 40.0);
    painter.paint(rod({-0.4 * r, 0, -0.5 * r}, {-0.4 * r, 0, 0.5 * r}, 0.06 * r, 0.06 * r),
                  30000.0);
    painter.paint(
        rod({0.3 * r, -0.3 * r, 0.1 * r}, {0.45 * r, 0.3 * r, -0.2 * r}, 0.05 * r, 0.02 * r),
        30000.0);
    painter.paint(ellipsoid({0.1 * r, 0.2 * r, 0.45 * r}, dvec3(0.09 * r)), 30000.0);
    return painter.finish(10.0, 7, phantomNotes("Metal phantom"));
}

volume::Volume makeSphere(const volume::Lattice &lattice, const task::Progress &progress) {
    Painter painter(lattice, -1000.0, progress);
    painter.paint(ellipsoid({0, 0, 0}, dvec3(0.8 * inscribedRadiusMm(lattice))), 1000.0);
    return painter.finish(0.0, 0, phantomNotes("Sphere phantom"));
}

volume::Volume makeCube(const volume::Lattice &lattice, const task::Progress &progress) {
    progress.check();
    return {lattice, std::vector<std::int16_t>(lattice.size().count(), 1000),
            volume::ValueUnit::hounsfield, phantomNotes("Cube phantom")};
}

volume::Volume makeBars(const volume::Lattice &lattice, const task::Progress &progress) {
    // Sampled, not painted: bars are cut at voxel boundaries, so that a pattern of one voxel is the
    // highest frequency of the lattice.
    const volume::GridSize size = lattice.size();
    std::vector<std::int16_t> samples(size.count(), -1000);
    const auto margin = [](int n) { return n / 10; };
    const auto inside = [&](int at, int n) { return at >= margin(n) && at < n - margin(n); };
    tbb::parallel_for(0, size.k, [&](int k) {
        progress.check();
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                if (!inside(i, size.i) || !inside(j, size.j) || !inside(k, size.k))
                    continue;
                // Six slabs along z, with bars of 1 to 6 voxels that change from the x to the y
                // direction half way along y.
                const int bar =
                    1 + 6 * (k - margin(size.k)) / std::max(1, size.k - 2 * margin(size.k));
                const int along = j < size.j / 2 ? i : j;
                const bool on = (along / bar) % 2 == 0;
                samples[size.offsetOf(i, j, k)] = on ? 1000 : 0;
            }
    });
    return {lattice, std::move(samples), volume::ValueUnit::hounsfield,
            phantomNotes("Bar phantom")};
}

volume::Volume makeEllipsoids(const volume::Lattice &lattice, const task::Progress &progress) {
    const auto bodies = smoothEllipsoids(inscribedRadiusMm(lattice));
    const volume::GridSize size = lattice.size();
    std::vector<std::int16_t> samples(size.count());
    tbb::parallel_for(0, size.k, [&](int k) {
        progress.check();
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const dvec3 p =
                    lattice.patient(volume::VoxelIndex{i, j, k}).mm - lattice.center().mm;
                samples[size.offsetOf(i, j, k)] =
                    std::int16_t(std::lround(ellipsoidBackgroundHu + densityAt(bodies, p)));
            }
    });
    return {lattice, std::move(samples), volume::ValueUnit::hounsfield,
            phantomNotes("Ellipsoid phantom")};
}

} // namespace pellucid::phantom
