// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/render/frame_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <hwy/highway.h>
#include <type_traits>
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

using IntTag = hn::RebindToSigned<StripTag>;
using Half = std::uint32_t; // a complex number of two binary16

// ---- Where and with which weights a batch reads ----

// sinc^2(r) for |r| <= 1/2 from its series in r^2, to 3e-8; p = r^2.
HWY_INLINE StripVector sincSquared(StripVector p) {
    const StripTag d;
    // (-1)^k 2^(2k+1) pi^(2k) / (2k+2)!
    constexpr double pi2 = 9.8696044010893586;
    constexpr double c1 = -8.0 / 24.0 * pi2, c2 = 32.0 / 720.0 * pi2 * pi2,
                     c3 = -128.0 / 40320.0 * pi2 * pi2 * pi2,
                     c4 = 512.0 / 3628800.0 * pi2 * pi2 * pi2 * pi2,
                     c5 = -2048.0 / 479001600.0 * pi2 * pi2 * pi2 * pi2 * pi2,
                     c6 = 8192.0 / 87178291200.0 * pi2 * pi2 * pi2 * pi2 * pi2 * pi2,
                     c7 = -32768.0 / 20922789888000.0 * pi2 * pi2 * pi2 * pi2 * pi2 * pi2 * pi2;
    auto sum = hn::Set(d, float(c7));
    for (const double coefficient : {c6, c5, c4, c3, c2, c1, 1.0})
        sum = hn::MulAdd(sum, p, hn::Set(d, float(coefficient)));
    return sum;
}

// The reconstruction's factor of one axis as numerator over denominator, q = a_d.s.
template <Reconstruction R, bool Wraps>
HWY_INLINE void multiplyFactor(StripVector q, float rollOff, StripVector &numerator,
                               StripVector &denominator) {
    const StripTag d;
    const auto one = hn::Set(d, 1.0F);
    if constexpr (R == Reconstruction::bandLimited) {
        // t(2|q|) = cos^2(pi x / 2) with x the way through the roll-off; sin^2 by the same series.
        const auto through =
            hn::MulAdd(hn::Abs(q), hn::Set(d, 2.0F / rollOff), hn::Set(d, 1.0F - 1.0F / rollOff));
        const auto half = hn::Mul(hn::Set(d, 0.5F), hn::Min(one, hn::Max(hn::Zero(d), through)));
        const auto p = hn::Mul(half, half);
        const auto sine = hn::Mul(hn::Mul(p, hn::Set(d, 9.8696044F)), sincSquared(p));
        numerator = hn::Mul(numerator, hn::Max(hn::Zero(d), hn::Sub(one, sine)));
    } else {
        const auto r = Wraps ? hn::Sub(q, hn::Round(q)) : q;
        const auto p = hn::Mul(r, r);
        const auto sinc = sincSquared(p);
        auto top = sinc;
        if constexpr (Wraps) {
            // sinc^2(q) = sinc^2(r) r^2/q^2, and q = r near 0.
            const auto beyond = hn::Gt(hn::Abs(q), hn::Set(d, 0.5F));
            top = hn::IfThenElse(beyond, hn::Mul(sinc, p), sinc);
            auto below = hn::IfThenElse(beyond, hn::Mul(q, q), one);
            if constexpr (R == Reconstruction::cubic)
                below = hn::Mul(below, below);
            denominator = hn::Mul(denominator, below);
        }
        if constexpr (R == Reconstruction::cubic) {
            // 2 + cos 2 pi q = 3 - 2 sin^2 pi q
            top = hn::Mul(top, top);
            const auto sine = hn::Mul(hn::Mul(p, hn::Set(d, 9.8696044F)), sinc);
            denominator = hn::Mul(denominator, hn::NegMulAdd(hn::Set(d, 2.0F / 3.0F), sine, one));
        }
        numerator = hn::Mul(numerator, top);
    }
}

template <Reconstruction R, bool Wraps>
HWY_INLINE StripVector factorOf(const StripVector *q, float rollOff) {
    const StripTag d;
    auto numerator = hn::Set(d, 1.0F), denominator = numerator;
    for (int axis = 0; axis < 3; ++axis)
        multiplyFactor<R, Wraps>(q[axis], rollOff, numerator, denominator);
    return R == Reconstruction::cubic || Wraps ? hn::Div(numerator, denominator) : numerator;
}

