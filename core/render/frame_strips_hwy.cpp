// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/render/frame_strips_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <hwy/highway.h>
#include <utility>

#include "core/render/frame_job.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::render::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using fourier::stripFloats;
using fourier::stripLanes;
using fourier::StripStage;
using fourier::StripTransform;
#include "core/fourier/transforms/strip_transform_hwy.inc"
#include "core/fourier/transforms/transpose_hwy.inc"
#include "core/render/frame_sums_hwy.inc"

// Sixteen frequencies in neighbouring columns: the first column and row, the distances of their
// rows from that, the factors of roll-off and detail, and the place in the strips of the scratch.
struct BatchPlace {
    int column = 0, row = 0;
    const float *rows = nullptr, *rollOff = nullptr;
    std::size_t to = 0;
};

// Included after what they use.
#include "core/render/frame_weights_hwy.inc"

// Rows of a strip that one width reads.
struct Rows {
    int first = 0, last = -1, width = 0;
};

// The batches that one width reads: the rows of a strip, or listed ones.
class Batches {
public:
    Batches(const FrameJob &job, int strip, const Rows &rows)
        : m_job(job), m_bounds(&job.strips[strip]), m_strip(strip), m_first(rows.first),
          m_count(rows.last - rows.first + 1) {}
    Batches(const FrameJob &job, std::span<const StripLine> listed)
        : m_job(job), m_listed(listed.data()), m_count(int(listed.size())) {}

    int count() const { return m_count; }
    HWY_INLINE BatchPlace operator[](int n) const {
        if (m_listed != nullptr)
            return {m_listed[n].strip * stripLanes, m_listed[n].row, m_listed[n].rows,
                    m_listed[n].rollOff, std::size_t(n) * stripFloats};
        const int row = m_first + n, ring = std::abs(row) - m_bounds->innerRow - 1;
        return {m_strip * stripLanes, row, nullptr,
                ring < 0 ? nullptr
                         : m_job.rollOff + m_bounds->rollOff + std::size_t(ring) * stripLanes,
                std::size_t(row < 0 ? row + m_job.rows : row) * stripFloats};
    }

private:
    const FrameJob &m_job;
    const StripBounds *m_bounds = nullptr;
    const StripLine *m_listed = nullptr;
    int m_strip = 0, m_first = 0, m_count = 0;
};

#include "core/render/frame_shading_hwy.inc"

// The slice of one spectrum without cue and light, as in most frames.
template <int W, class Cell>
void interpolatePlain(const FrameJob &job, const Batches &batches, FrameScratch &scratch) {
    const auto *const cells = reinterpret_cast<const Cell *>(job.sources[0].cells);
    const auto batchOf = [&](int n) -> FrequencyBatch & {
        return scratch.batches[n % (batchesAhead + 1)];
    };
    const auto prepare = [&](int n) {
        const BatchPlace place = batches[n];
        prepareBatch<W, false>(job, place, 0, batchOf(n));
    };
    const int count = batches.count();
    for (int n = 0; n < std::min(batchesAhead, count); ++n) {
        prepare(n);
        prefetchPart<W>(batchOf(n), cells, 0, 1);
    }
    HWY_ALIGN float sums[stripFloats];
    for (int n = 0; n < count; ++n) {
        const int ahead = std::min(n + batchesAhead, count - 1);
        if (ahead == n + batchesAhead)
            prepare(ahead);
        const BatchPlace place = batches[n];
        sumBatch<W, false>(batchOf(n), batchOf(ahead), cells, sums, nullptr);
        if (place.column == 0 && place.row == 0) {
            sums[0] = float(job.zero[0][0].value);
            sums[1] = 0.0F;
        }
        finishBatch(job, batchOf(n), sums, place.column, place.row, scratch.strips[0] + place.to);
    }
}

template <int W, class Cell>
void interpolate(const FrameJob &job, const Batches &batches, FrameScratch &scratch) {
    if (job.shading != nullptr && job.shading->cued)
        interpolateMixed<W, true, true, Cell>(job, batches, scratch);
    else if (job.shading != nullptr)
        interpolateMixed<W, true, false, Cell>(job, batches, scratch);
    else if (job.sourceCount > 1)
        interpolateMixed<W, false, false, Cell>(job, batches, scratch);
    else
        interpolatePlain<W, Cell>(job, batches, scratch);
}

// Sets rows of the strip to zero.
void clearRows(const FrameJob &job, const Rows &rows, FrameScratch &scratch) {
    const auto clear = [&](int first, int last) {
        for (int c = 0; c < job.imageCount && first <= last; ++c)
            std::memset(scratch.strips[std::size_t(c)] + std::size_t(first) * stripFloats, 0,
                        std::size_t(last - first + 1) * stripFloats * sizeof(float));
    };
    clear(std::max(rows.first, 0), rows.last);
    clear(rows.first + job.rows, std::min(rows.last, -1) + job.rows);
}

