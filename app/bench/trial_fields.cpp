// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/trial_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>

namespace pellucid::bench {

namespace {

// The parameters of all shapes.
struct ShapeParameters {
    glm::dvec3 normal, place, across;
    double width, other, more;
};

double gauss(double x) {
    return std::exp(-x * x);
}

// A rod, oblique or along an axis, with a diffuse blob in the middle.
Shape rod(const ShapeParameters &p) {
    const glm::dvec3 axis = p.more < 0.5 ? p.normal : glm::dvec3(0, 0, 1);
    return {[=](const glm::dvec3 &x) {
                const glm::dvec3 off = x - p.place;
                const double far = glm::length(off - glm::dot(off, axis) * axis);
                return gauss(far / p.width) + 0.3 * p.other * gauss(2.0 * glm::length(x));
            },
            axis};
}

// Its worst view is edge-on.
Shape sheet(const ShapeParameters &p) {
    return {
        [=](const glm::dvec3 &x) { return gauss(glm::dot(x - 0.7 * p.place, p.normal) / p.width); },
        p.across};
}

// The shell may extend beyond the lattice.
Shape shell(const ShapeParameters &p) {
    return {[=](const glm::dvec3 &x) {
                return gauss((glm::length(x - 0.4 * p.place) - 0.3 - 0.9 * p.other) / p.width);
            },
            p.across};
}

Shape slabs(const ShapeParameters &p) {
    return {[=](const glm::dvec3 &x) {
                const double wave = std::sin(glm::dot(x, p.normal) * (3.0 + 40.0 * p.other));
                return wave > 1.8 * p.more - 0.9 ? 1.0 : 0.0;
            },
            p.across};
}

// Waves that get finer outward.
Shape chirp(const ShapeParameters &p) {
    return {[=](const glm::dvec3 &x) {
                const double t = glm::dot(x - 0.5 * p.place, p.normal);
                return 0.5 + 0.5 * std::sin((5.0 + 30.0 * p.other) * t * t);
            },
            p.across};
}

// A body with bone, cut off by the lattice.
Shape body(const ShapeParameters &p) {
    return {[=](const glm::dvec3 &x) {
                const glm::dvec3 y =
                    (x - 0.5 * p.place) / glm::dvec3(0.6 + p.other, 0.9, 0.6 + p.more);
                const double r = glm::length(y);
                return r < 1.0 ? (r > 0.9 ? 0.8 : 0.3 + 0.02 * std::sin(40.0 * x.x * x.y)) : 0.0;
            },
            p.normal};
}

Shape cloud(const ShapeParameters &p) {
    return {[=](const glm::dvec3 &x) {
                return gauss(glm::length((x - p.place) / (0.1 + 1.5 * p.other)));
            },
            p.normal};
}

Shape faintCloud(const ShapeParameters &p) {
    return {
        [=](const glm::dvec3 &x) { return gauss(glm::length(x - 0.3 * p.place)) * 0.05 * p.other; },
        p.normal};
}

// Writes samples that are not a function of position.
class SampleWriter {
public:
    SampleWriter(Genes &genes, const volume::GridSize &size, std::vector<float> &samples)
        : m_genes(genes), m_size(size), m_samples(samples) {}

    void addPoints(float brightness) {
        const auto side = [&](int n) { return std::min(n - 1, int(m_genes.next() * n)); };
        const int count = 1 + m_genes.choice(4);
        for (int n = 0; n < count; ++n) {
            const int i = side(m_size.i), j = side(m_size.j), k = side(m_size.k);
            at(i, j, k) = float(m_genes.between(0.2, 1.0)) * brightness;
        }
    }

    // Two opposite corners.
    void addCorners() {
        const auto end = [&](int n) { return m_genes.next() < 0.5 ? 0 : n - 1; };
        const int i = end(m_size.i), j = end(m_size.j), k = end(m_size.k);
        at(i, j, k) = 1.0F;
        at(m_size.i - 1 - i, m_size.j - 1 - j, m_size.k - 1 - k) = float(m_genes.between(0.3, 1.0));
    }

    // Every second sample along one, two or three axes.
    void addPattern() {
        const std::array<bool, 3> alternates{true, m_genes.next() < 0.5, m_genes.next() < 0.3};
        const int turned = m_genes.choice(3);
        const float between = m_genes.next() < 0.5 ? 0.0F : float(m_genes.between(0.0, 0.9));
        for (int k = 0; k < m_size.k; ++k)
            for (int j = 0; j < m_size.j; ++j)
                for (int i = 0; i < m_size.i; ++i) {
                    const std::array<int, 3> n{i, j, k};
                    bool isBright = true;
                    for (int d = 0; d < 3; ++d)
                        isBright = isBright && (n[std::size_t(d)] % 2 == 1 ||
                                                !alternates[std::size_t((d + turned) % 3)]);
                    at(i, j, k) = isBright ? 1.0F : between;
                }
    }