HWY_INLINE StripVector factorFor(const FrameJob &job, const StripVector *q) {
    const auto rollOff = float(job.image.rollOff);
    switch (job.image.reconstruction) {
    case Reconstruction::linear:
        return job.wraps ? factorOf<Reconstruction::linear, true>(q, rollOff)
                         : factorOf<Reconstruction::linear, false>(q, rollOff);
    case Reconstruction::bandLimited:
        // A sharp edge stays a steep one, steeper than any grid resolves.
        return factorOf<Reconstruction::bandLimited, false>(q, std::max(1e-5F, rollOff));
    case Reconstruction::cubic:
        break;
    }
    return job.wraps ? factorOf<Reconstruction::cubic, true>(q, rollOff)
                     : factorOf<Reconstruction::cubic, false>(q, rollOff);
}

// The weights of an axis for centred offsets c, see Kernel::pairs.
template <int W>
HWY_INLINE void kernelWeights(const fourier::Kernel &kernel, StripVector c, StripVector *weights) {
    const StripTag d;
    const int terms = kernel.terms();
    const float *pair = kernel.pairs().data();
    const auto square = hn::Mul(c, c);
    for (int k = 0; k < (W + 1) / 2; ++k, pair += 2 * terms) {
        auto even = hn::Set(d, pair[terms - 1]), odd = hn::Set(d, pair[2 * terms - 1]);
        for (int n = terms - 2; n >= 0; --n) {
            even = hn::MulAdd(even, square, hn::Set(d, pair[n]));
            odd = hn::MulAdd(odd, square, hn::Set(d, pair[terms + n]));
        }
        weights[k] = hn::MulAdd(c, odd, even);
        weights[W - 1 - k] = 2 * k == W - 1 ? weights[k] : hn::NegMulAdd(c, odd, even);
    }
}

// Stores the x weights by lane: [lane][slots].
template <int W>
HWY_INLINE void storeByLane(const StripVector *weights, std::size_t lane, float *to) {
    const StripTag d;
    const auto zero = hn::Zero(d);
    const auto tap = [&](int k) { return k < W ? weights[k] : zero; };
    if constexpr (W <= 4) {
        hn::StoreInterleaved4(tap(0), tap(1), tap(2), tap(3), d, to + 4 * lane);
    } else {
        const hn::FixedTag<float, 4> d4;
        HWY_ALIGN float low[4 * stripLanes], high[4 * stripLanes];
        hn::StoreInterleaved4(tap(0), tap(1), tap(2), tap(3), d, low);
        hn::StoreInterleaved4(tap(4), tap(5), tap(6), tap(7), d, high);
        for (std::size_t n = 0; n < hn::Lanes(d); ++n) {
            hn::Store(hn::Load(d4, low + 4 * n), d4, to + 8 * (lane + n));
            hn::Store(hn::Load(d4, high + 4 * n), d4, to + 8 * (lane + n) + 4);
        }
    }
}

