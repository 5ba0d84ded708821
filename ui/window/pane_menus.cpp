// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/pane_menus.h"

#include <algorithm>

#include <QAction>
#include <QMainWindow>
#include <QMenu>

#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/shown_text.h"
#include "ui/views/mpr_view.h"
#include "ui/views/pane_area.h"
#include "ui/views/projection_view.h"
#include "ui/window/tools_menu.h"

namespace pellucid::ui {

PaneMenus::PaneMenus(QMainWindow &window, const Viewer &viewer, const ToolsMenu &tools)
    : QObject(&window), m_window(window), m_viewer(viewer), m_tools(tools) {
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
    QMenu *const tools = menu.addMenu(tr("&Tool"));
    m_tools.addToolsTo(*tools);
    if (viewer.area != m_viewer.area)
        menu.addSeparator();
    else if (pane == viewer.projection)
        addProjection(menu);
    else
        addPlane(menu, pane);
    menu.addSeparator();
    menu.addAction(viewer.area->isMaximized() ? tr("Show &all panes") : tr("&Maximize"), this,
                   [area = viewer.area, pane] { area->toggleMaximized(pane); });
    addNamed(menu, {"annotationsAction", "crosshairAction"});
    menu.addSeparator();
    addNamed(menu, {"copyPictureAction", "printAction"});
    if (viewer.area == m_viewer.area)
        addNamed(menu, {"exportPictureAction"});
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

void PaneMenus::addPlane(QMenu &menu, QWidget *pane) {
    addSubmenu(menu, "windowMenu");
    addSubmenu(menu, "slabMenu");
    menu.addSeparator();
    menu.addAction(tr("&Reset the plane's view"), this,
                   [pane] { static_cast<MprView *>(pane)->resetView(); });
    addNamed(menu, {"straightenAction", "alongScanAction"});
}

void PaneMenus::addProjection(QMenu &menu) {
    QMenu *const views = menu.addMenu(tr("&View"));
    addNamed(*views, {"frontViewAction", "backViewAction", "leftViewAction", "rightViewAction",
                      "topViewAction", "bottomViewAction"});
    addNamed(menu, {"anglesAction"});
    menu.addSeparator();
    menu.addAction(tr("&Fit to the patient") + "\tR", m_viewer.projection,
                   &ProjectionView::fitView);
    addNamed(menu, {"filmAction", "automaticToneAction", "removeCouchAction", "depthCueAction",
                    "compareAction"});
}

void PaneMenus::addNamed(QMenu &menu, std::initializer_list<const char *> actions) {
    for (const char *const name : actions)
        if (auto *const action = m_window.findChild<QAction *>(name))
            menu.addAction(action);
}

void PaneMenus::addSubmenu(QMenu &menu, const char *name) {
    if (auto *const submenu = m_window.findChild<QMenu *>(name))
        menu.addMenu(submenu);
}

} // namespace pellucid::ui
