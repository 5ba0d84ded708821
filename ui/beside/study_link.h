// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

#include <glm/vec3.hpp>

#include "ui/views/viewer.h"

namespace pellucid::ui {

/// Two studies that are looked at alike: view, zoom, planes, slab, layout, look and window of one
/// are those of the other; the crosshairs keep the distance that they had when they were linked, so
/// that two examinations are matched by hand once. Looks and windows are shared by values of one
/// unit only.
class StudyLink : public QObject {
    Q_OBJECT
public:
    /// *Shape*: `leader`: whose look and window the other one takes.
    StudyLink(const Viewer &leader, const Viewer &follower, QObject *parent = nullptr);

    void setLinked(bool isLinked);
    bool isLinked() const { return m_isLinked; }
    /// Another volume comes for the follower: the leader is left alone till it is there.
    void hold() { m_isHeld = true; }
    /// It is there, and follows from now on.
    void begin();

private:
    void follow();
    bool sharesUnit() const;
    /// Runs it unless it is the answer to a change that the link itself made.
    template <class F> void pass(F &&f);
    void linkViews(const Viewer &from, const Viewer &to);
    void passCamera(const Viewer &from, const Viewer &to);
    void linkPanes(const Viewer &from, const Viewer &to);
    void matchCrosshairs();
    void passCrosshair(const Viewer &from, const Viewer &to, double sign);
    void passWindowBack();

    Viewer m_leader, m_follower;
    bool m_isLinked = true, m_isHeld = true, m_isPassing = false;
    glm::dvec3 m_offsetMm{0.0}; ///< of the follower's crosshair from the leader's
};

} // namespace pellucid::ui
