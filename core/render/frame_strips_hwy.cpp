// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/render/frame_strips_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
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
#include "core/fourier/strip_transform_hwy.inc"
#include "core/fourier/transpose_hwy.inc"
#include "core/render/frame_sums_hwy.inc"
#include "core/render/frame_weights_hwy.inc"

// mixed[c] += share_c sums, or = for the first source.
HWY_INLINE void mixSums(const FrameSource &source, int channels, bool isFirst, const float *sums,
                        float (*mixed)[stripFloats]) {
    const StripTag d;
    for (int c = 0; c < channels; ++c) {
        const auto share = hn::Set(d, source.shares[std::size_t(c)]);
        for (std::size_t n = 0; n < std::size_t(stripFloats); n += hn::Lanes(d)) {
            const auto sum = hn::Load(d, sums + n);
            hn::Store(isFirst ? hn::Mul(sum, share)
                              : hn::MulAdd(sum, share, hn::Load(d, mixed[c] + n)),
                      d, mixed[c] + n);
        }
    }
}

template <int W, class Cell>
void interpolateStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    const StripBounds &bounds = job.strips[strip];
    const int column = strip * stripLanes;
    const auto cellsOf = [&](int source) {
        return reinterpret_cast<const Cell *>(job.sources[source].cells);
    };
    const auto batchOf = [&](int row) -> FrequencyBatch & {
        return scratch.batches[(row + job.rows) % (batchesAhead + 1)];
    };
    const auto prepare = [&](int row) {
        const int ring = std::abs(row) - bounds.innerRow - 1;
        prepareBatch<W>(job, column, row,
                        ring < 0 ? nullptr
                                 : job.rollOff + bounds.rollOff + std::size_t(ring) * stripLanes,
                        batchOf(row));
    };
    const int first = -bounds.outerRow, last = bounds.outerRow;
    for (int row = first; row < first + batchesAhead && row <= last; ++row) {
        prepare(row);
        for (int s = 0; s < job.sourceCount; ++s)
            prefetchPart<W>(batchOf(row), cellsOf(s), 0, 1);
    }
    HWY_ALIGN float sums[stripFloats];
    // Weights and places are the same for all sources: they are worked out once.
    HWY_ALIGN float mixed[FrameJob::mostChannels][stripFloats];
    for (int row = first; row <= last; ++row) {
        const int ahead = std::min(row + batchesAhead, last);
        if (ahead == row + batchesAhead)
            prepare(ahead);
        const std::size_t to = std::size_t(row < 0 ? row + job.rows : row) * stripFloats;
        if (job.sourceCount == 1) {
            sumBatch<W>(batchOf(row), batchOf(ahead), cellsOf(0), sums);
            finishBatch(job, batchOf(row), sums, column, row, scratch.strips[0] + to);
            continue;
        }
        for (int s = 0; s < job.sourceCount; ++s) {
            sumBatch<W>(batchOf(row), batchOf(ahead), cellsOf(s), sums);
            mixSums(job.sources[s], job.channels, s == 0, sums, mixed);
        }
        for (int c = 0; c < job.channels; ++c)
            finishBatch(job, batchOf(row), mixed[c], column, row,
                        scratch.strips[std::size_t(c)] + to);
    }
    // The field's sum is known before any rounding, and decides the brightness of the whole image.
    if (strip == 0)
        for (int c = 0; c < job.channels; ++c) {
            float *const zero = scratch.strips[std::size_t(c)];
            zero[0] = float(job.zeroFrequency[std::size_t(c)]);
            zero[stripLanes] = 0.0F;
        }
}

template <class Cell> void interpolateStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    switch (job.layout->width()) {
    case 1:
        return interpolateStrip<1, Cell>(job, strip, scratch);
    case 2:
        return interpolateStrip<2, Cell>(job, strip, scratch);
    case 3:
        return interpolateStrip<3, Cell>(job, strip, scratch);
    case 4:
        return interpolateStrip<4, Cell>(job, strip, scratch);
    case 5:
        return interpolateStrip<5, Cell>(job, strip, scratch);
    case 6:
        return interpolateStrip<6, Cell>(job, strip, scratch);
    default:
        return interpolateStrip<7, Cell>(job, strip, scratch);
    }
}

void sliceOneStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    const StripBounds &bounds = job.strips[strip];
    const double start = frameClockSeconds();
    // Rows beyond the disc are zero.
    for (int c = 0; c < job.channels; ++c)
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
    for (std::size_t c = 0; c < std::size_t(job.channels); ++c) {
        const float *const result = runTransform(*job.alongRows, scratch.strips[c], scratch.beside);
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
