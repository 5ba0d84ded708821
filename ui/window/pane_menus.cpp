// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/pane_menus.h"

#include <algorithm>

#include <QMenu>

#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/shown_text.h"
#include "ui/views/mpr_view.h"
#include "ui/views/pane_area.h"
#include "ui/views/projection_view.h"
#include "ui/window/actions/commands.h"

namespace pellucid::ui {

PaneMenus::PaneMenus(const Viewer &viewer, ActionTable &actions, QObject *parent)
    : QObject(parent), m_viewer(viewer), m_actions(actions) {
    watch(viewer);
}

void PaneMenus::addBeside(const Viewer &viewer) {
    watch(viewer);
}

void PaneMenus::watch(const Viewer &viewer) {
    const auto show = [this, viewer](QWidget *pane, const QPoint &globalAt, int measurement) {
        open(viewer, pane, globalAt, measurement);
    };
    for (MprView *const plane : viewer.planes)
        connect(plane, &MprView::menuRequested, this, show);
    connect(viewer.projection, &ProjectionView::menuRequested, this, show);
}

void PaneMenus::open(const Viewer &viewer, QWidget *pane, const QPoint &globalAt, int measurement) {
    if (!viewer.document.volume())
        return;
    auto *const opened = new QMenu(pane);
    QMenu &menu = *opened;
    menu.setObjectName("paneMenu");
    menu.setAttribute(Qt::WA_DeleteOnClose);
    if (measurement >= 0)
        addMeasurement(menu, viewer.document, measurement);
    const Menus all = menus();
    const bool isOpenStudy = viewer.area == m_viewer.area;
    m_actions.fill(menu, {{"", tr("&Tool"), all.tools}});
    if (!isOpenStudy) {
        menu.addSeparator();
    } else if (pane == viewer.projection) {
        menu.addAction(tr("&Fit to the patient") + "\tR", viewer.projection,
                       &ProjectionView::fitView);
        m_actions.fill(menu, all.projection);
    } else {
        menu.addAction(tr("&Reset the plane's view"), this,
                       [pane] { static_cast<MprView *>(pane)->resetView(); });
        m_actions.fill(menu, all.plane);
    }
    menu.addSeparator();
    menu.addAction(viewer.area->isMaximized() ? tr("Show &all panes") : tr("&Maximize"), this,
                   [area = viewer.area, pane] { area->toggleMaximized(pane); });
    m_actions.fill(
        menu,
        {{"annotationsAction"}, {"crosshairAction"}, {}, {"copyPictureAction"}, {"printAction"}});
    if (isOpenStudy)
        m_actions.fill(menu, {{"exportPictureAction"}});
    m_actions.refresh();
    menu.popup(globalAt);
}

void PaneMenus::addMeasurement(QMenu &menu, Document &document, int measurement) {
    const auto &measured = document.measured();
    if (measurement >= int(measured.size()))
        return;
    const measure::Measurement chosen = measured[std::size_t(measurement)].measurement;
    const QString name = QString::fromStdString(chosen.name).simplified().left(30);
    menu.addAction(name.isEmpty() ? tr("&Delete") : tr("&Delete %1").arg(menuText(name)), this,
                   [&document, chosen] {
                       auto all = document.measurements();
                       const auto found = std::find(all.begin(), all.end(), chosen);
                       if (found == all.end())
                           return;
                       all.erase(found);
                       document.selectMeasurement(-1);
                       document.undoStack()->push(
                           new EditMeasurements(document, all, tr("Delete measurement")));
                   });
    menu.addSeparator();
}

} // namespace pellucid::ui
