// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/grow_tool.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <QPainter>

#include <glm/common.hpp>

#include "ui/document/document.h"
#include "ui/document/region_commands.h"
#include "ui/language/number_text.h"

namespace pellucid::ui {

namespace {

// A drag of this many logical pixels doubles or halves the range of values.
constexpr double doublingPixels = 60.0;
// The first range: this many standard deviations of the values around the click, and no less than
// this share of the display window, so that a uniform neighbourhood has a range, too.
constexpr double deviations = 2.5, minShare = 0.04;
// Bone starts here, in HU; a drag moves it.
constexpr double boneHu = 200.0;

struct Neighbourhood {
    double value, deviation;
};

// Of the finite ones of the 27 samples around a point; nothing if its own value is not finite.
std::optional<Neighbourhood> around(const volume::Volume &volume, volume::PatientPoint point) {
    const glm::dvec3 v = glm::round(volume.lattice().voxel(point).v);
    const volume::VoxelIndex middle{int(v.x), int(v.y), int(v.z)};
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int k = middle.k - 1; k <= middle.k + 1; ++k)
        for (int j = middle.j - 1; j <= middle.j + 1; ++j)
            for (int i = middle.i - 1; i <= middle.i + 1; ++i) {
                const double value = volume.lattice().contains({i, j, k})
                                         ? double(volume.value({i, j, k}))
                                         : std::nan("");
                if (std::isfinite(value)) {
                    sum += value;
                    squares += value * value;
                    ++count;
                }
            }
    const double value = volume.value(middle), mean = sum / count;
    if (!std::isfinite(value))
        return std::nullopt;
    return Neighbourhood{value, std::sqrt(std::max(squares / count - mean * mean, 0.0))};
}

} // namespace

bool GrowTool::press(const QPointF &at) {
    if (!m_document.volume() || m_document.isPreview())
        return false;
    const auto point = regionPoint(m_document, m_pane, m_view, at);
    const auto near = point ? around(*m_document.volume(), *point) : std::nullopt;
    if (!near)
        return false;
    m_isDragging = true;
    m_point = *point;
    m_dragged = 0.0;
    m_value = near->value;
    m_spread = std::max(deviations * near->deviation, minShare * m_document.displayWindow().width);
    seek();
    return true;
}

classify::TissueClass GrowTool::region() const {
    const RegionOptions &options = m_document.marking().options();
    const double factor = std::exp2(m_dragged / doublingPixels);
    if (options.isBone) {
        const bool isHu = m_document.volume()->unit() == volume::ValueUnit::hounsfield;
        const double least = isHu ? std::min(boneHu, m_value) : m_value - m_spread;
        return classify::boneRegion(m_document.volume()->lattice(), m_point,
                                    least - m_spread * (factor - 1.0));
    }
    return classify::connectedRegion(m_point, m_value - factor * m_spread,
                                     m_value + factor * m_spread, options.leakMm);
}

void GrowTool::seek() {
    if (!m_document.marking().options().addsPoints)
        m_document.marking().setCandidate(region());
}

bool GrowTool::move(const MouseMove &mouse) {
    if (!m_isDragging)
        return false;
    m_dragged -= mouse.delta.y();
    seek();
    return true;
}

void GrowTool::release(const QPointF & /*at*/) {
    if (!m_isDragging)
        return;
    m_isDragging = false;
    if (m_document.marking().options().addsPoints)
        usePoint(m_document, m_point);
    else
        useRegion(m_document, region());
    // Afterwards the planes show what the class is now.
    m_document.marking().setCandidate(std::nullopt);
}

void GrowTool::cancel() {
    m_isDragging = false;
    m_document.marking().setCandidate(std::nullopt);
}

void GrowTool::paint(QPainter &painter, const ToolSurface &surface, Marks marks) const {
    if (!m_isDragging || marks <= Marks::plain)
        return;
    constexpr double radius = 5.0;
    const QPointF at = surface.mapping.positionOf(m_point);
    painter.setPen(QPen(surface.colors.accent, 1.5));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(at, radius, radius);
    if (m_document.marking().options().addsPoints)
        return;
    const classify::TissueClass chosen = region();
    const QString high = chosen.high < classify::highestValue ? numberText(chosen.high) : QString();
    drawText(painter, QRect(at.toPoint() + QPoint(10, -22), QSize(240, 20)), Qt::AlignLeft,
             QString("%1 .. %2").arg(numberText(chosen.low), high), surface.colors.text);
}

} // namespace pellucid::ui
