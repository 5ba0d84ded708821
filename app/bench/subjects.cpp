// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/subjects.h"

#include <cmath>
#include <random>

#include <fmt/format.h>

namespace pellucid::bench {

namespace {

template <class Inside> classify::DensityField noise(int n, Inside &&inside) {
    const auto lattice = volume::Lattice::centred({n, n, n}, {1, 1, 1});
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    std::vector<float> samples(lattice.size().count(), 0.0F);
    std::size_t at = 0;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i, ++at)
                if (inside(i, j, k))
                    samples[at] = uniform(random);
    return {volume::Volume(lattice, std::move(samples), volume::ValueUnit::none), lattice.bounds()};
}

} // namespace

Subject noiseSphere(int n) {
    const double middle = 0.5 * (n - 1), radius = 0.5 * n;
    return {fmt::format("noise sphere {}", n), noise(n, [=](int i, int j, int k) {
                const double x = i - middle, y = j - middle, z = k - middle;
                return x * x + y * y + z * z < radius * radius;
            })};
}

Subject phantomSubject(const std::string &name, phantom::Kind kind,
                       const phantom::Sampling &sampling) {
    const auto volume = phantom::makePhantom(kind, phantom::phantomLattice(kind, sampling));
    return {name, classify::densityField(volume, classify::defaultFieldWindow(volume))};
}

} // namespace pellucid::bench
