// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpr/reslice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/mpr/linear_samples.h"

namespace pellucid::mpr {

namespace {

constexpr float outside = std::numeric_limits<float>::quiet_NaN();

// The samples of a volume, with the parts of its lattice that a lookup needs.
template <class T> class Samples {
public:
    Samples(const T *samples, const volume::GridSize &n)
        : m_samples(samples), m_last(n.i - 1, n.j - 1, n.k - 1),
          m_lower(std::max(0, n.i - 2), std::max(0, n.j - 2), std::max(0, n.k - 2)),
          m_row(std::ptrdiff_t(n.i)), m_slice(std::ptrdiff_t(n.i) * n.j), m_nextX(n.i > 1 ? 1 : 0),
          m_nextY(n.j > 1 ? m_row : 0), m_nextZ(n.k > 1 ? m_slice : 0) {}

    // The range [first, end) of the `count` points p + c step that are inside.
    void within(const glm::dvec3 &p, const glm::dvec3 &step, int count, int &first,
                int &end) const {
        double low = 0.0, high = count - 1.0;
        for (int d = 0; d < 3; ++d) {
            if (step[d] == 0.0) {
                if (!(p[d] >= -0.5 && p[d] <= m_last[d] + 0.5))
                    high = -1.0;
                continue;
            }
            const double a = (-0.5 - p[d]) / step[d], b = (m_last[d] + 0.5 - p[d]) / step[d];
            low = std::max(low, std::min(a, b));
            high = std::min(high, std::max(a, b));
        }
        if (!(low <= high)) { // also false for NaN
            first = end = 0;
            return;
        }
        first = int(std::ceil(low));
        end = int(std::floor(high)) + 1;
    }

    // *Requires*: the point is inside.
    float linear(const glm::dvec3 &p) const {
        const double x = std::clamp(p.x, 0.0, m_last.x), y = std::clamp(p.y, 0.0, m_last.y),
                     z = std::clamp(p.z, 0.0, m_last.z);
        const int i = std::min(int(x), m_lower.x), j = std::min(int(y), m_lower.y),
                  k = std::min(int(z), m_lower.z);
        const auto fx = float(x - i), fy = float(y - j), fz = float(z - k);
        const T *const s = m_samples + k * m_slice + j * m_row + i;
        const auto row = [&](const T *r) {
            const auto a = float(r[0]);
            return a + fx * (float(r[m_nextX]) - a);
        };
        const float a = row(s), b = row(s + m_nextY), c = row(s + m_nextZ),
                    d = row(s + m_nextZ + m_nextY);
        const float ab = a + fy * (b - a), cd = c + fy * (d - c);
        return ab + fz * (cd - ab);
    }
    float nearest(const glm::dvec3 &p) const {
        const auto index = [](double at, double last) {
            return int(std::clamp(at + 0.5, 0.0, last + 0.5));
        };
        return float(m_samples[index(p.z, m_last.z) * m_slice + index(p.y, m_last.y) * m_row +
                               index(p.x, m_last.x)]);
    }

private:
    const T *m_samples;
    glm::dvec3 m_last;
    glm::ivec3 m_lower;
    std::ptrdiff_t m_row, m_slice, m_nextX, m_nextY, m_nextZ;
};

// Offsets from the middle of a slab at which it is sampled, and their weights in its mean by the
// trapezoidal rule.
struct Node {
    double mm, weight;
};
std::vector<Node> nodesOf(double thicknessMm, double stepMm) {
    if (!(thicknessMm > 0.0))
        return {{0.0, 1.0}};
    const double half = 0.5 * thicknessMm;
    std::vector<double> at{-half};
    const int steps = int(std::ceil(half / stepMm - 1e-9)) - 1; // excluding the faces
    for (int k = -steps; k <= steps; ++k)
        at.push_back(k * stepMm);
    at.push_back(half);
    std::vector<Node> nodes;
    for (std::size_t n = 0; n < at.size(); ++n) {
        const double before = n == 0 ? at[n] : at[n - 1],
                     after = n + 1 == at.size() ? at[n] : at[n + 1];
        nodes.push_back({at[n], 0.5 * (after - before) / thicknessMm});
    }
    return nodes;
}

// A part of a row: the slab at its points, node by node.
class SlabRun {
public:
    static constexpr int most = SampleLine::maxPoints;

