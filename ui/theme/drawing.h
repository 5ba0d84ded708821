// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QBrush>
#include <QByteArray>
#include <QPainterPath>
#include <QPen>
#include <QRectF>

class QPainter;

namespace pellucid::ui {

/// An icon in the part of SVG that ours use: paths, circles, ellipses and rectangles, which may
/// have round corners, with colors, vertical gradients and opacities. Lengths have no units.
class Drawing {
public:
    /// *Throws* std::logic_error if the drawing has other elements or commands.
    explicit Drawing(const QByteArray &svg);

    /// Fills the rectangle with it.
    void paint(QPainter &painter, const QRectF &to) const;

private:
    struct Shape {
        QPainterPath path;
        QBrush brush;
        QPen pen;
    };
    QRectF m_box;
    std::vector<Shape> m_shapes;
};

} // namespace pellucid::ui
