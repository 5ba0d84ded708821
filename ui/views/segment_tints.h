// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include <QImage>

#include "core/mpr/plane.h"
#include "core/volume/coverage.h"

namespace pellucid::ui {

class Document;

/// A segment and the color that the planes show it in.
struct SegmentTint {
    std::shared_ptr<const volume::Coverage> coverage;
    QRgb color = 0;
    bool dimsOutside = false; ///< darkens what is not in it, instead of coloring what is
    bool operator==(const SegmentTint &) const = default;
};

/// The segments of the shown classes, unless the planes do not show them, and the region that is
/// being marked.
std::vector<SegmentTint> segmentTints(const Document &document);

/// Tints a picture of a plane where its pixels are in segments, the later ones over the earlier.
/// *Shape*: the picture has the plane's pixels and 32 bits for each.
void tintSegments(QImage &picture, const mpr::Plane &plane, const volume::Lattice &lattice,
                  const std::vector<SegmentTint> &tints);

} // namespace pellucid::ui
