// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reference/direct_sum.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace pellucid::reference {

namespace {

// The number of frequencies summed at a time, so that the inner loop has independent sums.
constexpr int batch = 8;
using Lanes = std::array<double, batch>;

struct Rotor {
    Lanes re, im;
};

// exp(-i 2 pi q (n - middle)) for every sample of an axis and every frequency of a batch.
std::vector<Rotor> rotors(int samples, const Lanes &q) {
    std::vector<Rotor> result(samples);
    const double middle = 0.5 * (samples - 1);
    for (int n = 0; n < samples; ++n)
        for (int b = 0; b < batch; ++b) {
            const double angle = -2.0 * std::numbers::pi * q[b] * (n - middle);
            result[n].re[b] = std::cos(angle);
            result[n].im[b] = std::sin(angle);
        }
    return result;
}

void addProduct(Rotor &sum, const Rotor &a, const Rotor &b) {
    for (int n = 0; n < batch; ++n) {
        sum.re[n] += a.re[n] * b.re[n] - a.im[n] * b.im[n];
        sum.im[n] += a.re[n] * b.im[n] + a.im[n] * b.re[n];
    }
}

} // namespace

void directSum(const volume::Field &field, const std::vector<glm::dvec3> &frequencies,
               std::vector<std::complex<double>> &values) {
    const volume::Lattice &lattice = field.lattice();
    const volume::GridSize size = lattice.size();
    const double cell = lattice.cellVolumeMm3();
    std::vector<float> buffer(std::size_t(size.i));
    for (std::size_t start = 0; start < frequencies.size(); start += batch) {
        std::array<Lanes, 3> q{};
        const std::size_t count = std::min<std::size_t>(batch, frequencies.size() - start);
        for (std::size_t b = 0; b < count; ++b)
            for (int d = 0; d < 3; ++d)
                q[d][b] = glm::dot(lattice.step(d), frequencies[start + b]);
        const auto ex = rotors(size.i, q[0]), ey = rotors(size.j, q[1]), ez = rotors(size.k, q[2]);
        Rotor total{};
        for (int k = 0; k < size.k; ++k) {
            Rotor plane{};
            for (int j = 0; j < size.j; ++j) {
                const float *const f = field.row({0, j, k}, size.i, buffer.data());
                Rotor row{};
                for (int i = 0; i < size.i; ++i)
                    for (int b = 0; b < batch; ++b) {
                        row.re[b] += double(f[i]) * ex[i].re[b];
                        row.im[b] += double(f[i]) * ex[i].im[b];
                    }
                addProduct(plane, row, ey[j]);
            }
            addProduct(total, plane, ez[k]);
        }
        for (std::size_t b = 0; b < count; ++b)
            values[start + b] = cell * std::complex<double>(total.re[b], total.im[b]);
    }
}

std::vector<double> directSumImage(const volume::Field &field, const scene::Camera &camera,
                                   const scene::ImageDefinition &image) {
    return sliceImage([&](const auto &s, auto &values) { directSum(field, s, values); },
                      field.lattice(), camera, image);
}

} // namespace pellucid::reference