// Coordinates of 16 frequencies from column `column` on, in row `row`. The middle of the batch is
// computed in double and split in a whole number and a fraction: floats hold offsets within the
// batch only, so that their rounding stays below 1e-6 of a cell whatever the size.
template <int W>
void prepareBatch(const FrameJob &job, int column, int row, const float *rollOff,
                  FrequencyBatch &batch) {
    const StripTag d;
    const IntTag di;
    const hn::RebindToUnsigned<StripTag> du;
    const fourier::CellLayout &cells = job.spectrum->cellLayout();
    const fourier::SpectrumLayout &layout = job.spectrum->layout();
    const int first[3] = {cells.firstX, cells.firstY, cells.firstZ};
    float whole[3], part[3], step[3], inverse[3], period[3];
    for (int axis = 0; axis < 3; ++axis) {
        const double g = (column + 0.5 * (stripLanes - 1)) * job.cellsPerColumn[axis] +
                         row * job.cellsPerRow[axis];
        const double floor = std::floor(g);
        whole[axis] = float(floor);
        part[axis] = float(g - floor);
        step[axis] = float(job.cellsPerColumn[axis]);
        period[axis] = float(layout.padded[axis]);
        inverse[axis] = 1.0F / period[axis];
    }
    const auto inverseStep = hn::Set(d, 1.0F / float(cells.step));
    for (std::size_t lane = 0; lane < stripLanes; lane += hn::Lanes(d)) {
        const auto place = hn::Add(hn::Iota(d, float(lane)), hn::Set(d, -0.5F * (stripLanes - 1)));
        StripVector q[3], base[3], offset[3];
        for (int axis = 0; axis < 3; ++axis) {
            offset[axis] = hn::MulAdd(place, hn::Set(d, step[axis]), hn::Set(d, part[axis]));
            const auto total = hn::Add(offset[axis], hn::Set(d, whole[axis]));
            q[axis] = hn::Mul(total, hn::Set(d, inverse[axis]));
            // The spectrum is periodic; at half a period either copy will do.
            base[axis] = hn::NegMulAdd(hn::Round(q[axis]), hn::Set(d, period[axis]),
                                       hn::Set(d, whole[axis]));
        }
        // The half with negative x is the conjugate of the mirrored other one.
        const auto signBit = hn::And(hn::Add(base[0], offset[0]), hn::SignBit(d));
        hn::Store(hn::Or(hn::Set(d, 1.0F), signBit), d, batch.sign.data() + lane);
        StripVector weights[8];
        hn::Vec<IntTag> index[3];
        for (int axis = 0; axis < 3; ++axis) {
            const auto t = hn::Xor(offset[axis], signBit);
            const auto tap = hn::Ceil(hn::Sub(t, hn::Set(d, 0.5F * W)));
            const auto c = hn::Add(hn::Sub(tap, t), hn::Set(d, 0.5F * (W - 1)));
            index[axis] = hn::Sub(hn::ConvertTo(di, hn::Add(hn::Xor(base[axis], signBit), tap)),
                                  hn::Set(di, first[axis]));
            kernelWeights<W>(layout.kernels[axis], c, weights);
            if (axis == 0) {
                storeByLane<W>(weights, lane, batch.x.data());
            } else {
                float *const to = (axis == 1 ? batch.y : batch.z).data() + lane;
                for (int k = 0; k < W; ++k)
                    hn::Store(weights[k], d, to + k * stripLanes);
            }
        }
        const auto x = hn::ConvertTo(d, index[0]);
        const auto line = hn::ConvertTo(di, hn::Mul(hn::Add(x, hn::Set(d, 0.5F)), inverseStep));
        // CellLayout::line, then cells; counts of cells need all 32 bits. The taps reach into the
        // next group of planes at most.
        constexpr int together = fourier::CellLayout::planesTogether;
        static_assert(together == 8 && fourier::CellLayout::columnCells == 16 && W <= together);
        const auto inGroup = hn::And(index[2], hn::Set(di, together - 1));
        const auto inLine = hn::Sub(index[0], hn::Mul(line, hn::Set(di, cells.step)));
        const auto group =
            hn::Add(hn::Mul(line, hn::Set(di, cells.planes)), hn::Sub(index[2], inGroup));
        const auto firstLine = hn::Add(
            hn::Add(hn::Mul(group, hn::Set(di, cells.rows)), hn::ShiftLeft<3>(index[1])), inGroup);
        const auto firstCell = hn::Add(hn::ShiftLeft<4>(firstLine), inLine);
        const auto toNextGroup =
            hn::Set(di, (cells.rows - 1) * together * fourier::CellLayout::columnCells);
        for (int k = 0; k < W; ++k) {
            const auto same = hn::Add(firstCell, hn::Set(di, k * fourier::CellLayout::columnCells));
            const auto beyond = hn::Gt(inGroup, hn::Set(di, together - 1 - k));
            const auto cell = hn::Add(same, hn::IfThenElseZero(beyond, toNextGroup));
            hn::Store(hn::BitCast(du, cell), du, batch.cell.data() + k * stripLanes + lane);
        }
        auto factor = factorFor(job, q);
        if (rollOff != nullptr)
            factor = hn::Mul(factor, hn::Load(d, rollOff + lane));
        hn::Store(factor, d, batch.factor.data() + lane);
    }
}

