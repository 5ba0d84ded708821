// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/light_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "ui/theme/theme.h"

namespace pellucid::ui {

namespace {

// Fraction of the widget's half side. The margin is for lights behind the sphere.
constexpr double sphereShare = 0.64;
// The largest distance of a handle from the center, in radii: a light directly behind.
constexpr double farthest = 1.3;
constexpr double grabPixels = 9.0;
constexpr double degreesPerKey = 5.0;

} // namespace

LightSphere::LightSphere(QWidget *parent) : QWidget(parent) {
    setObjectName("lightSphere");
    setAccessibleName(tr("Light directions"));
    setToolTip(tr("Drag a light over the sphere; beyond the rim, it shines from behind"));
    setFocusPolicy(Qt::StrongFocus);
    setFixedSize(96, 96);
}

void LightSphere::setLights(const std::vector<shading::Light> &lights, double ambient,
                            int selected) {
    if (lights != m_lights || ambient != m_ambient)
        m_sphere = {};
    m_lights = lights;
    m_ambient = ambient;
    m_selected = selected;
    update();
}

double LightSphere::radius() const {
    return 0.5 * sphereShare * std::min(width(), height());
}

// On the sphere, a handle is at its light's pole. From the rim to `farthest`, the angle to the
// viewer increases from 90 to 180 degrees.
QPointF LightSphere::handleAt(int index) const {
    const glm::dvec3 d = glm::normalize(m_lights[std::size_t(index)].direction);
    const double across = std::hypot(d.x, d.y);
    const double beyond = std::atan2(-d.z, across) / (0.5 * std::numbers::pi); // in right angles
    const double shown = d.z < 0.0 ? 1.0 + beyond * (farthest - 1.0) : across;
    // A light directly behind has no direction on the rim: it is drawn at the top.
    const double x = across > 1e-9 ? d.x / across : 0.0, y = across > 1e-9 ? d.y / across : 1.0;
    return QPointF(0.5 * width() + radius() * shown * x, 0.5 * height() - radius() * shown * y);
}

glm::dvec3 LightSphere::directionAt(const QPointF &point) const {
    const double x = (point.x() - 0.5 * width()) / radius(),
                 y = (0.5 * height() - point.y()) / radius();
    const double distance = std::hypot(x, y);
    if (distance <= 1.0)
        return {x, y, std::sqrt(1.0 - distance * distance)};
    const double beyond = std::min(1.0, (distance - 1.0) / (farthest - 1.0));
    const double angle = 0.5 * std::numbers::pi * beyond, across = std::cos(angle) / distance;
    return {across * x, across * y, -std::sin(angle)};
}

QImage LightSphere::drawnSphere() const {
    const double ratio = devicePixelRatioF();
    const int side = int(std::ceil(2.0 * radius() * ratio));
    QImage image(side, side, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::transparent);
    const auto lightAt = [&](const glm::dvec3 &normal) {
        glm::dvec3 light(0.2 * m_ambient);
        for (const shading::Light &one : m_lights)
            light += one.strength * 0.5 * (1.0 + glm::dot(normal, glm::normalize(one.direction))) *
                     glm::dvec3(one.color.red, one.color.green, one.color.blue);
        return light;
    };
    // Scale so that the brightest point is not clipped: several lights must still show the shape. A
    // sum of such lights is brightest in the direction of the weighted sum of their poles.
    glm::dvec3 poles(0.0, 0.0, 1e-6), brightest(0.0);
    for (const shading::Light &one : m_lights)
        poles += one.strength * glm::normalize(one.direction);
    brightest = lightAt(glm::normalize(poles));
    const double scale = 1.0 / std::max({1.0, brightest.x, brightest.y, brightest.z});
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double x = 2.0 * (column + 0.5) / side - 1.0, y = 1.0 - 2.0 * (row + 0.5) / side;
            const double r = x * x + y * y;
            if (r >= 1.0)
                continue;
            const glm::dvec3 light = scale * lightAt({x, y, std::sqrt(1.0 - r)});
            const auto level = [](double l) { return int(std::lround(230.0 * std::min(1.0, l))); };
            // Antialias the rim over one pixel.
            const double cover = std::clamp((1.0 - std::sqrt(r)) * 0.5 * side, 0.0, 1.0);
            image.setPixelColor(
                column, row,
                QColor(level(light.x), level(light.y), level(light.z), int(255.0 * cover)));
        }
    image.setDevicePixelRatio(ratio);
    return image;
}

void LightSphere::paintEvent(QPaintEvent *) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setOpacity(isEnabled() ? 1.0 : 0.4);
    if (m_sphere.isNull() || m_sphere.devicePixelRatio() != devicePixelRatioF())
        m_sphere = drawnSphere();
    painter.drawImage(QPointF(0.5 * width() - radius(), 0.5 * height() - radius()), m_sphere);
    painter.setBrush(Qt::NoBrush);
    for (int n = 0; n < int(m_lights.size()); ++n) {
        const QPointF at = handleAt(n);
        const bool isBehind = m_lights[std::size_t(n)].direction.z < 0.0;
        painter.setPen(QPen(QColor(0, 0, 0, 160), 3.5));
        painter.drawEllipse(at, 5.0, 5.0);
        painter.setPen(QPen(Theme::current().color(n == m_selected ? "accent" : "muted"), 2.0,
                            isBehind ? Qt::DotLine : Qt::SolidLine));
        painter.drawEllipse(at, 5.0, 5.0);
    }
    if (hasFocus()) {
        painter.setPen(QPen(Theme::current().color("accent"), 1.0));
        painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 5.0, 5.0);
    }
}

void LightSphere::mousePressEvent(QMouseEvent *event) {
    m_drag = nextDragId();
    int nearest = -1;
    double nearestDistance = grabPixels;
    for (int n = 0; n < int(m_lights.size()); ++n) {
        const QPointF away = handleAt(n) - event->position();
        if (std::hypot(away.x(), away.y()) < nearestDistance) {
            nearestDistance = std::hypot(away.x(), away.y());
            nearest = n;
        }
    }
    if (nearest >= 0)
        emit lightSelected(nearest);
    else // move the selected light to the click
        mouseMoveEvent(event);
}

void LightSphere::mouseMoveEvent(QMouseEvent *event) {
    if ((event->buttons() & Qt::LeftButton) != 0 && m_selected >= 0)
        emit directionChanged(m_selected, directionAt(event->position()), m_drag);
}

void LightSphere::keyPressEvent(QKeyEvent *event) {
    glm::dvec3 axis(0.0);
    switch (event->key()) {
    case Qt::Key_Left:
        axis = {0, -1, 0};
        break;
    case Qt::Key_Right:
        axis = {0, 1, 0};
        break;
    case Qt::Key_Up:
        axis = {-1, 0, 0};
        break;
    case Qt::Key_Down:
        axis = {1, 0, 0};
        break;
    default:
        QWidget::keyPressEvent(event);
        return;
    }
    if (m_selected >= 0)
        emit directionChanged(m_selected,
                              glm::angleAxis(glm::radians(degreesPerKey), axis) *
                                  m_lights[std::size_t(m_selected)].direction,
                              0);
}

} // namespace pellucid::ui