    SlabRun(SlabMode mode, int count) : m_mode(mode), m_count(count) {
        m_values.fill(empty());
        m_weights.fill(0.0F);
    }
    // Adds the values of the points from `first` on; NaN counts as outside.
    void add(const float *values, int first, int end, float weight) {
        float *const held = m_values.data() + first, *const weights = m_weights.data() + first;
        const int count = end - first;
        if (m_mode == SlabMode::maximum) {
            for (int c = 0; c < count; ++c)
                held[c] = values[c] > held[c] ? values[c] : held[c];
        } else if (m_mode == SlabMode::minimum) {
            for (int c = 0; c < count; ++c)
                held[c] = values[c] < held[c] ? values[c] : held[c];
        } else {
            for (int c = 0; c < count; ++c) {
                const bool isNumber = values[c] == values[c];
                held[c] += isNumber ? weight * values[c] : 0.0F;
                weights[c] += isNumber ? weight : 0.0F;
            }
        }
    }
    // Adds the values of one point at several nodes.
    void addTo(int point, const float *values, const Node *nodes, int count) {
        float held = m_values[std::size_t(point)], weight = m_weights[std::size_t(point)];
        for (int n = 0; n < count; ++n) {
            const float v = values[n];
            if (m_mode == SlabMode::maximum)
                held = v > held ? v : held;
            else if (m_mode == SlabMode::minimum)
                held = v < held ? v : held;
            else if (v == v) {
                held += float(nodes[n].weight) * v;
                weight += float(nodes[n].weight);
            }
        }
        m_values[std::size_t(point)] = held;
        m_weights[std::size_t(point)] = weight;
    }
    void store(float *out, std::ptrdiff_t gap) const {
        for (int c = 0; c < m_count; ++c, out += gap) {
            const float held = m_values[std::size_t(c)];
            // A point without values becomes NaN.
            *out = m_mode == SlabMode::mean ? held / m_weights[std::size_t(c)]
                   : held == empty()        ? outside
                                            : held;
        }
    }

private:
    float empty() const {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        return m_mode == SlabMode::maximum   ? -infinity
               : m_mode == SlabMode::minimum ? infinity
                                             : 0.0F;
    }

