// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <QObject>
#include <QTimer>

namespace pellucid::ui {

class MprView;
class ProjectionView;

/// Plays the focused pane: loops through the slices of a plane, or turns the projection around the
/// patient's long axis.
class Cine : public QObject {
    Q_OBJECT
public:
    Cine(const std::array<MprView *, 3> &planes, ProjectionView &projection,
         QObject *parent = nullptr);

    void toggle();
    void stop();
    bool isPlaying() const { return m_timer.isActive(); }
    int framesPerSecond() const { return m_rate; }
    void setFramesPerSecond(int rate);

signals:
    void playingChanged(bool playing);

private:
    void step();

    std::array<MprView *, 3> m_planes;
    ProjectionView &m_projection;
    MprView *m_plane = nullptr; ///< none: the projection
    int m_rate = 15;
    QTimer m_timer;
};

} // namespace pellucid::ui