// ---- The weighted sums ----

// A row of cells as floats: four cells for kernels up to width 4, eight for wider ones.
template <int Slots> using RowTag = hn::CappedTag<float, 2 * Slots>;

template <class D> HWY_INLINE hn::Vec<D> loadCells(D d, const std::complex<float> *cells) {
    return hn::LoadU(d, reinterpret_cast<const float *>(cells));
}

template <class D> HWY_INLINE hn::Vec<D> loadCells(D d, const Half *cells) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
    const hn::Rebind<hwy::float16_t, D> dh;
    return hn::PromoteTo(d, hn::LoadU(dh, reinterpret_cast<const hwy::float16_t *>(cells)));
#else
    // fromBinary16 for vectors.
    const hn::RebindToUnsigned<D> du;
    const hn::Rebind<std::uint16_t, D> dh;
    const auto bits =
        hn::PromoteTo(du, hn::LoadU(dh, reinterpret_cast<const std::uint16_t *>(cells)));
    const auto magnitude = hn::ShiftLeft<13>(hn::And(bits, hn::Set(du, 0x7fffU)));
    const auto sign = hn::ShiftLeft<16>(hn::And(bits, hn::Set(du, 0x8000U)));
    return hn::Or(hn::Mul(hn::BitCast(d, magnitude), hn::Set(d, 0x1p112F)), hn::BitCast(d, sign));
#endif
}

// Cells between neighbouring rows.
constexpr std::ptrdiff_t rowGap =
    fourier::CellLayout::columnCells * fourier::CellLayout::planesTogether;

HWY_INLINE std::size_t firstCell(const FrequencyBatch &batch, std::size_t lane, int plane) {
    return batch.cell[std::size_t(plane) * stripLanes + lane];
}

// Sums over the W rows and planes, times the x weights: one complex number a pair of lanes.
template <int W, class Cell>
HWY_INLINE auto sumRows(const FrequencyBatch &batch, const Cell *cells, std::size_t lane) {
    constexpr int slots = W <= 4 ? 4 : 8;
    const RowTag<slots> d;
    constexpr std::size_t lanes = hn::MaxLanes(RowTag<slots>());
    constexpr std::size_t vectors = 2 * slots / lanes;
    hn::Vec<RowTag<slots>> total[vectors];
    for (int z = 0; z < W; ++z) {
        const Cell *const first = cells + firstCell(batch, lane, z);
        hn::Vec<RowTag<slots>> plane[vectors];
        for (int y = 0; y < W; ++y) {
            const auto weight = hn::Set(d, batch.y[std::size_t(y) * stripLanes + lane]);
            const Cell *row = first + y * rowGap;
            for (std::size_t v = 0; v < vectors; ++v) {
                const auto value = loadCells(d, row + v * lanes / 2);
                plane[v] = y == 0 ? hn::Mul(value, weight) : hn::MulAdd(value, weight, plane[v]);
            }
        }
        const auto weight = hn::Set(d, batch.z[std::size_t(z) * stripLanes + lane]);
        for (std::size_t v = 0; v < vectors; ++v)
            total[v] = z == 0 ? hn::Mul(plane[v], weight) : hn::MulAdd(plane[v], weight, total[v]);
    }
    // Each x weight serves the real and the imaginary part.
    HWY_ALIGN static constexpr std::int32_t twice[16] = {0, 0, 1, 1, 2, 2, 3, 3,
                                                         4, 4, 5, 5, 6, 6, 7, 7};
    const auto doubled = hn::SetTableIndices(d, twice);
    const auto xWeights = [&](std::size_t v) {
        const float *at = batch.x.data() + std::size_t(slots) * lane + v * lanes / 2;
        return hn::TableLookupLanes(hn::LoadU(d, at), doubled);
    };
    auto sum = hn::Mul(total[0], xWeights(0));
    for (std::size_t v = 1; v < vectors; ++v)
        sum = hn::MulAdd(total[v], xWeights(v), sum);
    if constexpr (lanes == 16) {
        const hn::Half<RowTag<slots>> half;
        return hn::Add(hn::LowerHalf(half, sum), hn::UpperHalf(half, sum));
    } else {
        return sum;
    }
}

