// SPDX-License-Identifier: GPL-3.0-or-later
// Before Qt, which defines a macro with a name that oneTBB uses.
#include <tbb/parallel_for.h>

#include "ui/views/segment_tints.h"

#include <algorithm>
#include <cmath>

#include <QColor>

#include <glm/common.hpp>

#include "ui/document/document.h"

namespace pellucid::ui {

namespace {

// Weak enough that the grey values stay readable.
constexpr int strength = 90, most = 255;
// Enough to see what is left out, and what it is.
constexpr int dimming = 165;
constexpr int leastSaturation = 40;

QRgb mixed(QRgb below, QRgb color, int share) {
    const int alpha = strength * share / most;
    const auto mix = [&](int from, int to) { return from + (to - from) * alpha / most; };
    return qRgb(mix(qRed(below), qRed(color)), mix(qGreen(below), qGreen(color)),
                mix(qBlue(below), qBlue(color)));
}

QRgb rgbOf(const classify::Color &color) {
    const auto byte = [](double c) { return int(std::lround(255.0 * c)); };
    return qRgb(byte(color.red), byte(color.green), byte(color.blue));
}

// The samples of the lattice at the pixels of a plane.
class PixelGrid {
public:
    PixelGrid(const mpr::Plane &plane, const volume::Lattice &lattice)
        : m_plane(plane), m_lattice(lattice), m_origin(voxel(0.0, 0.0)),
          m_columnStep(voxel(1.0, 0.0) - m_origin), m_rowStep(voxel(0.0, 1.0) - m_origin) {}

    volume::VoxelIndex at(int column, int row) const {
        const glm::dvec3 n =
            glm::floor(m_origin + double(column) * m_columnStep + double(row) * m_rowStep + 0.5);
        return {int(n.x), int(n.y), int(n.z)};
    }

    // The pixels that a box of samples may cover; empty if the plane does not meet it.
    QRect pixelsOf(const volume::VoxelBox &box) const {
        const glm::dvec3 normal = m_plane.axes.toViewer();
        glm::dvec2 low(1e30), high(-1e30);
        double front = -1e30, behind = 1e30;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 v((corner & 1) != 0 ? box.hi.i - 0.5 : box.lo.i - 0.5,
                               (corner & 2) != 0 ? box.hi.j - 0.5 : box.lo.j - 0.5,
                               (corner & 4) != 0 ? box.hi.k - 0.5 : box.lo.k - 0.5);
            const volume::PatientPoint point = m_lattice.patient(volume::VoxelPoint{v});
            const double depth = glm::dot(point.mm - m_plane.center.mm, normal);
            front = std::max(front, depth);
            behind = std::min(behind, depth);
            const glm::dvec2 pixel = m_plane.pixel(point);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        }
        if (front < 0.0 || behind > 0.0)
            return {};
        const glm::dvec2 size(m_plane.width, m_plane.height);
        low = glm::clamp(glm::floor(low), glm::dvec2(0.0), size);
        high = glm::clamp(glm::ceil(high) + 1.0, low, size);
        return {int(low.x), int(low.y), int(high.x - low.x), int(high.y - low.y)};
    }

private:
    glm::dvec3 voxel(double column, double row) const {
        return m_lattice.voxel(m_plane.at(column, row)).v;
    }

    const mpr::Plane &m_plane;
    const volume::Lattice &m_lattice;
    glm::dvec3 m_origin, m_columnStep, m_rowStep;
};

void dimRow(QRgb *pixels, int row, int width, const volume::Coverage &coverage,
            const PixelGrid &grid) {
    for (int column = 0; column < width; ++column)
        if (const int share = coverage.at(grid.at(column, row)); share < most) {
            const int kept = most - dimming * (most - share) / most;
            const QRgb was = pixels[column];
            pixels[column] =
                qRgb(qRed(was) * kept / most, qGreen(was) * kept / most, qBlue(was) * kept / most);
        }
}

} // namespace

std::vector<SegmentTint> segmentTints(const Document &document) {
    std::vector<SegmentTint> tints;
    if (document.segments() && document.tintsSegments())
        for (const classify::TissueClass &tissue : document.scene().look.classes)
            if (const segment::Segment *const segment = document.segments()->find(tissue.segment);
                segment != nullptr && tissue.weight > 0.0)
                tints.push_back({segment->coverage, rgbOf(tissue.color)});
    if (const auto &marked = document.marking().tint()) {
        // Grey over grey would not be seen.
        const QRgb color = rgbOf(marked->color);
        tints.push_back({marked->coverage, color, QColor(color).saturation() < leastSaturation});
    }
    return tints;
}

void tintSegments(QImage &picture, const mpr::Plane &plane, const volume::Lattice &lattice,
                  const std::vector<SegmentTint> &tints) {
    if (tints.empty())
        return;
    const PixelGrid grid(plane, lattice);
    std::vector<QRect> areas;
    for (const SegmentTint &tint : tints)
        areas.push_back(grid.pixelsOf(tint.coverage->box));
    uchar *const bits = picture.bits();
    const std::ptrdiff_t stride = picture.bytesPerLine();
    tbb::parallel_for(0, plane.height, [&](int row) {
        auto *const pixels = reinterpret_cast<QRgb *>(bits + row * stride);
        for (std::size_t n = 0; n < tints.size(); ++n) {
            const QRect &area = areas[n];
            if (tints[n].dimsOutside) {
                dimRow(pixels, row, plane.width, *tints[n].coverage, grid);
                continue;
            }
            if (area.isEmpty() || row < area.top() || row > area.bottom())
                continue;
            for (int column = area.left(); column <= area.right(); ++column)
                if (const int share = tints[n].coverage->at(grid.at(column, row)); share != 0)
                    pixels[column] = mixed(pixels[column], tints[n].color, share);
        }
    });
}

} // namespace pellucid::ui
