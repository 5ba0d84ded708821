// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/edges.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tbb/parallel_for.h>

#include "core/preprocess/filters.h"
#include "core/preprocess/reasons.h"
#include "core/task/error.h"

namespace pellucid::preprocess {

namespace {

// Samples with derivatives in the lattice's metric. The unit of length is the shortest step, so
// that derivatives on an isotropic lattice are differences, as in other implementations.
class Derivatives {
public:
    Derivatives(const volume::Lattice &lattice, const float *samples)
        : m_samples(samples), m_size(lattice.size()) {
        const glm::dmat3 steps(lattice.step(0), lattice.step(1), lattice.step(2));
        const glm::dmat3 inverse = glm::inverse(steps);
        glm::dmat3 metric;
        const double unit = lattice.shortestStepMm();
        for (int d = 0; d < 3; ++d)
            for (int e = 0; e < 3; ++e) {
                const glm::dvec3 a(inverse[0][d], inverse[1][d], inverse[2][d]);
                const glm::dvec3 b(inverse[0][e], inverse[1][e], inverse[2][e]);
                metric[d][e] = unit * unit * glm::dot(a, b);
            }
        for (int d = 0; d < 3; ++d)
            for (int e = 0; e < 3; ++e)
                m_metric[d][e] = float(metric[d][e]);
    }