// The 16 sums of a batch, real and imaginary interleaved.
template <int W, class Cell>
HWY_INLINE void sumBatch(const FrequencyBatch &batch, const Cell *cells, float *sums) {
    const auto at = [&](std::size_t lane) { return sumRows<W>(batch, cells, lane); };
    using V = decltype(at(0));
    using D = hn::DFromV<V>;
    const D d;
    const hn::Repartition<double, D> pairs; // a complex number each
    if constexpr (hn::MaxLanes(D()) == 8) {
        for (std::size_t lane = 0; lane < stripLanes; lane += 4) {
            // Adding halves, then neighbours: the order of the samples comes out right.
            const auto a = at(lane), b = at(lane + 1), c = at(lane + 2), e = at(lane + 3);
            const auto ac = hn::Add(hn::ConcatLowerLower(d, c, a), hn::ConcatUpperUpper(d, c, a));
            const auto be = hn::Add(hn::ConcatLowerLower(d, e, b), hn::ConcatUpperUpper(d, e, b));
            const auto low =
                hn::InterleaveLower(pairs, hn::BitCast(pairs, ac), hn::BitCast(pairs, be));
            const auto high =
                hn::InterleaveUpper(pairs, hn::BitCast(pairs, ac), hn::BitCast(pairs, be));
            hn::Store(hn::Add(hn::BitCast(d, low), hn::BitCast(d, high)), d, sums + 2 * lane);
        }
    } else {
        static_assert(hn::MaxLanes(D()) == 4);
        for (std::size_t lane = 0; lane < stripLanes; lane += 2) {
            const auto a = at(lane), b = at(lane + 1);
            hn::Store(hn::Add(hn::ConcatLowerLower(d, b, a), hn::ConcatUpperUpper(d, b, a)), d,
                      sums + 2 * lane);
        }
    }
}

template <int W, class Cell>
HWY_INLINE void prefetchBatch(const FrequencyBatch &batch, const Cell *cells) {
    // Neighbouring frequencies share lines: every third brings nearly all of them. Every row is
    // asked for, and into the second level: slices of 256^3 then took 46 ns a sample, with the
    // first and the last row only and into the first level 50.
    for (std::size_t lane = 0; lane < stripLanes; lane += 3)
        for (int z = 0; z < W; ++z) {
            const Cell *at = cells + firstCell(batch, lane, z);
            for (int y = 0; y < W; ++y)
                __builtin_prefetch(at + y * rowGap, 0, 2);
        }
}

// A batch's sums times reconstruction, roll-off and phase, into a strip.
HWY_INLINE void finishBatch(const FrameJob &job, const FrequencyBatch &batch, const float *sums,
                            int column, int row, float *strip) {
    const StripTag d;
    const std::complex<float> atRow = job.rowPhase[std::abs(row)];
    const auto rowRe = hn::Set(d, atRow.real());
    const auto rowIm = hn::Set(d, row < 0 ? -atRow.imag() : atRow.imag());
    const float *columnRe = job.columnPhase + column;
    const float *columnIm = columnRe + std::size_t(job.stripCount) * stripLanes;
    for (std::size_t lane = 0; lane < stripLanes; lane += hn::Lanes(d)) {
        StripVector re, im;
        hn::LoadInterleaved2(d, sums + 2 * lane, re, im);
        im = hn::Mul(im, hn::Load(d, batch.sign.data() + lane));
        const StripComplex phase =
            rotated({hn::Load(d, columnRe + lane), hn::Load(d, columnIm + lane)}, rowRe, rowIm);
        const StripComplex value = rotated({re, im}, phase.re, phase.im);
        const auto factor = hn::Load(d, batch.factor.data() + lane);
        hn::Store(hn::Mul(value.re, factor), d, strip + lane);
        hn::Store(hn::Mul(value.im, factor), d, strip + stripLanes + lane);
    }
}

// ---- Strips and rows ----

