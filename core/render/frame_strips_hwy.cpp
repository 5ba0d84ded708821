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
#include "core/render/frame_weights_hwy.inc"

// Rows of a strip that one width reads.
struct Rows {
    int first = 0, last = -1, width = 0;
};

// Included after the two files that it uses.
#include "core/render/frame_shading_hwy.inc"

// Rows of a strip of the slice of one spectrum without cue and light, as in most frames.
template <int W, class Cell>
void interpolatePlain(const FrameJob &job, int strip, const Rows &rows, FrameScratch &scratch) {
    const StripBounds &bounds = job.strips[strip];
    const int column = strip * stripLanes;
    const auto *const cells = reinterpret_cast<const Cell *>(job.sources[0].cells);
    const auto batchOf = [&](int row) -> FrequencyBatch & {
        return scratch.batches[(row + job.rows) % (batchesAhead + 1)];
    };
    const auto prepare = [&](int row) {
        const int ring = std::abs(row) - bounds.innerRow - 1;
        prepareBatch<W, false>(
            job, column, row, 0,
            ring < 0 ? nullptr : job.rollOff + bounds.rollOff + std::size_t(ring) * stripLanes,
            batchOf(row));
    };
    const int first = rows.first, last = rows.last;
    for (int row = first; row < first + batchesAhead && row <= last; ++row) {
        prepare(row);
        prefetchPart<W>(batchOf(row), cells, 0, 1);
    }
    HWY_ALIGN float sums[stripFloats];
    for (int row = first; row <= last; ++row) {
        const int ahead = std::min(row + batchesAhead, last);
        if (ahead == row + batchesAhead)
            prepare(ahead);
        sumBatch<W, false>(batchOf(row), batchOf(ahead), cells, sums, nullptr);
        if (strip == 0 && row == 0) {
            sums[0] = float(job.zero[0][0].value);
            sums[1] = 0.0F;
        }
        finishBatch(job, batchOf(row), sums, column, row,
                    scratch.strips[0] + std::size_t(row < 0 ? row + job.rows : row) * stripFloats);
    }
}

template <int W, class Cell>
void interpolateRows(const FrameJob &job, int strip, const Rows &rows, FrameScratch &scratch) {
    if (job.shading != nullptr && job.shading->cued)
        interpolateMixed<W, true, true, Cell>(job, strip, rows, scratch);
    else if (job.shading != nullptr)
        interpolateMixed<W, true, false, Cell>(job, strip, rows, scratch);
    else if (job.sourceCount > 1)
        interpolateMixed<W, false, false, Cell>(job, strip, rows, scratch);
    else
        interpolatePlain<W, Cell>(job, strip, rows, scratch);
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
void interpolateRows(const FrameJob &job, int strip, const Rows &rows, FrameScratch &scratch) {
    switch (rows.width) {
    case 0:
        return clearRows(job, rows, scratch);
    case 1:
        return interpolateRows<1, Cell>(job, strip, rows, scratch);
    case 2:
        return interpolateRows<2, Cell>(job, strip, rows, scratch);
    case 3:
        return interpolateRows<3, Cell>(job, strip, rows, scratch);
    case 4:
        return interpolateRows<4, Cell>(job, strip, rows, scratch);
    case 5:
        return interpolateRows<5, Cell>(job, strip, rows, scratch);
    case 6:
        return interpolateRows<6, Cell>(job, strip, rows, scratch);
    default:
        return interpolateRows<7, Cell>(job, strip, rows, scratch);
    }
}

template <class Cell> void interpolateStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    const int outer = job.strips[strip].outerRow;
    if (job.widths == nullptr)
        return interpolateRows<Cell>(job, strip, {-outer, outer, job.layout->width()}, scratch);
    static_assert(plan::WidthMap::tileColumns == stripLanes);
    const auto widths = job.widths->strip(strip);
    const int begin = -job.widths->tiles * plan::WidthMap::tileRows;
    for (std::size_t tile = 0, next = 0; tile < widths.size(); tile = next) {
        while (next < widths.size() && widths[next] == widths[tile])
            ++next;
        const Rows rows{std::max(-outer, begin + int(tile) * plan::WidthMap::tileRows),
                        std::min(outer, begin + int(next) * plan::WidthMap::tileRows - 1),
                        widths[tile]};
        if (rows.first <= rows.last)
            interpolateRows<Cell>(job, strip, rows, scratch);
    }
}

void sliceOneStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    const StripBounds &bounds = job.strips[strip];
    const double start = frameClockSeconds();
    // Rows beyond the disc are zero.
    for (int c = 0; c < job.imageCount; ++c)
        std::memset(scratch.strips[std::size_t(c)] + std::size_t(bounds.outerRow + 1) * stripFloats,
                    0,
                    std::size_t(job.rows - 2 * bounds.outerRow - 1) * stripFloats * sizeof(float));
    if (job.layout->storage == fourier::Storage::binary16)
        interpolateStrip<Half>(job, strip, scratch);
    else
        interpolateStrip<std::complex<float>>(job, strip, scratch);
    scratch.sliceSeconds += frameClockSeconds() - start;

    const int imageRows = std::min(job.imageRows, job.rows);
    const std::size_t columns = std::size_t(job.stripCount) * stripLanes;
    for (std::size_t c = 0; c < std::size_t(job.imageCount); ++c) {
        const float *const result = runTransform(*job.alongRows, scratch.strips[c], scratch.spare);
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

const char *targetName() {
    return hwy::TargetName(HWY_TARGET);
}

} // namespace pellucid::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::render {

HWY_EXPORT(sliceOneStrip);
HWY_EXPORT(targetName);

void sliceStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    HWY_DYNAMIC_DISPATCH(sliceOneStrip)(job, strip, scratch);
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
