// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/view_menu.h"

#include <QActionGroup>
#include <QMainWindow>
#include <QMenu>
#include <QSettings>

#include "ui/document/add_command.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/views/mpr_view.h"
#include "ui/views/pane_area.h"
#include "ui/views/projection_view.h"
#include "ui/window/engine_menu.h"

namespace pellucid::ui {

namespace {

constexpr auto freeRotationKey = "view/freeRotation", bannerKey = "view/patientBanner";

} // namespace

ViewMenu::ViewMenu(QMenu &menu, QMainWindow &window, const Viewer &viewer, GraphicsCard &card)
    : QObject(&menu), m_menu(menu), m_viewer(viewer), m_layouts(new QActionGroup(this)) {
    addStandardViews();
    ProjectionView *const projection = viewer.projection;
    QAction *about =
        add(tr("&Orbit about the crosshair"), "orbitCrosshairAction", QKeySequence("O"),
            [projection] { projection->setOrbitsCrosshair(!projection->orbitsCrosshair()); });
    about->setCheckable(true);
    QAction *free = add(tr("&Free rotation (trackball)"), "freeRotationAction", {}, [projection] {
        projection->setTurnsFreely(!projection->turnsFreely());
        QSettings().setValue(freeRotationKey, projection->turnsFreely());
    });
    free->setCheckable(true);
    projection->setTurnsFreely(QSettings().value(freeRotationKey).toBool());
    free->setChecked(projection->turnsFreely());
    QAction *tints = add(
        tr("&Tint segments in the planes"), "tintSegmentsAction", {},
        [&document = viewer.document] { document.setTintsSegments(!document.tintsSegments()); });
    tints->setCheckable(true);
    connect(&menu, &QMenu::aboutToShow, this, [tints, &document = viewer.document] {
        tints->setChecked(document.tintsSegments());
        tints->setEnabled(document.segments() != nullptr);
    });
    QAction *compare =
        add(tr("&Compare with the look before") + "\t" + tr("hold Q"), "compareAction", {},
            [this, projection] { emit comparisonRequested(!projection->isComparing()); });
    compare->setCheckable(true);
    connect(&menu, &QMenu::aboutToShow, this,
            [compare, projection] { compare->setChecked(projection->isComparing()); });
    addOverlays();
    addBeside();
    add(tr("Prepare the projection a&gain"), "prepareAgainAction", QKeySequence("F5"),
        [this] { emit preparationRequested(); });
    menu.addSeparator();
    addLayouts();
    m_afterPanes = menu.addSeparator();
    addEngineMenu(*menu.addMenu(tr("Projection &engine")), card);
    menu.addSeparator();
    QAction *full = add(tr("&Full screen"), "fullScreenAction", QKeySequence("F11"), [&window] {
        window.setWindowState(window.windowState() ^ Qt::WindowFullScreen);
    });
    full->setCheckable(true);
}

QAction *ViewMenu::add(const QString &text, const char *name, const QKeySequence &key,
                       const std::function<void()> &run) {
    return addCommand(m_menu, text, name, key, this, run);
}

void ViewMenu::addStandardViews() {
    using scene::StandardView;
    const struct {
        QString text;
        const char *name;
        StandardView view;
        const char *hint;
    } views[] = {
        {tr("&Anterior"), "frontViewAction", StandardView::front, QT_TR_NOOP("Keypad 1")},
        {tr("&Posterior"), "backViewAction", StandardView::back, QT_TR_NOOP("Shift+Keypad 1")},
        {tr("&Left"), "leftViewAction", StandardView::left, QT_TR_NOOP("Keypad 3")},
        {tr("&Right"), "rightViewAction", StandardView::right, QT_TR_NOOP("Shift+Keypad 3")},
        {tr("&Superior"), "topViewAction", StandardView::top, QT_TR_NOOP("Keypad 7")},
        {tr("&Inferior"), "bottomViewAction", StandardView::bottom, QT_TR_NOOP("Shift+Keypad 7")}};
    for (const auto &v : views)
        m_views << add(v.text + "\t" + tr(v.hint), v.name, {},
                       [this, view = v.view] { m_viewer.projection->showStandardView(view); });
    m_views << add(tr("C-arm an&gles..."), "anglesAction", QKeySequence("J"),
                   [this] { emit anglesRequested(); });
    add(tr("R&eset views") + "\t" + tr("Keypad 0"), "resetViewsAction", {}, [this] {
        m_viewer.projection->resetView();
        for (MprView *view : m_viewer.planes)
            view->resetView();
        if (!m_viewer.document.cut().axes.areStandard())
            m_viewer.document.undoStack()->push(
                new EditPlaneAxes(m_viewer.document, {}, tr("Reset views")));
        m_viewer.document.centerCrosshair();
    });
}

void ViewMenu::addOverlays() {
    m_menu.addSeparator();
    const auto addOne = [&](const QString &text, const char *name, const QKeySequence &key,
                            const std::function<void()> &run) {
        QAction *action = add(text, name, key, run);
        action->setCheckable(true);
        action->setChecked(true);
        return action;
    };
    m_texts = addOne(tr("A&nnotations"), "annotationsAction", QKeySequence("H"),
                     [this] { showOverlays(); });
    m_crosshair = addOne(tr("Cross&hair"), "crosshairAction", QKeySequence("Shift+H"),
                         [this] { showOverlays(); });
    m_banner = addOne(tr("Patient &banner"), "bannerAction", QKeySequence("Shift+B"), [this] {
        QSettings().setValue(bannerKey, m_banner->isChecked());
        emit bannerToggled(m_banner->isChecked());
    });
    m_banner->setChecked(QSettings().value(bannerKey, true).toBool());
    m_menu.addSeparator();
}

bool ViewMenu::showsBanner() const {
    return m_banner->isChecked();
}

void ViewMenu::showOverlays() {
    emit overlaysChanged({m_texts->isChecked(), m_crosshair->isChecked()});
}

// Nobody draws a measurement that cannot be seen afterwards.
void ViewMenu::showAnnotations() {
    if (m_texts->isChecked())
        return;
    m_texts->setChecked(true);
    showOverlays();
}

void ViewMenu::addBeside() {
    m_link = add(tr("Lin&k the studies"), "linkStudiesAction", QKeySequence("Shift+Y"),
                 [this] { emit linkRequested(); });
    m_link->setCheckable(true);
    m_closeBeside = add(tr("Close the study besi&de"), "closeBesideAction",
                        QKeySequence("Ctrl+Shift+W"), [this] { emit closeBesideRequested(); });
    setBeside(false);
}

void ViewMenu::addLayouts() {
    const auto addOne = [&](const QString &text, const char *name, PaneLayout which) {
        QAction *action =
            add(text, name, {}, [this, which] { m_viewer.area->setPaneLayout(which); });
        action->setCheckable(true);
        action->setActionGroup(m_layouts);
        return action;
    };
    addOne(tr("1 + 3"), "onePlusThreeAction", PaneLayout::onePlusThree)->setChecked(true);
    addOne(tr("2 x 2"), "twoByTwoAction", PaneLayout::twoByTwo);
}

QList<QAction *> ViewMenu::layouts() const {
    return m_layouts->actions();
}

void ViewMenu::addPane(QAction &toggle, const QString &text, const char *name,
                       const QKeySequence &key) {
    toggle.setText(text);
    toggle.setObjectName(name);
    toggle.setShortcut(key);
    m_menu.insertAction(m_afterPanes, &toggle);
}

void ViewMenu::setBeside(bool isThere) {
    m_link->setEnabled(isThere);
    m_link->setChecked(isThere);
    m_closeBeside->setEnabled(isThere);
}

void ViewMenu::setLinked(bool isLinked) {
    m_link->setChecked(isLinked);
}

} // namespace pellucid::ui