template <int W, class Cell>
void interpolateStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    const StripBounds &bounds = job.strips[strip];
    const int column = strip * stripLanes;
    const auto *cells = reinterpret_cast<const Cell *>(job.spectrum->cells());
    const auto prepare = [&](int row) {
        FrequencyBatch &batch = scratch.batches[(row + job.rows) % (batchesAhead + 1)];
        const int ring = std::abs(row) - bounds.innerRow - 1;
        prepareBatch<W>(job, column, row,
                        ring < 0 ? nullptr
                                 : job.rollOff + bounds.rollOff + std::size_t(ring) * stripLanes,
                        batch);
        prefetchBatch<W>(batch, cells);
    };
    for (int row = -bounds.outerRow; row < -bounds.outerRow + batchesAhead; ++row)
        if (row <= bounds.outerRow)
            prepare(row);
    HWY_ALIGN float sums[stripFloats];
    for (int row = -bounds.outerRow; row <= bounds.outerRow; ++row) {
        if (row + batchesAhead <= bounds.outerRow)
            prepare(row + batchesAhead);
        const FrequencyBatch &batch = scratch.batches[(row + job.rows) % (batchesAhead + 1)];
        sumBatch<W>(batch, cells, sums);
        finishBatch(job, batch, sums, column, row,
                    scratch.strips + std::size_t(row < 0 ? row + job.rows : row) * stripFloats);
    }
    // The field's sum is known before any rounding, and decides the brightness of the whole image.
    if (strip == 0) {
        scratch.strips[0] = float(job.zeroFrequency);
        scratch.strips[stripLanes] = 0.0F;
    }
}

template <class Cell> void interpolateStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    switch (job.spectrum->layout().width()) {
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

// Transposes 16 x 16 floats in blocks of four.
HWY_INLINE void transpose(const float *from, std::size_t fromGap, float *to, std::size_t toGap) {
    const hn::FixedTag<float, 4> d;
    const hn::Repartition<double, decltype(d)> pairs;
    for (std::size_t r = 0; r < 16; r += 4)
        for (std::size_t c = 0; c < 16; c += 4) {
            const float *in = from + r * fromGap + c;
            const auto a0 = hn::Load(d, in), a1 = hn::Load(d, in + fromGap);
            const auto a2 = hn::Load(d, in + 2 * fromGap), a3 = hn::Load(d, in + 3 * fromGap);
            const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(d, a0, a1));
            const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(d, a2, a3));
            const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(d, a0, a1));
            const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(d, a2, a3));
            float *out = to + c * toGap + r;
            hn::StoreU(hn::BitCast(d, hn::InterleaveLower(pairs, low01, low23)), d, out);
            hn::StoreU(hn::BitCast(d, hn::InterleaveUpper(pairs, low01, low23)), d, out + toGap);
            hn::StoreU(hn::BitCast(d, hn::InterleaveLower(pairs, high01, high23)), d,
                       out + 2 * toGap);
            hn::StoreU(hn::BitCast(d, hn::InterleaveUpper(pairs, high01, high23)), d,
                       out + 3 * toGap);
        }
}

void sliceOneStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    const StripBounds &bounds = job.strips[strip];
    const double start = frameClockSeconds();
    // Rows beyond the disc are zero.
    float *const empty = scratch.strips + std::size_t(bounds.outerRow + 1) * stripFloats;
    std::memset(empty, 0,
                std::size_t(job.rows - 2 * bounds.outerRow - 1) * stripFloats * sizeof(float));
    if (job.spectrum->layout().storage == fourier::Storage::binary16)
        interpolateStrip<Half>(job, strip, scratch);
    else
        interpolateStrip<std::complex<float>>(job, strip, scratch);
    scratch.sliceSeconds += frameClockSeconds() - start;

    const float *const result = runTransform(*job.alongRows, scratch.strips, scratch.beside);
    const int imageRows = std::min(job.imageRows, job.rows);
    const std::size_t columns = std::size_t(job.stripCount) * stripLanes;
    for (int row = 0; row < imageRows; row += stripLanes) {
        const float *const from = result + std::size_t(row) * stripFloats;
        float *const to =
            job.lines +
            ((std::size_t(row) / stripLanes) * columns + std::size_t(strip) * 16) * stripFloats;
        transpose(from, stripFloats, to, stripFloats);
        transpose(from + stripLanes, stripFloats, to + stripLanes, stripFloats);
    }
    scratch.stripSeconds += frameClockSeconds() - start;
}

