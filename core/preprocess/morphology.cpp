// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/morphology.h"

#include <algorithm>
#include <memory>

#include <tbb/parallel_for.h>

namespace pellucid::preprocess {

namespace {

bool isUniform(const Mask &mask) {
    return std::all_of(mask.begin(), mask.end(), [&](std::uint8_t m) { return m == mask.front(); });
}

// A box with more samples on each side, within the grid.
volume::VoxelBox widened(const volume::VoxelBox &box, const int (&by)[3],
                         const volume::GridSize &size) {
    const auto from = [&](int lo, int axis) { return std::max(lo - by[axis], 0); };
    const auto to = [&](int hi, int axis) { return std::min(hi + by[axis], size[axis]); };
    return {{from(box.lo.i, 0), from(box.lo.j, 1), from(box.lo.k, 2)},
            {to(box.hi.i, 0), to(box.hi.j, 1), to(box.hi.k, 2)}};
}

// Finds the samples within a distance of those that have a value in a mask. Squared distances are
// accumulated axis by axis, no farther than the distance. ITK's distance map has no such limit and
// takes ten times as long for anatomical radii.
class Nearness {
public:
    Nearness(const volume::Lattice &lattice, const Mask &mask, std::uint8_t value, double radiusMm)
        : m_size(lattice.size()), m_mask(mask), m_value(value),
          // A distance equal to the radius counts in spite of rounding.
          m_limit(float(radiusMm * radiusMm * (1.0 + 1e-5))) {
        for (int d = 0; d < 3; ++d) {
            m_step[d] = lattice.spacingMm(d);
            m_reach[d] = int(std::min(radiusMm / m_step[d] * (1.0 + 1e-5), double(m_size[d])));
        }
    }

    // *Requires*: the mask contains both values.
    Mask find(const task::Progress &progress) const {
        // Far from the samples of the mask, the result is the same everywhere.
        const int one[3] = {1, 1, 1};
        const volume::VoxelBox box =
            widened(boxAround(m_size, m_mask), m_value == 1 ? m_reach : one, m_size);
        Mask near(m_mask.size(), std::uint8_t(1 - m_value));
        // A part of the slices at a time, with those that it reaches, stays in the caches.
        const int chunk = std::max(8, m_reach[2]);
        const int chunks = (box.hi.k - box.lo.k + chunk - 1) / chunk;
        tbb::parallel_for(0, chunks, [&](int n) {
            progress.check();
            const int first = box.lo.k + n * chunk;
            slices(box, first, std::min(first + chunk, box.hi.k), near);
        });
        progress.report(1.0);
        return near;
    }

private:
    static constexpr float far = 1e30F;

    // The slices from `first` to before `end`.
    void slices(const volume::VoxelBox &box, int first, int end, Mask &near) const {
        const volume::GridSize in = box.size();
        const int from = std::max(first - m_reach[2], box.lo.k),
                  to = std::min(end + m_reach[2], box.hi.k);
        const auto plane = std::size_t(in.i) * std::size_t(in.j);
        const auto alongRows = std::make_unique_for_overwrite<float[]>(plane);
        const auto inSlices =
            std::make_unique_for_overwrite<float[]>(plane * std::size_t(to - from));
        for (int k = from; k < to; ++k) {
            for (int j = 0; j < in.j; ++j)
                measureRow(m_mask.data() + m_size.offsetOf(box.lo.i, box.lo.j + j, k), in.i,
                           alongRows.get() + std::size_t(j) * std::size_t(in.i));
            gatherRows(alongRows.get(), in, inSlices.get() + std::size_t(k - from) * plane);
        }
        std::vector<float> squares(std::size_t(in.i));
        for (int k = first; k < end; ++k)
            for (int j = 0; j < in.j; ++j) {
                std::fill(squares.begin(), squares.end(), far);
                for (int d = std::max(-m_reach[2], from - k); d <= m_reach[2] && k + d < to; ++d)
                    nearer(inSlices.get() + std::size_t(k + d - from) * plane +
                               std::size_t(j) * std::size_t(in.i),
                           in.i, float(d * m_step[2] * d * m_step[2]), squares.data());
                std::uint8_t *const out = near.data() + m_size.offsetOf(box.lo.i, box.lo.j + j, k);
                for (int i = 0; i < in.i; ++i)
                    out[i] = squares[std::size_t(i)] <= m_limit;
            }
    }

    void measureRow(const std::uint8_t *in, int count, float *out) const {
        const auto step = float(m_step[0]);
        float last = far;
        for (int i = 0; i < count; ++i)
            out[i] = last = in[i] == m_value ? 0.0F : last + step;
        last = far;
        for (int i = count - 1; i >= 0; --i) {
            last = in[i] == m_value ? 0.0F : last + step;
            const float least = std::min(out[i], last);
            out[i] = least < far ? least * least : far;
        }
    }

    static void nearer(const float *from, int count, float square, float *to) {
        for (int i = 0; i < count; ++i)
            to[i] = std::min(to[i], from[i] + square);
    }

    // From the rows of a slice to its rows and columns.
    void gatherRows(const float *from, const volume::GridSize &in, float *to) const {
        for (int j = 0; j < in.j; ++j) {
            float *const row = to + std::size_t(j) * std::size_t(in.i);
            std::fill_n(row, in.i, far);
            for (int d = std::max(-m_reach[1], -j); d <= m_reach[1] && j + d < in.j; ++d)
                nearer(from + std::size_t(j + d) * std::size_t(in.i), in.i,
                       float(d * m_step[1] * d * m_step[1]), row);
        }
    }

    volume::GridSize m_size;
    const Mask &m_mask;
    std::uint8_t m_value;
    float m_limit;
    double m_step[3];
    int m_reach[3];
};

Mask inverted(Mask mask) {
    for (std::uint8_t &m : mask)
        m = std::uint8_t(1 - m);
    return mask;
}

Mask grown(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
           const task::Progress &progress) {
    return isUniform(mask) ? mask : Nearness(lattice, mask, 1, radiusMm).find(progress);
}

} // namespace

Mask eroded(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
            const task::Progress &progress) {
    return isUniform(mask) ? mask : inverted(Nearness(lattice, mask, 0, radiusMm).find(progress));
}

Mask opening(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress) {
    const Mask core = eroded(lattice, mask, radiusMm, progress.part(0.0, 0.5));
    return grown(lattice, core, radiusMm, progress.part(0.5, 1.0));
}

Mask closing(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress) {
    const Mask wide = grown(lattice, mask, radiusMm, progress.part(0.0, 0.5));
    return eroded(lattice, wide, radiusMm, progress.part(0.5, 1.0));
}

Mask dilated(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress) {
    return radiusMm > 0.0 ? grown(lattice, mask, radiusMm, progress) : mask;
}

} // namespace pellucid::preprocess