template <class Cell>
void interpolateBy(int width, const FrameJob &job, const Batches &batches, FrameScratch &scratch) {
    switch (width) {
    case 1:
        return interpolate<1, Cell>(job, batches, scratch);
    case 2:
        return interpolate<2, Cell>(job, batches, scratch);
    case 3:
        return interpolate<3, Cell>(job, batches, scratch);
    case 4:
        return interpolate<4, Cell>(job, batches, scratch);
    case 5:
        return interpolate<5, Cell>(job, batches, scratch);
    case 6:
        return interpolate<6, Cell>(job, batches, scratch);
    default:
        return interpolate<7, Cell>(job, batches, scratch);
    }
}

template <class Cell>
void interpolateRows(const FrameJob &job, int strip, const Rows &rows, FrameScratch &scratch) {
    if (rows.width == 0)
        clearRows(job, rows, scratch);
    else
        interpolateBy<Cell>(rows.width, job, Batches(job, strip, rows), scratch);
}

// The first row of a tile of the width map.
int firstRow(const FrameJob &job, std::size_t tile) {
    return (int(tile) - job.widthMap->tiles) * widths::SliceTiles::rows;
}

// The last row of a strip that is not zero; -1: none.
int lastRow(const FrameJob &job, int strip) {
    const int inDisc = job.strips[strip].outerRow;
    if (job.widthMap == nullptr)
        return inDisc;
    int last = -1;
    const auto widths = job.widthMap->strip(strip);
    for (std::size_t tile = 0; tile < widths.size(); ++tile)
        if (widths[tile] != 0)
            last = std::max({last, -firstRow(job, tile), firstRow(job, tile + 1) - 1});
    return std::min(inDisc, last);
}

// Sets the rows up to `last` on both sides.
template <class Cell>
void interpolateStrip(const FrameJob &job, int strip, int last, FrameScratch &scratch) {
    if (job.widthMap == nullptr)
        return interpolateRows<Cell>(job, strip, {-last, last, job.layout->width()}, scratch);
    static_assert(widths::SliceTiles::columns == stripLanes);
    const auto widths = job.widthMap->strip(strip);
    for (std::size_t tile = 0, next = 0; tile < widths.size(); tile = next) {
        while (next < widths.size() && widths[next] == widths[tile])
            ++next;
        const Rows rows{std::max(-last, firstRow(job, tile)),
                        std::min(last, firstRow(job, next) - 1), widths[tile]};
        if (rows.first <= rows.last)
            interpolateRows<Cell>(job, strip, rows, scratch);
    }
}

void sliceOneStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    const double start = frameClockSeconds();
    const int last = lastRow(job, strip);
    if (last < 0)
        clearRows(job, {0, 0, 0}, scratch);
    else if (job.layout->storage == fourier::Storage::binary16)
        interpolateStrip<Half>(job, strip, last, scratch);
    else
        interpolateStrip<std::complex<float>>(job, strip, last, scratch);
    scratch.sliceSeconds += frameClockSeconds() - start;

    const int imageRows = std::min(job.imageRows, job.rows);
    const std::size_t columns = std::size_t(job.stripCount) * stripLanes;
    for (std::size_t c = 0; c < std::size_t(job.imageCount); ++c) {
        const float *const result =
            runTransform(*job.alongRows, scratch.strips[c], scratch.spare, std::max(last, 0));
        for (int row = 0; row < imageRows; row += stripLanes) {
            const float *const from = result + std::size_t(row) * stripFloats;
            float *const to =
                job.lines[c] +
                ((std::size_t(row) / stripLanes) * columns + std::size_t(strip) * 16) * stripFloats;
            transpose(from, stripFloats, to, stripFloats);
            transpose(from + stripLanes, stripFloats, to + stripLanes, stripFloats);
        }
    }
    scratch.stripSeconds += frameClockSeconds() - start;
}

void readListed(const FrameJob &job, std::span<const StripLine> lines, int width,
                FrameScratch &scratch) {
    if (job.layout->storage == fourier::Storage::binary16)
        interpolateBy<Half>(width, job, Batches(job, lines), scratch);
    else
        interpolateBy<std::complex<float>>(width, job, Batches(job, lines), scratch);
}

const char *targetName() {
    return hwy::TargetName(HWY_TARGET);
}

} // namespace pellucid::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::render {

HWY_EXPORT(sliceOneStrip);
HWY_EXPORT(readListed);
HWY_EXPORT(targetName);

void sliceStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    HWY_DYNAMIC_DISPATCH(sliceOneStrip)(job, strip, scratch);
}

void readLines(const FrameJob &job, std::span<const StripLine> lines, int width,
               FrameScratch &scratch) {
    HWY_DYNAMIC_DISPATCH(readListed)(job, lines, width, scratch);
}

const char *instructionSet() {
    return HWY_DYNAMIC_DISPATCH(targetName)();
}

double frameClockSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

} // namespace pellucid::render
#endif