    float at(int i, int j, int k) const { return m_samples[m_size.offsetOf(i, j, k)]; }
    // Neighbours of a sample; beyond the border the outermost sample is repeated.
    struct Around {
        int im, i, ip, jm, j, jp, km, k, kp;
    };
    Around around(int i, int j, int k) const {
        return {std::max(i - 1, 0), i, std::min(i + 1, m_size.i - 1),
                std::max(j - 1, 0), j, std::min(j + 1, m_size.j - 1),
                std::max(k - 1, 0), k, std::min(k + 1, m_size.k - 1)};
    }
    std::array<float, 3> differences(const Around &n) const {
        return {0.5F * (at(n.ip, n.j, n.k) - at(n.im, n.j, n.k)),
                0.5F * (at(n.i, n.jp, n.k) - at(n.i, n.jm, n.k)),
                0.5F * (at(n.i, n.j, n.kp) - at(n.i, n.j, n.km))};
    }
    // The gradient's contravariant components, along the steps of the lattice.
    std::array<float, 3> raised(const std::array<float, 3> &d) const {
        std::array<float, 3> g{};
        for (int a = 0; a < 3; ++a)
            g[a] = m_metric[a][0] * d[0] + m_metric[a][1] * d[1] + m_metric[a][2] * d[2];
        return g;
    }
    static float product(const std::array<float, 3> &a, const std::array<float, 3> &b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    // The second derivative along the gradient. It is reduced where the gradient is below `flat`,
    // because the direction of a tiny gradient is arbitrary.
    float alongGradient(int i, int j, int k, float flat) const {
        const Around n = around(i, j, k);
        const auto d = differences(n);
        const auto g = raised(d);
        const float center = at(i, j, k);
        const float xx = at(n.ip, n.j, n.k) + at(n.im, n.j, n.k) - 2.0F * center;
        const float yy = at(n.i, n.jp, n.k) + at(n.i, n.jm, n.k) - 2.0F * center;
        const float zz = at(n.i, n.j, n.kp) + at(n.i, n.j, n.km) - 2.0F * center;
        const float xy =
            0.25F * (at(n.im, n.jm, k) - at(n.im, n.jp, k) - at(n.ip, n.jm, k) + at(n.ip, n.jp, k));
        const float xz =
            0.25F * (at(n.im, j, n.km) - at(n.im, j, n.kp) - at(n.ip, j, n.km) + at(n.ip, j, n.kp));
        const float yz =
            0.25F * (at(i, n.jm, n.km) - at(i, n.jm, n.kp) - at(i, n.jp, n.km) + at(i, n.jp, n.kp));
        const float sum = g[0] * g[0] * xx + g[1] * g[1] * yy + g[2] * g[2] * zz +
                          2.0F * (g[0] * g[1] * xy + g[0] * g[2] * xz + g[1] * g[2] * yz);
        const float square = product(d, g);
        return square > 0.0F ? sum / (square + flat * flat) : 0.0F;
    }

private:
    const float *m_samples;
    volume::GridSize m_size;
    std::array<std::array<float, 3>, 3> m_metric{};
};

// Whether the sign changes between a sample and a neighbour, and the sample is nearer to the
// change; if both are equally near, the later one counts.
bool crosses(float here, float there, bool thereIsLater) {
    const bool changes = (here < 0.0F && there > 0.0F) || (here > 0.0F && there < 0.0F) ||
                         ((here == 0.0F) != (there == 0.0F));
    if (!changes)
        return false;
    const float a = std::abs(here), b = std::abs(there);
    return a < b || (a == b && thereIsLater);
}

std::vector<float> floatsOf(const volume::Volume &volume) {
    return volume.visit(
        [](auto samples) { return std::vector<float>(samples.begin(), samples.end()); });
}

template <class F>
void forPlanes(const volume::GridSize &size, const task::Progress &progress, const F &f) {
    tbb::parallel_for(0, size.k, [&](int k) {
        progress.check();
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                f(i, j, k, size.offsetOf(i, j, k));
    });
}

// All samples above `low` that are connected to a sample above `high`.
Mask linked(const volume::GridSize &size, const std::vector<float> &strength, float low,
            float high) {
    Mask edges(strength.size(), 0);
    std::vector<std::size_t> open;
    for (std::size_t start = 0; start < strength.size(); ++start) {
        if (!(strength[start] > high) || edges[start] != 0)
            continue;
        edges[start] = 1;
        open.push_back(start);
        while (!open.empty()) {
            const std::size_t at = open.back();
            open.pop_back();
            const int i = int(at % std::size_t(size.i)), j = int(at / std::size_t(size.i) % size.j),
                      k = int(at / (std::size_t(size.i) * size.j));
            for (int z = std::max(k - 1, 0); z <= std::min(k + 1, size.k - 1); ++z)
                for (int y = std::max(j - 1, 0); y <= std::min(j + 1, size.j - 1); ++y)
                    for (int x = std::max(i - 1, 0); x <= std::min(i + 1, size.i - 1); ++x) {
                        const std::size_t next = size.offsetOf(x, y, z);
                        if (strength[next] > low && edges[next] == 0) {
                            edges[next] = 1;
                            open.push_back(next);
                        }
                    }
        }
    }
    return edges;
}

} // namespace

volume::Volume gradientMagnitude(const volume::Volume &volume, const task::Progress &progress) {
    const volume::Lattice &lattice = volume.lattice();
    return task::orOutOfMemory(task::because::noMemoryToFindEdges, [&] {
        const std::vector<float> values = floatsOf(volume);
        std::vector<float> result(values.size());
        const Derivatives derivatives(lattice, values.data());
        const auto perMm = float(1.0 / lattice.shortestStepMm());
        forPlanes(lattice.size(), progress, [&](int i, int j, int k, std::size_t n) {
            const auto d = derivatives.differences(derivatives.around(i, j, k));
            const float square = Derivatives::product(d, derivatives.raised(d));
            result[n] = perMm * std::sqrt(std::max(0.0F, square));
        });
        progress.report(1.0);
        return volume::Volume(lattice, std::move(result), volume::ValueUnit::none, volume.notes());
    });
}

Mask cannyEdges(const volume::Volume &volume, const CannyOptions &options,
                const task::Progress &progress) {
    const volume::Lattice &lattice = volume.lattice();
    const volume::GridSize size = lattice.size();
    return task::orOutOfMemory(task::because::noMemoryToFindEdges, [&] {
        const std::vector<float> smooth = floatsOf(
            options.sigmaMm > 0.0 ? gaussian(volume, options.sigmaMm, progress.part(0.0, 0.5))
                                  : volume);
        const Derivatives ofValues(lattice, smooth.data());
        std::vector<float> second(smooth.size()), strength(smooth.size());
        const double unit = lattice.shortestStepMm();
        // Far below the gradient of an edge at any scale of the values.
        const auto flat = float(2.5e-4 * unit * options.high);
        forPlanes(size, progress, [&](int i, int j, int k, std::size_t n) {
            second[n] = ofValues.alongGradient(i, j, k, flat);
        });
        progress.report(0.7);
        const Derivatives ofSecond(lattice, second.data());
        forPlanes(size, progress, [&](int i, int j, int k, std::size_t n) {
            const auto around = ofSecond.around(i, j, k);
            const float here = second[n];
            const bool isCrossing = crosses(here, ofSecond.at(around.im, j, k), false) ||
                                    crosses(here, ofSecond.at(i, around.jm, k), false) ||
                                    crosses(here, ofSecond.at(i, j, around.km), false) ||
                                    crosses(here, ofSecond.at(around.ip, j, k), true) ||
                                    crosses(here, ofSecond.at(i, around.jp, k), true) ||
                                    crosses(here, ofSecond.at(i, j, around.kp), true);
            if (!isCrossing)
                return;
            const auto d = ofValues.differences(around);
            const auto g = ofValues.raised(d);
            // If the second derivative falls along the gradient, the magnitude has a maximum.
            if (Derivatives::product(ofSecond.differences(around), g) <= 0.0F)
                strength[n] = std::sqrt(std::max(0.0F, Derivatives::product(d, g)));
        });
        progress.report(0.9);
        Mask edges = linked(size, strength, float(unit * options.low), float(unit * options.high));
        progress.report(1.0);
        return edges;
    });
}

} // namespace pellucid::preprocess