    // Positive noise, from white to smooth.
    void addNoise() {
        std::minstd_rand random(unsigned(1.0 + 1e6 * m_genes.next()));
        std::uniform_real_distribution<float> value(0.0F, 1.0F);
        const float keep = float(m_genes.between(0.0, 0.95));
        float before = 0.5F;
        for (float &sample : m_samples)
            sample = before = keep * before + (1.0F - keep) * value(random);
    }

private:
    float &at(int i, int j, int k) { return m_samples[m_size.offsetOf(i, j, k)]; }

    Genes &m_genes;
    volume::GridSize m_size;
    std::vector<float> &m_samples;
};

} // namespace

const char *fieldKindName(FieldKind kind) {
    constexpr std::array<const char *, fieldKinds> names{"points", "corners", "rods",  "sheet",
                                                         "shell",  "comb",    "chirp", "body",
                                                         "noise",  "cloud",   "metal", "pattern"};
    return names[std::size_t(kind)];
}

volume::Lattice latticeOf(Genes &genes) {
    constexpr std::array<volume::GridSize, 8> sizes{{{24, 24, 24},
                                                     {32, 32, 32},
                                                     {40, 24, 16},
                                                     {17, 23, 29},
                                                     {32, 32, 4},
                                                     {36, 36, 7},
                                                     {12, 40, 12},
                                                     {45, 45, 45}}};
    constexpr std::array<double, 5> thick{1.0, 1.0, 2.0, 5.0, 0.5};
    const volume::GridSize size = sizes[std::size_t(genes.choice(int(sizes.size())))];
    const double step = thick[std::size_t(genes.choice(int(thick.size())))];
    const double tilt = genes.next() < 0.5 ? 0.0 : genes.between(0.0, 0.5);
    return volume::Lattice::make(size, {{-11.0, 7.0, 3.0}},
                                 {glm::dvec3(1, 0, 0),
                                  glm::dvec3(0, std::cos(tilt), -std::sin(tilt)),
                                  step / std::cos(tilt) * glm::dvec3(0, 0, 1)});
}

Shape shapeOf(FieldKind kind, Genes &genes, const volume::Lattice &lattice) {
    const glm::dvec3 n(lattice.size().i, lattice.size().j, lattice.size().k);
    const glm::dvec3 normal = genes.direction(),
                     place(genes.between(-1.0, 1.0), genes.between(-1.0, 1.0),
                           genes.between(-1.0, 1.0));
    const double width = 2.0 * genes.between(0.3, 3.0) / std::max({n.x, n.y, n.z}),
                 other = genes.next(), more = genes.next();
    const glm::dvec3 across = glm::normalize(
        glm::cross(normal, std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const ShapeParameters parameters{normal, place, across, width, other, more};
    switch (kind) {
    case FieldKind::rods:
        return rod(parameters);
    case FieldKind::sheet:
        return sheet(parameters);
    case FieldKind::shell:
        return shell(parameters);
    case FieldKind::comb:
        return slabs(parameters);
    case FieldKind::chirp:
        return chirp(parameters);
    case FieldKind::body:
        return body(parameters);
    case FieldKind::cloud:
        return cloud(parameters);
    case FieldKind::points:
    case FieldKind::corners:
    case FieldKind::noise:
    case FieldKind::metal:
    case FieldKind::pattern:
        break;
    }
    return faintCloud(parameters);
}

std::vector<float> samplesOf(FieldKind kind, const Shape &shape, Genes &genes,
                             const volume::GridSize &size) {
    std::vector<float> samples;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const glm::dvec3 x(2.0 * (i + 0.5) / size.i - 1.0, 2.0 * (j + 0.5) / size.j - 1.0,
                                   2.0 * (k + 0.5) / size.k - 1.0);
                samples.push_back(std::max(0.0F, float(shape.value(x))));
            }
    if (kind == FieldKind::points || kind == FieldKind::corners)
        std::fill(samples.begin(), samples.end(), 0.0F);
    SampleWriter writer(genes, size, samples);
    if (kind == FieldKind::points)
        writer.addPoints(1.0F);
    else if (kind == FieldKind::metal)
        writer.addPoints(30.0F);
    else if (kind == FieldKind::corners)
        writer.addCorners();
    else if (kind == FieldKind::pattern)
        writer.addPattern();
    else if (kind == FieldKind::noise)
        writer.addNoise();
    // Values below 1e-4 of the maximum become 0, so that the field has a bounded support.
    const float maximum = *std::max_element(samples.begin(), samples.end());
    for (float &sample : samples)
        sample = sample < 1e-4F * maximum ? 0.0F : sample / std::max(maximum, 1e-30F);
    return samples;
}

} // namespace pellucid::bench