    SlabMode m_mode;
    int m_count;
    std::array<float, most> m_values, m_weights;
};

// Values along lines through a volume, by vector code if 32-bit indices are enough for its samples.
template <class T> class Lines {
public:
    Lines(std::span<const T> samples, const volume::GridSize &size, Interpolation interpolation)
        : m_data(samples.data()), m_size(size), m_samples(samples.data(), size),
          m_interpolation(interpolation) {}

    // *Requires*: `count` is at most maxPoints. The points of [first, end) are inside.
    void sample(const glm::dvec3 &start, const glm::dvec3 &step, int count, float *values,
                int &first, int &end) const {
        m_samples.within(start, step, count, first, end);
        if (first >= end)
            return;
        const glm::dvec3 from = start + double(first) * step;
        // 32-bit indices count the samples of a line, and neighbours along rows are read in pairs.
        const double reach = SampleLine::maxPoints * (std::abs(step.z) + std::abs(step.y)) + 4.0;
        if (m_interpolation == Interpolation::linear && m_size.i > 1 &&
            reach * m_size.i * m_size.j < double(1 << 29)) {
            linearSamples(m_data, m_size, {from, step, end - first}, values);
            return;
        }
        for (int c = 0; c < end - first; ++c) {
            const glm::dvec3 p = from + double(c) * step;
            values[c] = m_interpolation == Interpolation::linear ? m_samples.linear(p)
                                                                 : m_samples.nearest(p);
        }
    }

private:
    const T *m_data;
    volume::GridSize m_size;
    Samples<T> m_samples;
    Interpolation m_interpolation;
};

// A picture as an array of runs, each along `lane`. *Units*: voxels per pixel and per mm.
struct Grid {
    glm::dvec3 first, lane, next, perMm;
    int lanes = 0, runs = 0;
    std::ptrdiff_t laneGap = 0, runGap = 0; ///< strides in the picture
};

Grid gridOf(const volume::Lattice &lattice, const Plane &plane) {
    Grid grid;
    grid.first = lattice.voxel(plane.at(0, 0)).v;
    const glm::dvec3 right = lattice.voxel(plane.at(1, 0)).v - grid.first,
                     down = lattice.voxel(plane.at(0, 1)).v - grid.first;
    grid.perMm = lattice.voxel({plane.at(0, 0).mm + plane.axes.toViewer()}).v - grid.first;
    // Lanes follow the volume's rows as far as possible, because their samples are adjacent in
    // memory.
    if (std::abs(right.x) >= std::abs(down.x)) {
        grid.lane = right;
        grid.next = down;
        grid.lanes = plane.width;
        grid.runs = plane.height;
        grid.laneGap = 1;
        grid.runGap = plane.width;
    } else {
        grid.lane = down;
        grid.next = right;
        grid.lanes = plane.height;
        grid.runs = plane.width;
        grid.laneGap = plane.width;
        grid.runGap = 1;
    }
    return grid;
}

// Adds the values of a run of points at the nodes of a slab.
template <class T>
void addNodes(SlabRun &run, const Lines<T> &lines, const glm::dvec3 &start, int lanes,
              const Grid &grid, const std::vector<Node> &nodes) {
    std::array<float, SampleLine::maxPoints> values;
    int first, end;
    const auto addRun = [&](const Node &node) {
        lines.sample(start + node.mm * grid.perMm, grid.lane, lanes, values.data(), first, end);
        run.add(values.data(), first, end, float(node.weight));
    };
    const int inner = int(nodes.size()) - 2; // nodes between the faces are evenly spaced
    const glm::dvec3 step = inner > 1 ? (nodes[2].mm - nodes[1].mm) * grid.perMm : glm::dvec3(0.0);
    if (inner <= 1 || std::abs(step.x) <= std::abs(grid.lane.x)) {
        for (const Node &node : nodes)
            addRun(node);
        return;
    }
    // The slab's thickness is along the rows of the volume, so nodes become lanes.
    addRun(nodes.front());
    addRun(nodes.back());
    for (int c = 0; c < lanes; ++c)
        for (int n = 0; n < inner; n += SampleLine::maxPoints) {
            const Node *const at = &nodes[std::size_t(n + 1)];
            lines.sample(start + double(c) * grid.lane + at->mm * grid.perMm, step,
                         std::min(inner - n, SampleLine::maxPoints), values.data(), first, end);
            run.addTo(c, values.data(), at + first, end - first);
        }
}

// Works in tiles, so that samples shared by the nodes of a slab are read once: they are close
// together in every direction.
constexpr int tileLanes = SlabRun::most, tileRuns = 16;

template <class T>
void fill(SliceImage &image, const Lines<T> &lines, const Grid &grid,
          const std::vector<Node> &nodes, SlabMode mode) {
    const int across = (grid.lanes + tileLanes - 1) / tileLanes,
              down = (grid.runs + tileRuns - 1) / tileRuns;
    tbb::parallel_for(0, across * down, [&](int tile) {
        const int left = tile % across * tileLanes, top = tile / across * tileRuns;
        const int lanes = std::min(tileLanes, grid.lanes - left);
        for (int r = top; r < std::min(top + tileRuns, grid.runs); ++r) {
            SlabRun run(mode, lanes);
            addNodes(run, lines, grid.first + double(r) * grid.next + double(left) * grid.lane,
                     lanes, grid, nodes);
            run.store(image.values.data() + r * grid.runGap + left * grid.laneGap, grid.laneGap);
        }
    });
}

} // namespace

SliceImage reslice(const volume::Volume &volume, const Plane &plane,
                   const ResliceOptions &options) {
    const volume::Lattice &lattice = volume.lattice();
    SliceImage image{plane.width, plane.height,
                     std::vector<float>(std::size_t(plane.width) * plane.height)};
    const Grid grid = gridOf(lattice, plane);
    // Across the slices of a stack: from slice to slice; otherwise at most to the next sample.
    const ScrollRange range = scrollRange(lattice, plane.axes.toViewer());
    const glm::dvec3 perMm = glm::abs(grid.perMm);
    const std::vector<Node> nodes =
        nodesOf(options.slab.thicknessMm,
                range.hasSlices ? range.stepMm
                                : std::min(lattice.shortestStepMm(),
                                           1.0 / std::max({perMm.x, perMm.y, perMm.z})));
    volume.visit([&](auto span) {
        fill(image, Lines(span, lattice.size(), options.interpolation), grid, nodes,
             options.slab.mode);
    });
    return image;
}

float valueAt(const volume::Volume &volume, volume::PatientPoint point,
              Interpolation interpolation) {
    return volume.visit([&](auto span) {
        const Samples samples(span.data(), volume.lattice().size());
        const glm::dvec3 p = volume.lattice().voxel(point).v;
        int first, end;
        samples.within(p, glm::dvec3(0.0), 1, first, end);
        if (first == end)
            return outside;
        return interpolation == Interpolation::linear ? samples.linear(p) : samples.nearest(p);
    });
}

} // namespace pellucid::mpr
