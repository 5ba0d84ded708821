// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/render/frame_rows_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <algorithm>
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

// x[2n] + i x[2n+1] is the transform of half the length of
//   (X_k + conj X_(h-k)) + i exp(+i 2 pi k/columns) (X_k - conj X_(h-k)), h = columns/2.
void finishSixteenRows(const FrameJob &job, int channel, int group, FrameScratch &scratch) {
    const StripTag d;
    const int half = job.columns / 2, known = std::min(half, job.stripCount * stripLanes);
    const float *const lines = job.lines[std::size_t(channel)] +
                               std::size_t(group) * job.stripCount * stripLanes * stripFloats;
    for (int k = 0; k <= half / 2; ++k) {
        const int other = half - k;
        for (std::size_t lane = 0; lane < stripLanes; lane += hn::Lanes(d)) {
            const auto load = [&](int column) -> StripComplex {
                if (column >= known)
                    return {hn::Zero(d), hn::Zero(d)};
                const float *at = lines + std::size_t(column) * stripFloats + lane;
                // The mean is real; its imaginary part is rounding.
                return {hn::Load(d, at), column == 0 ? hn::Zero(d) : hn::Load(d, at + stripLanes)};
            };
            const StripComplex a = load(k), b = load(other);
            // sum = A + conj B, difference = w (A - conj B); the pair (h-k, k) gives
            // conj sum and conj difference, so both come from one product.
            const StripComplex sum{hn::Add(a.re, b.re), hn::Sub(a.im, b.im)};
            const StripComplex difference =
                rotated({hn::Sub(a.re, b.re), hn::Add(a.im, b.im)},
                        hn::Set(d, job.unpackReal[k].real()), hn::Set(d, job.unpackReal[k].imag()));
            float *const to = scratch.strips[0] + std::size_t(k) * stripFloats + lane;
            hn::Store(hn::Sub(sum.re, difference.im), d, to);
            hn::Store(hn::Add(sum.im, difference.re), d, to + stripLanes);
            if (k == 0 || other == k)
                continue;
            float *const mirrored = scratch.strips[0] + std::size_t(other) * stripFloats + lane;
            hn::Store(hn::Add(sum.re, difference.im), d, mirrored);
            hn::Store(hn::Sub(difference.re, sum.im), d, mirrored + stripLanes);
        }
    }
    // [column][16 rows]: the real and imaginary parts of a strip are adjacent columns.
    const float *const image = runTransform(*job.halfColumns, scratch.strips[0], scratch.spare);
    const int firstRow = group * stripLanes;
    const int rowCount = std::min(stripLanes, std::min(job.imageRows, job.rows) - firstRow);
    const int width = std::min(job.imageColumns, job.columns);
    float *const all = job.samples[std::size_t(channel)];
    float *const samples = all + std::size_t(firstRow) * job.imageColumns;
    for (int column = 0; column < width; column += stripLanes) {
        const float *const from = image + std::size_t(column) * stripLanes;
        const int columnCount = std::min(stripLanes, width - column);
        if (rowCount == stripLanes && columnCount == stripLanes) {
            transpose(from, stripLanes, samples + column, std::size_t(job.imageColumns));
            continue;
        }
        HWY_ALIGN float block[stripLanes * stripLanes];
        transpose(from, stripLanes, block, stripLanes);
        for (int row = 0; row < rowCount; ++row)
            std::copy_n(block + row * stripLanes, columnCount,
                        samples + std::size_t(row) * job.imageColumns + column);
    }
    // An image larger than the period repeats the empty part of it.
    for (int row = 0; row < rowCount; ++row) {
        float *const line = samples + std::size_t(row) * job.imageColumns;
        for (int column = width; column < job.imageColumns; column += job.columns)
            std::copy_n(line, std::min(job.columns, job.imageColumns - column), line + column);
        for (int copy = firstRow + row + job.rows; copy < job.imageRows; copy += job.rows)
            std::copy_n(line, job.imageColumns, all + std::size_t(copy) * job.imageColumns);
    }
}

void joinThreePlanes(const std::array<const float *, 3> &planes, const std::array<float, 3> &color,
                     std::size_t count, float *pixels) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t n = 0;
    for (; n + lanes <= count; n += lanes)
        hn::StoreInterleaved3(hn::Mul(hn::LoadU(d, planes[0] + n), hn::Set(d, color[0])),
                              hn::Mul(hn::LoadU(d, planes[1] + n), hn::Set(d, color[1])),
                              hn::Mul(hn::LoadU(d, planes[2] + n), hn::Set(d, color[2])), d,
                              pixels + 3 * n);
    for (; n < count; ++n)
        for (std::size_t c = 0; c < 3; ++c)
            pixels[3 * n + c] = planes[c][n] * color[c];
}

} // namespace pellucid::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::render {

HWY_EXPORT(finishSixteenRows);
HWY_EXPORT(joinThreePlanes);

void finishRows(const FrameJob &job, int channel, int group, FrameScratch &scratch) {
    HWY_DYNAMIC_DISPATCH(finishSixteenRows)(job, channel, group, scratch);
}

void joinPlanes(const std::array<const float *, 3> &planes, const std::array<float, 3> &color,
                std::size_t count, float *pixels) {
    HWY_DYNAMIC_DISPATCH(joinThreePlanes)(planes, color, count, pixels);
}

} // namespace pellucid::render
#endif
