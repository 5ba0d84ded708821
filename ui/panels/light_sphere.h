// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QImage>
#include <QWidget>

#include <glm/vec3.hpp>

#include "core/shading/shading.h"
#include "ui/document/commands.h"

namespace pellucid::ui {

/// A sphere under the lights, as the viewer sees it. Each light has a handle at its pole: on the
/// sphere, or outside its rim if the light is behind. Handles are moved by dragging or with the
/// arrow keys.
class LightSphere : public QWidget {
    Q_OBJECT
public:
    explicit LightSphere(QWidget *parent = nullptr);

    /// Lights in the viewer's frame.
    void setLights(const std::vector<shading::Light> &lights, double ambient, int selected);
    /// The center of a light's handle.
    QPointF handleAt(int index) const;

signals:
    void lightSelected(int index);
    /// `direction`: in the viewer's frame. `drag`: constant during one drag.
    void directionChanged(int index, const glm::dvec3 &direction, pellucid::ui::DragId drag);

protected:
    void paintEvent(QPaintEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    QSize sizeHint() const override { return {96, 96}; }

private:
    double radius() const;
    glm::dvec3 directionAt(const QPointF &point) const;
    QImage drawnSphere() const;

    std::vector<shading::Light> m_lights;
    double m_ambient = 1.0;
    int m_selected = -1;
    QImage m_sphere; ///< cached for these lights; null: must be drawn
    DragId m_drag = noDrag;
};

} // namespace pellucid::ui
