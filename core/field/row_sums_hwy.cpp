// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/row_sums_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <algorithm>
#include <array>
#include <hwy/highway.h>

#include "core/field/row_sums.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::field::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int lanes = 8;
using Tag = hn::CappedTag<float, lanes>;
using Vector = hn::Vec<Tag>;
constexpr int width = int(hn::MaxLanes(Tag())), vectors = lanes / width;

// Eight sums, in as many vectors as they need.
class Lanes {
public:
    Lanes() {
        for (Vector &sum : m_sums)
            sum = hn::Zero(Tag());
    }
    void add(int vector, Vector value) { m_sums[vector] = hn::Add(m_sums[vector], value); }
    // The total, with the sum of the samples that are left over.
    float total(float sum) const {
        HWY_ALIGN std::array<float, lanes> all;
        for (int v = 0; v < vectors; ++v)
            hn::Store(m_sums[v], Tag(), all.data() + v * width);
        for (const float one : all)
            sum += one;
        return sum;
    }

private:
    Vector m_sums[vectors];
};

// Calls `step` with the first sample of each vector, and with its number among those of eight.
template <class Step> void inLanes(int count, const Step &step) {
    for (int n = 0; n + lanes <= count; n += lanes)
        for (int v = 0; v < vectors; ++v)
            step(n + v * width, v);
}

void addTo(const float *row, int count, const RowTotals &to) {
    const Tag d;
    int i = 0;
    for (; i + width <= count; i += width) {
        const auto value = hn::LoadU(d, row + i);
        hn::StoreU(hn::Add(hn::LoadU(d, to.energy + i), hn::Mul(value, value)), d, to.energy + i);
        hn::StoreU(hn::Add(hn::LoadU(d, to.mass + i), value), d, to.mass + i);
        for (float *const maxima : {to.maxima, to.inPlane, to.inRows})
            hn::StoreU(hn::Max(hn::LoadU(d, maxima + i), value), d, maxima + i);
    }
    for (; i < count; ++i) {
        to.energy[i] += row[i] * row[i];
        to.mass[i] += row[i];
        for (float *const maxima : {to.maxima, to.inPlane, to.inRows})
            maxima[i] = std::max(maxima[i], row[i]);
    }
}

PartSums sumsOf(const float *part, int count) {
    const Tag d;
    Lanes energy, mass;
    auto least = hn::Zero(d);
    inLanes(count, [&](int i, int v) {
        const auto value = hn::LoadU(d, part + i);
        energy.add(v, hn::Mul(value, value));
        mass.add(v, value);
        least = hn::Min(least, value);
    });
    PartSums rest{.least = hn::GetLane(hn::MinOfLanes(d, least))};
    for (int i = count / lanes * lanes; i < count; ++i) {
        rest.energy += part[i] * part[i];
        rest.mass += part[i];
        rest.least = std::min(rest.least, part[i]);
    }
    return {energy.total(rest.energy), mass.total(rest.mass), rest.least};
}

double differencesOf(const RowAndNeighbours &rows, int count) {
    const Tag d;
    const auto square = [](Vector value) { return hn::Mul(value, value); };
    Lanes between, along;
    inLanes(count, [&](int i, int v) {
        const auto here = hn::LoadU(d, rows.here + i), twice = hn::Add(here, here);
        const auto sum = [&](const float *a, const float *b) {
            return hn::Sub(hn::Add(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), twice);
        };
        between.add(
            v, hn::Add(square(sum(rows.above, rows.below)), square(sum(rows.before, rows.after))));
    });
    const float *const here = rows.here;
    float rest = 0.0F;
    for (int i = count / lanes * lanes; i < count; ++i) {
        const float twice = 2.0F * here[i], down = rows.above[i] + rows.below[i] - twice,
                    deep = rows.before[i] + rows.after[i] - twice;
        rest += down * down + deep * deep;
    }
    const int inside = std::max(0, count - 2);
    inLanes(inside, [&](int i, int v) {
        const auto middle = hn::LoadU(d, here + i + 1);
        along.add(v, square(hn::Sub(hn::Add(hn::LoadU(d, here + i), hn::LoadU(d, here + i + 2)),
                                    hn::Add(middle, middle))));
    });
    float restAlong = 0.0F;
    for (int i = inside / lanes * lanes; i < inside; ++i) {
        const float across = here[i] + here[i + 2] - 2.0F * here[i + 1];
        restAlong += across * across;
    }
    return double(between.total(rest)) + double(along.total(restAlong));
}

} // namespace pellucid::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::field {

HWY_EXPORT(addTo);
HWY_EXPORT(sumsOf);
HWY_EXPORT(differencesOf);

void addRow(const float *row, int count, const RowTotals &to) {
    HWY_DYNAMIC_DISPATCH(addTo)(row, count, to);
}

PartSums partSums(const float *part, int count) {
    return HWY_DYNAMIC_DISPATCH(sumsOf)(part, count);
}

double squaredDifferences(const RowAndNeighbours &rows, int count) {
    return HWY_DYNAMIC_DISPATCH(differencesOf)(rows, count);
}

} // namespace pellucid::field
#endif
