// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/beside/study_link.h"

#include <QScopedValueRollback>

#include <glm/common.hpp>

#include "core/classify/region_edits.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/opening/segment_opener.h"
#include "ui/views/mpr_view.h"
#include "ui/views/pane_area.h"
#include "ui/views/projection_view.h"

namespace pellucid::ui {

StudyLink::StudyLink(const Viewer &leader, const Viewer &follower, QObject *parent)
    : QObject(parent), m_leader(leader), m_follower(follower) {
    linkViews(leader, follower);
    linkViews(follower, leader);
    linkPanes(leader, follower);
    linkPanes(follower, leader);
    connect(&leader.document, &Document::changed, this, &StudyLink::followLeader);
    connect(&follower.document, &Document::changed, this, &StudyLink::passBack);
    // A pane that is resized keeps its zoom; the scale of both is that of the leader.
    for (const Viewer &resized : {leader, follower})
        for (std::size_t n = 0; n < resized.planes.size(); ++n)
            connect(resized.planes[n], &MprView::resized, this, [this, n] {
                pass([&] { m_follower.planes[n]->adoptScale(*m_leader.planes[n]); });
            });
    // The signal also comes after a merged edit.
    connect(follower.document.undoStack(), &QUndoStack::indexChanged, this,
            &StudyLink::passWindowBack);
}

void StudyLink::followLeader(Changes changes) {
    if (changes & Change::volume) { // it is linked when its study is open
        const bool isWaited = m_isHeld;
        m_isHeld = true;
        if (!isWaited)
            QMetaObject::invokeMethod(this, &StudyLink::begin, Qt::QueuedConnection);
        return;
    }
    if (changes & (Change::scene | Change::displayWindow))
        follow();
    passView(changes, m_leader, m_follower, 1.0);
}

void StudyLink::passBack(Changes changes) {
    if (changes & Change::volume) // the study beside links it again
        return;
    passView(changes, m_follower, m_leader, -1.0);
}

void StudyLink::passView(Changes changes, const Viewer &from, const Viewer &to, double sign) {
    if (changes & Change::crosshair)
        passCrosshair(from, to, sign);
    if (changes & Change::pose)
        pass([&] { passCamera(from, to); });
    if (changes & Change::paneSize)
        pass([&] { passCamera(m_leader, m_follower); });
    if (changes & Change::cut)
        pass([&] { to.document.setCut(from.document.cut()); });
}

template <class F> void StudyLink::pass(F &&f) {
    if (!m_isLinked || m_isHeld || m_isPassing || !m_leader.document.volume() ||
        !m_follower.document.volume())
        return;
    const QScopedValueRollback passing(m_isPassing, true);
    f();
}

bool StudyLink::sharesUnit() const {
    const volume::Volume &a = *m_leader.document.volume(), &b = *m_follower.document.volume();
    // Values without a unit that are differences are of another kind than those that are not.
    return a.unit() == b.unit() && a.notes().isDifference == b.notes().isDifference;
}

bool StudyLink::sharesSpace() const {
    const std::string &space = m_leader.document.volume()->notes().frameOfReferenceUid;
    return !space.empty() && space == m_follower.document.volume()->notes().frameOfReferenceUid;
}

void StudyLink::setLinked(bool isLinked) {
    m_isLinked = isLinked;
    matchCrosshairs();
    follow();
}

void StudyLink::begin() {
    m_isHeld = false;
    matchCrosshairs();
    follow();
}

void StudyLink::matchCrosshairs() {
    if (m_leader.document.volume() && m_follower.document.volume())
        m_offsetMm = m_follower.document.crosshair().mm - m_leader.document.crosshair().mm;
}

void StudyLink::follow() {
    pass([this] {
        if (!m_follower.document.isPreview() && sharesUnit()) {
            const scene::Scene &shown = m_leader.document.scene();
            const scene::Scene &own = m_follower.document.scene();
            scene::Scene scene = shown;
            scene.camera = own.camera;
            scene.isOfDifference = own.isOfDifference;
            // Points, strokes and cuts are places in one space.
            if (!sharesSpace())
                scene.look = classify::withoutMarks(shown.look);
            dropMissing(scene.look, m_follower.document.segments().get());
            // A window of values without a unit is meaningful for its own volume only.
            if (volume::isCalibrated(m_leader.document.volume()->unit()))
                m_follower.document.setDisplayWindow(m_leader.document.displayWindow());
            else
                scene.fieldWindow = own.fieldWindow;
            if (!(scene == m_follower.document.scene()))
                m_follower.document.setScene(scene);
        }
        m_follower.document.setCut(m_leader.document.cut());
        passCamera(m_leader, m_follower);
        for (std::size_t n = 0; n < m_leader.planes.size(); ++n)
            m_follower.planes[n]->adoptScale(*m_leader.planes[n]);
    });
}

void StudyLink::linkViews(const Viewer &from, const Viewer &to) {
    for (std::size_t n = 0; n < from.planes.size(); ++n)
        connect(from.planes[n], &MprView::viewMoved, this,
                [this, from, to, n] { pass([&] { to.planes[n]->adoptScale(*from.planes[n]); }); });
}

void StudyLink::passCamera(const Viewer &from, const Viewer &to) {
    to.projection->setOrbitsCrosshair(from.projection->orbitsCrosshair());
    to.projection->adoptCamera(from.document.scene().camera, from.projection->pivotMm());
}

void StudyLink::linkPanes(const Viewer &from, const Viewer &to) {
    // Also while the studies are not linked: panes are compared in pairs.
    connect(from.area, &PaneArea::arranged, to.area,
            [from, to] { to.area->arrangeAs(*from.area); });
}

void StudyLink::passCrosshair(const Viewer &from, const Viewer &to, double sign) {
    pass([&] {
        const volume::Lattice &lattice = to.document.volume()->lattice();
        const glm::dvec3 wanted = from.document.crosshair().mm + sign * m_offsetMm;
        // The other study may extend beyond this one.
        const glm::dvec3 last(lattice.size().i - 1, lattice.size().j - 1, lattice.size().k - 1);
        const glm::dvec3 voxel =
            glm::clamp(lattice.voxel(volume::PatientPoint{wanted}).v, glm::dvec3(0.0), last);
        to.document.setCrosshair(lattice.patient(volume::VoxelPoint{voxel}));
    });
}

void StudyLink::passWindowBack() {
    pass([this] {
        const QUndoStack &edits = *m_follower.document.undoStack();
        const auto *const last =
            dynamic_cast<const EditDisplayWindow *>(edits.command(edits.index() - 1));
        if (last == nullptr || !sharesUnit() ||
            !volume::isCalibrated(m_leader.document.volume()->unit()))
            return;
        // One drag of the follower is one step to undo.
        m_leader.document.undoStack()->push(new EditDisplayWindow(
            m_leader.document, m_follower.document.displayWindow(), last->drag()));
    });
}

} // namespace pellucid::ui
