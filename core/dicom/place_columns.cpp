// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/place_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/dicom/reasons.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;

// The largest distance between places of frames that have the same depth.
double widestMm(const std::vector<PlacedFrame> &sorted, int axis) {
    double widest = 0.0;
    for (std::size_t first = 0, end = 0; first < sorted.size(); first = end) {
        double low = sorted[first].placeMm[axis], high = low;
        for (end = first + 1; end < sorted.size() && sameDepth(sorted[end - 1], sorted[end]);
             ++end) {
            low = std::min(low, sorted[end].placeMm[axis]);
            high = std::max(high, sorted[end].placeMm[axis]);
        }
        widest = std::max(widest, high - low);
    }
    return widest;
}

// Names the position of a field of view's middle along an axis, after the patient's axis that is
// closest.
Column::Label labelAlong(const glm::dvec3 &axis) {
    static constexpr std::array sides{because::atRight,     because::atLeft, because::atAnterior,
                                      because::atPosterior, because::atFeet, because::atHead};
    int closest = 0;
    for (int n = 1; n < 3; ++n)
        if (std::abs(axis[n]) > std::abs(axis[closest]))
            closest = n;
    const bool isReversed = axis[closest] < 0.0;
    return [closest, isReversed](const std::string &value) {
        const bool isNegative = value.front() == '-';
        const auto &side = sides[std::size_t(2 * closest + (isNegative == isReversed ? 1 : 0))];
        return task::Reason(side(value.substr(isNegative ? 1 : 0)));
    };
}

// Each value is the first of a run of places whose neighbours differ by less than the tolerance.
Column columnAlong(const std::vector<PlacedFrame> &sorted, int axis, double toleranceMm) {
    std::vector<std::size_t> order(sorted.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return sorted[a].placeMm[axis] < sorted[b].placeMm[axis];
    });
    const PlacedFrame &front = sorted.front();
    const double halfMm =
        0.5 * ((axis == 0 ? front.columns : front.rows) - 1) * (*front.header.spacingMm)[axis];
    Column column(decoding::ValueKind::driftingNumber,
                  labelAlong(axis == 0 ? *front.header.rowAxis : *front.header.columnAxis),
                  sorted.size(), true);
    std::string value;
    double before = 0.0;
    for (const std::size_t n : order) {
        const double at = sorted[n].placeMm[axis];
        if (value.empty() || at - before > toleranceMm)
            value = fmt::format("{:g}", std::round(10.0 * (at + halfMm)) / 10.0);
        column.set(n, value);
        before = at;
    }
    return column;
}

} // namespace

std::vector<PlaceColumn> placeColumns(const std::vector<PlacedFrame> &sorted) {
    const PlacedFrame &front = sorted.front();
    std::vector<PlaceColumn> columns;
    for (int axis = 0; axis < 2; ++axis) {
        // Both frames may be off the line by its tolerance.
        const double toleranceMm = 2.0 * lineToleranceMm(*front.header.spacingMm),
                     widest = widestMm(sorted, axis),
                     fieldMm =
                         (axis == 0 ? front.columns : front.rows) * (*front.header.spacingMm)[axis];
        if (widest > toleranceMm)
            columns.push_back({columnAlong(sorted, axis, toleranceMm), widest > 0.5 * fieldMm});
    }
    return columns;
}

} // namespace pellucid::dicom
