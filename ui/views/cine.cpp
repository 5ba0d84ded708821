// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/cine.h"

#include "ui/views/mpr_view.h"
#include "ui/views/projection_view.h"

namespace pellucid::ui {

namespace {

constexpr double turnDeg = 2.0;

} // namespace

Cine::Cine(const std::array<MprView *, 3> &planes, ProjectionView &projection, QObject *parent)
    : QObject(parent), m_planes(planes), m_projection(projection) {
    m_timer.setTimerType(Qt::PreciseTimer);
    setFramesPerSecond(m_rate);
    connect(&m_timer, &QTimer::timeout, this, &Cine::step);
}

void Cine::toggle() {
    if (isPlaying()) {
        stop();
        return;
    }
    m_plane = nullptr;
    for (MprView *plane : m_planes)
        if (plane->hasFocus())
            m_plane = plane;
    m_timer.start();
    emit playingChanged(true);
}

void Cine::stop() {
    if (!isPlaying())
        return;
    m_timer.stop();
    emit playingChanged(false);
}

void Cine::setFramesPerSecond(int rate) {
    m_rate = rate;
    m_timer.setInterval(1000 / rate);
}

void Cine::step() {
    if (m_plane == nullptr)
        m_projection.turnAroundPatient(turnDeg);
    else if (m_plane->isAtEnd())
        m_plane->scrollToEnd(false);
    else
        m_plane->scroll(1);
}

} // namespace pellucid::ui
