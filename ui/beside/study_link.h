// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

#include <glm/vec3.hpp>

#include "ui/document/study_view.h"
#include "ui/views/viewer.h"

namespace pellucid::ui {

/// Shows two studies alike: they share view, scale, planes, slab, layout, look and window. The
/// crosshairs keep the distance that they had when they were linked, so the user matches two
/// examinations by hand only once. Studies share looks and windows only if their values have the
/// same unit.
class StudyLink : public QObject {
    Q_OBJECT
public:
    /// The follower takes look and window of the leader.
    StudyLink(const Viewer &leader, const Viewer &follower, QObject *parent = nullptr);

    void setLinked(bool isLinked);
    bool isLinked() const { return m_isLinked; }
    /// Shares nothing until `begin`: the follower is opening another volume.
    void hold() { m_isHeld = true; }
    /// The follower takes the state of the leader and shares it from now on.
    void begin();

private:
    void followLeader(Changes changes);
    void passBack(Changes changes);
    void passView(Changes changes, const Viewer &from, const Viewer &to, double sign);
    void follow();
    bool sharesUnit() const;
    bool sharesSpace() const;
    /// Runs `f`, unless the link is off or is itself making the change.
    template <class F> void pass(F &&f);
    void linkViews(const Viewer &from, const Viewer &to);
    void passCamera(const Viewer &from, const Viewer &to);
    void linkPanes(const Viewer &from, const Viewer &to);
    void matchCrosshairs();
    void passCrosshair(const Viewer &from, const Viewer &to, double sign);
    void passWindowBack();

    Viewer m_leader, m_follower;
    bool m_isLinked = true, m_isHeld = true, m_isPassing = false;
    glm::dvec3 m_offsetMm{0.0}; ///< from the leader's crosshair to the follower's
};

} // namespace pellucid::ui
