// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/render/frame_rows_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <algorithm>
#include <array>
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

// Sixteen rows of an image, [column][16 rows]. The result is in `strip` or in `spare`.
//
// x[2n] + i x[2n+1] is the transform of half the length of
//   (X_k + conj X_(h-k)) + i exp(+i 2 pi k/columns) (X_k - conj X_(h-k)), h = columns/2.
const float *transformedRows(const FrameJob &job, std::size_t image, int group, float *strip,
                             float *spare) {
    const StripTag d;
    const int half = job.columns / 2, known = std::min(half, job.stripCount * stripLanes);
    const float *const lines =
        job.lines[image] + std::size_t(group) * job.stripCount * stripLanes * stripFloats;
    // Where neither X_k nor X_(h-k) is known, both are zero.
    const int outer = std::min(known - 1, half / 2);
    for (int k = 0; k <= outer; ++k) {
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
            float *const to = strip + std::size_t(k) * stripFloats + lane;
            hn::Store(hn::Sub(sum.re, difference.im), d, to);
            hn::Store(hn::Add(sum.im, difference.re), d, to + stripLanes);
            if (k == 0 || other == k)
                continue;
            float *const mirrored = strip + std::size_t(other) * stripFloats + lane;
            hn::Store(hn::Add(sum.re, difference.im), d, mirrored);
            hn::Store(hn::Sub(difference.re, sum.im), d, mirrored + stripLanes);
        }
    }
    // The real and imaginary parts of a strip are adjacent columns.
    return runTransform(*job.halfColumns, strip, spare, outer);
}

// Sixteen by sixteen samples of each image, rows in order.
using Blocks = float[FrameJob::maxImages][stripLanes * stripLanes];

// Sixteen pixels of red, green and blue: a row of the blocks.
HWY_INLINE void colorPixels(const FrameJob &job, const Blocks &blocks, std::size_t row,
                            float *pixels) {
    const StripTag d;
    const std::size_t first = row * stripLanes;
    for (std::size_t lane = 0; lane < stripLanes; lane += hn::Lanes(d)) {
        const auto samples = [&](std::size_t image) {
            return hn::Load(d, blocks[image] + first + lane);
        };
        const auto channel = [&](std::size_t c) {
            if (job.imageCount == FrameJob::maxImages) // red, green and blue
                return samples(c);
            auto sum = hn::Mul(samples(0), hn::Set(d, job.imageColors[0][c]));
            if (job.imageCount == 2)
                sum = hn::MulAdd(samples(1), hn::Set(d, job.imageColors[1][c]), sum);
            return sum;
        };
        hn::StoreInterleaved3(channel(0), channel(1), channel(2), d, pixels + 3 * lane);
    }
}

void finishSixteenRows(const FrameJob &job, int group, FrameScratch &scratch) {
    // The transform of an image frees one array for the next one.
    std::array<const float *, FrameJob::maxImages> images{};
    float *spare = scratch.spare;
    for (std::size_t image = 0; image < std::size_t(job.imageCount); ++image) {
        images[image] = transformedRows(job, image, group, scratch.strips[image], spare);
        if (images[image] == spare)
            spare = scratch.strips[image];
    }
    const int firstRow = group * stripLanes;
    const int rowCount = std::min(stripLanes, std::min(job.imageRows, job.rows) - firstRow);
    const int width = std::min(job.imageColumns, job.columns);
    const auto channels = std::size_t(job.pictureChannels);
    const std::size_t stride = std::size_t(job.imageColumns) * channels;
    float *const samples = job.samples + std::size_t(firstRow) * stride;
    HWY_ALIGN Blocks blocks;
    HWY_ALIGN float pixels[3 * stripLanes];
    for (int column = 0; column < width; column += stripLanes) {
        const int columnCount = std::min(stripLanes, width - column);
        const bool isWhole = rowCount == stripLanes && columnCount == stripLanes;
        const auto from = [&](std::size_t image) {
            return images[image] + std::size_t(column) * stripLanes;
        };
        if (channels == 1 && isWhole) {
            transpose(from(0), stripLanes, samples + column, stride);
            continue;
        }
        for (std::size_t image = 0; image < std::size_t(job.imageCount); ++image)
            transpose(from(image), stripLanes, blocks[image], stripLanes);
        for (std::size_t row = 0; row < std::size_t(rowCount); ++row) {
            float *const to = samples + row * stride + std::size_t(column) * channels;
            if (channels == 1) {
                std::copy_n(blocks[0] + row * stripLanes, columnCount, to);
            } else if (columnCount == stripLanes) {
                colorPixels(job, blocks, row, to);
            } else {
                colorPixels(job, blocks, row, pixels);
                std::copy_n(pixels, 3 * columnCount, to);
            }
        }
    }
    // A picture larger than the period repeats the empty part of it.
    for (int row = 0; row < rowCount; ++row) {
        float *const line = samples + std::size_t(row) * stride;
        for (int column = width; column < job.imageColumns; column += job.columns)
            std::copy_n(line,
                        std::size_t(std::min(job.columns, job.imageColumns - column)) * channels,
                        line + std::size_t(column) * channels);
        for (int copy = firstRow + row + job.rows; copy < job.imageRows; copy += job.rows)
            std::copy_n(line, stride, job.samples + std::size_t(copy) * stride);
    }
}

} // namespace pellucid::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::render {

HWY_EXPORT(finishSixteenRows);

void finishRows(const FrameJob &job, int group, FrameScratch &scratch) {
    HWY_DYNAMIC_DISPATCH(finishSixteenRows)(job, group, scratch);
}

} // namespace pellucid::render
#endif
