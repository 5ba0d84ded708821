// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/measurement_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <QLineF>

#include <glm/geometric.hpp>

namespace pellucid::ui {

using measure::Kind;
using measure::Measurement;

std::vector<glm::dvec3> gripsOf(const Measurement &m) {
    if (!measure::isRegion(m.kind))
        return m.pointsMm;
    const glm::dvec3 a = m.pointsMm[0], b = m.pointsMm[1];
    const glm::dvec3 across = glm::dot(b - a, m.axes.right) * m.axes.right;
    return {a, a + across, b, b - across};
}

void moveGrip(Measurement &m, int grip, const glm::dvec3 &to) {
    if (measure::isRegion(m.kind)) {
        // A region stays in its plane, even if the pane shows the slice beside it.
        const glm::dvec3 opposite = gripsOf(m)[std::size_t((grip + 2) % 4)],
                         normal = m.axes.toViewer();
        m.pointsMm = {opposite, to - glm::dot(to - opposite, normal) * normal};
    } else {
        m.pointsMm[std::size_t(grip)] = to;
    }
}

double distanceToSegment(const QPointF &p, const QPointF &a, const QPointF &b) {
    const QPointF d = b - a;
    const double square = QPointF::dotProduct(d, d);
    const double t =
        square > 0.0 ? std::clamp(QPointF::dotProduct(p - a, d) / square, 0.0, 1.0) : 0.0;
    return QLineF(p, a + t * d).length();
}

std::vector<QPolygonF> outlinesOf(const Measurement &m, const PaneMapping &mapping) {
    QPolygonF outline;
    const auto add = [&](const glm::dvec3 &mm) { outline << mapping.positionOf({mm}); };
    if (m.kind == Kind::ellipse) {
        const glm::dvec3 center = 0.5 * (m.pointsMm[0] + m.pointsMm[1]),
                         half = 0.5 * (m.pointsMm[1] - m.pointsMm[0]);
        constexpr int corners = 72;
        for (int n = 0; n <= corners; ++n) {
            const double t = 2.0 * std::numbers::pi * n / corners;
            add(center + std::cos(t) * glm::dot(half, m.axes.right) * m.axes.right +
                std::sin(t) * glm::dot(half, m.axes.up) * m.axes.up);
        }
        return {outline};
    }
    for (const glm::dvec3 &p : gripsOf(m))
        add(p);
    switch (m.kind) {
    case Kind::text:
        return {};
    case Kind::cobbAngle: // the second line may not exist yet
        return outline.size() < 4 ? std::vector<QPolygonF>{outline}
                                  : std::vector<QPolygonF>{outline.first(2), outline.last(2)};
    case Kind::rectangle:
        outline << outline.first();
        return {outline};
    default:
        return {outline};
    }
}

QPolygonF arrowHeadOf(const Measurement &m, const PaneMapping &mapping) {
    if (m.kind != Kind::arrow)
        return {};
    constexpr double pixels = 11.0, halfAngleDeg = 24.0;
    QLineF stroke(mapping.positionOf({m.pointsMm[0]}), mapping.positionOf({m.pointsMm[1]}));
    const double direction = stroke.angle();
    stroke.setLength(std::min(pixels, stroke.length()));
    QPolygonF head;
    for (const double side : {-halfAngleDeg, halfAngleDeg}) {
        stroke.setAngle(direction + side);
        head << stroke.p2();
    }
    head.insert(1, stroke.p1());
    return head;
}

} // namespace pellucid::ui