// x[2n] + i x[2n+1] is the transform of half the length of
//   (X_k + conj X_(h-k)) + i exp(+i 2 pi k/columns) (X_k - conj X_(h-k)), h = columns/2.
void finishSixteenRows(const FrameJob &job, int group, FrameScratch &scratch) {
    const StripTag d;
    const int half = job.columns / 2, known = std::min(half, job.stripCount * stripLanes);
    const float *const lines =
        job.lines + std::size_t(group) * job.stripCount * stripLanes * stripFloats;
    for (int k = 0; k <= half / 2; ++k) {
        const int other = half - k;
        for (std::size_t lane = 0; lane < stripLanes; lane += hn::Lanes(d)) {
            const auto load = [&](int column) -> StripComplex {
                if (column >= known)
                    return {hn::Zero(d), hn::Zero(d)};
                const float *at = lines + std::size_t(column) * stripFloats + lane;
                // The mean is real; what its imaginary part holds is rounding.
                return {hn::Load(d, at), column == 0 ? hn::Zero(d) : hn::Load(d, at + stripLanes)};
            };
            const StripComplex a = load(k), b = load(other);
            // sum = A + conj B, difference = w (A - conj B); the pair (h-k, k) gives
            // conj sum and conj difference, so both come from one product.
            const StripComplex sum{hn::Add(a.re, b.re), hn::Sub(a.im, b.im)};
            const StripComplex difference =
                rotated({hn::Sub(a.re, b.re), hn::Add(a.im, b.im)},
                        hn::Set(d, job.untangle[k].real()), hn::Set(d, job.untangle[k].imag()));
            float *const to = scratch.strips + std::size_t(k) * stripFloats + lane;
            hn::Store(hn::Sub(sum.re, difference.im), d, to);
            hn::Store(hn::Add(sum.im, difference.re), d, to + stripLanes);
            if (k == 0 || other == k)
                continue;
            float *const mirrored = scratch.strips + std::size_t(other) * stripFloats + lane;
            hn::Store(hn::Add(sum.re, difference.im), d, mirrored);
            hn::Store(hn::Sub(difference.re, sum.im), d, mirrored + stripLanes);
        }
    }
    // [column][16 rows]: the real and imaginary parts of a strip are neighbouring columns.
    const float *const image = runTransform(*job.halfColumns, scratch.strips, scratch.beside);
    const int firstRow = group * stripLanes;
    const int rowCount = std::min(stripLanes, std::min(job.imageRows, job.rows) - firstRow);
    const int width = std::min(job.imageColumns, job.columns);
    float *const samples = job.samples + std::size_t(firstRow) * job.imageColumns;
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
    // An image larger than the period shows the empty part of it again.
    for (int row = 0; row < rowCount; ++row) {
        float *const line = samples + std::size_t(row) * job.imageColumns;
        for (int column = width; column < job.imageColumns; column += job.columns)
            std::copy_n(line, std::min(job.columns, job.imageColumns - column), line + column);
        for (int copy = firstRow + row + job.rows; copy < job.imageRows; copy += job.rows)
            std::copy_n(line, job.imageColumns, job.samples + std::size_t(copy) * job.imageColumns);
    }
}

const char *targetName() {
    return hwy::TargetName(HWY_TARGET);
}

} // namespace pellucid::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::render {

HWY_EXPORT(sliceOneStrip);
HWY_EXPORT(finishSixteenRows);
HWY_EXPORT(targetName);

void sliceStrip(const FrameJob &job, int strip, FrameScratch &scratch) {
    HWY_DYNAMIC_DISPATCH(sliceOneStrip)(job, strip, scratch);
}

void finishRows(const FrameJob &job, int group, FrameScratch &scratch) {
    HWY_DYNAMIC_DISPATCH(finishSixteenRows)(job, group, scratch);
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
