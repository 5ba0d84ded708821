// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "app/bench/subjects.h"

namespace pellucid::bench {

namespace {

using volume::GridSize;
using volume::Lattice;

// A volume whose samples are a function of their indices.
template <class F> volume::Volume filled(const Lattice &lattice, F &&value) {
    std::vector<float> samples;
    samples.reserve(lattice.size().count());
    const GridSize n = lattice.size();
    for (int k = 0; k < n.k; ++k)
        for (int j = 0; j < n.j; ++j)
            for (int i = 0; i < n.i; ++i)
                samples.push_back(float(value(i, j, k)));
    return volume::Volume(lattice, std::move(samples), volume::ValueUnit::none);
}

volume::Volume noise(const Lattice &lattice) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    return filled(lattice, [&](int, int, int) { return uniform(random); });
}

Lattice cube(int n, double spacing = 1.0) {
    return Lattice::centred({n, n, n}, glm::dvec3(spacing));
}

// f B(f) with 16 control points of the weights 0, 2, 0, 2 ..., whose terms cancel.
double cancellingBezier(double f) {
    constexpr int degree = 15;
    double sum = 0.0, binomial = 1.0;
    for (int n = 0; n <= degree; ++n) {
        sum += (n % 2) * 2.0 * binomial * std::pow(f, n) * std::pow(1.0 - f, degree - n);
        binomial = binomial * (degree - n) / (n + 1);
    }
    return f * sum;
}

classify::DensityField window01(const volume::Volume &values) {
    return classify::densityField(values, {0.0, 1.0});
}

volume::Volume phantomVolume(phantom::Kind kind, const phantom::Sampling &sampling) {
    return phantom::makePhantom(kind, phantom::phantomLattice(kind, sampling));
}

classify::DensityField phantomField(phantom::Kind kind, const phantom::Sampling &sampling) {
    const auto volume = phantomVolume(kind, sampling);
    return classify::densityField(volume, classify::defaultFieldWindow(volume));
}

volume::Volume brokenValues() {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return filled(cube(32), [](int i, int j, int k) {
        if ((i + j + k) % 11 == 0)
            return nan;
        if ((i * j + k) % 13 == 0)
            return i % 2 != 0 ? infinity : -infinity;
        return 0.01F * float((i * 7 + j * 3 + k) % 100);
    });
}

volume::Volume wideRange() {
    return filled(cube(48), [](int i, int j, int k) {
        if (i == 20 && j == 25 && k == 22)
            return 65536.0;
        return std::hypot(i - 24, j - 24, k - 24) < 18 ? 1.0 : 0.0;
    });
}

// A head after a transfer function whose terms cancel.
volume::Volume cancellingHead() {
    const auto density = phantomField(phantom::Kind::head, {.size = GridSize{64, 64, 64}});
    return filled(density.values.lattice(), [&](int i, int j, int k) {
        return cancellingBezier(density.values.value(volume::VoxelIndex{i, j, k}));
    });
}

} // namespace

const std::vector<HardSubject> &hardSubjects() {
    using phantom::Kind;
    constexpr GridSize cube64{64, 64, 64};
    static const std::vector<HardSubject> subjects{
        {"metal among air",
         [=] {
             return classify::densityField(phantomVolume(Kind::metal, {.size = cube64}),
                                           {-1024.0, 30000.0});
         }},
        {"air offset left in",
         [=] {
             return classify::densityField(phantomVolume(Kind::head, {.size = cube64}),
                                           {-2000.0, 2000.0});
         }},
        {"full to its corners", [] { return window01(noise(cube(48))); }},
        {"thick slices",
         [] {
             return phantomField(Kind::head, {.size = GridSize{160, 160, 20},
                                              .spacingMm = glm::dvec3(1.5, 1.5, 12.0)});
         }},
        {"voxels 0.4 x 0.4 x 8",
         [] {
             return window01(noise(Lattice::centred({90, 80, 9}, {0.4, 0.4, 8.0})));
         }},
        {"tilted by 30 degrees",
         [] {
             return phantomField(Kind::head,
                                 {.size = GridSize{64, 64, 40}, .tiltRad = 0.5235987755982988});
         }},
        {"chest cut by the scan", [=] { return phantomField(Kind::chest, {.size = cube64}); }},
        {"1 x 1 x 1", [] { return window01(filled(cube(1), [](int, int, int) { return 0.5; })); }},
        {"2 x 2 x 2", [] { return window01(noise(cube(2))); }},
        {"3 x 5 x 7",
         [] {
             return window01(noise(Lattice::centred({3, 5, 7}, {1, 1, 1})));
         }},
        {"256 x 256 x 1",
         [] {
             return window01(noise(Lattice::centred({256, 256, 1}, {1, 1, 1})));
         }},
        {"prime and odd sizes",
         [] {
             return phantomField(Kind::head, {.size = GridSize{97, 101, 103}});
         }},
        {"one bright voxel",
         [] {
             return window01(filled(cube(41), [](int i, int j, int k) {
                 return i == 3 && j == 30 && k == 17 ? 1.0 : 0.0;
             }));
         }},
        {"constant", [] { return window01(filled(cube(40), [](int, int, int) { return 1.0; })); }},
        {"all zero", [] { return window01(filled(cube(24), [](int, int, int) { return 0.0; })); }},
        {"NaN and infinity", [] { return window01(brokenValues()); }},
        {"range of 2^16",
         [] {
             return classify::densityField(wideRange(), {0.0, 65536.0});
         }},
        {"weights that cancel", [] { return window01(cancellingHead()); }},
        {"voxels of a micrometre", [] { return window01(noise(cube(24, 1e-3))); }},
        {"voxels of a metre", [] { return window01(noise(cube(24, 1e3))); }}};
    return subjects;
}

} // namespace pellucid::bench
