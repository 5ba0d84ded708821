// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/vec3.hpp>

namespace pellucid::bench {

/// Decodes a sequence of numbers in 0..1 in order. After the last it starts again at the first.
class Genes {
public:
    /// *Requires*: the genes outlive this object.
    explicit Genes(const std::vector<double> &genes) : m_genes(genes) {}
    double next() { return m_genes[m_at++ % m_genes.size()]; }
    double between(double low, double high) { return low + (high - low) * next(); }
    /// One of 0 .. count - 1.
    int choice(int count) { return std::min(count - 1, int(next() * count)); }
    /// A unit vector, uniform over the sphere.
    glm::dvec3 direction() {
        const double z = between(-1.0, 1.0), angle = between(0.0, 2.0 * std::numbers::pi);
        const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

private:
    const std::vector<double> &m_genes;
    std::size_t m_at = 0;
};

} // namespace pellucid::bench
