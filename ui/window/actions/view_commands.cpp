// SPDX-License-Identifier: GPL-3.0-or-later
#include <QCoreApplication>
#include <QSettings>

#include "ui/beside/study_pair.h"
#include "ui/document/commands.h"
#include "ui/views/mpr_view.h"
#include "ui/views/pane_area.h"
#include "ui/views/projection_view.h"
#include "ui/window/actions/commands.h"
#include "ui/window/main_window.h"

namespace pellucid::ui {

namespace {

struct ViewCommands {
    Q_DECLARE_TR_FUNCTIONS(ViewCommands)
};

constexpr auto freeRotationKey = "view/freeRotation";
constexpr auto bannerKey = "view/patientBanner";

Command standardView(const Scope &scope, const QString &id, const QString &text,
                     scene::StandardView view, const QString &fixedKey) {
    return {
        .id = id,
        .text = text,
        .run = [projection = scope.viewer.projection, view] { projection->showStandardView(view); },
        .fixedKey = fixedKey};
}

Command layout(const Scope &scope, const QString &id, const QString &text, const QString &icon,
               PaneLayout which) {
    PaneArea *const area = scope.viewer.area;
    return {.id = id,
            .text = text,
            .icon = icon,
            .run = [area, which] { area->setPaneLayout(which); },
            .isChecked = [area, which] { return area->paneLayout() == which; },
            .group = "layout"};
}

Command engine(const Scope &scope, const QString &id, const QString &text, EngineChoice choice) {
    GraphicsCard &card = scope.bench.card;
    return {.id = id,
            .text = text,
            .run = [&card, choice] { card.choose(choice); },
            .isChecked = [&card, choice] { return card.choice() == choice; },
            .group = "engine"};
}

void resetViews(const Viewer &viewer) {
    viewer.projection->resetView();
    for (MprView *view : viewer.planes)
        view->resetView();
    if (!viewer.document.cut().axes.areStandard())
        viewer.document.undoStack()->push(
            new EditPlaneAxes(viewer.document, {}, ViewCommands::tr("Reset views")));
    viewer.document.centerCrosshair();
}

} // namespace

void restoreView(ProjectionView &projection, StudyPair &pair) {
    projection.setTurnsFreely(QSettings().value(freeRotationKey).toBool());
    pair.setBannerShown(QSettings().value(bannerKey, true).toBool());
}

std::vector<Command> viewCommands(const Scope &scope) {
    using scene::StandardView;
    MainWindow &window = scope.window;
    const Viewer &viewer = scope.viewer;
    Document &document = viewer.document;
    ProjectionView *const projection = viewer.projection;
    StudyPair &pair = scope.pair;
    const auto isBeside = [&pair] { return pair.beside() != nullptr; };
    return {
        standardView(scope, "frontViewAction", ViewCommands::tr("&Anterior"), StandardView::front,
                     ViewCommands::tr("Keypad 1")),
        standardView(scope, "backViewAction", ViewCommands::tr("&Posterior"), StandardView::back,
                     ViewCommands::tr("Shift+Keypad 1")),
        standardView(scope, "leftViewAction", ViewCommands::tr("&Left"), StandardView::left,
                     ViewCommands::tr("Keypad 3")),
        standardView(scope, "rightViewAction", ViewCommands::tr("&Right"), StandardView::right,
                     ViewCommands::tr("Shift+Keypad 3")),
        standardView(scope, "topViewAction", ViewCommands::tr("&Superior"), StandardView::top,
                     ViewCommands::tr("Keypad 7")),
        standardView(scope, "bottomViewAction", ViewCommands::tr("&Inferior"), StandardView::bottom,
                     ViewCommands::tr("Shift+Keypad 7")),
        {.id = "anglesAction",
         .text = ViewCommands::tr("C-arm an&gles..."),
         .key = "J",
         .run = [&window] { window.showAngles(); }},
        {.id = "resetViewsAction",
         .text = ViewCommands::tr("R&eset views"),
         .run = [viewer] { resetViews(viewer); },
         .fixedKey = ViewCommands::tr("Keypad 0")},
        {.id = "orbitCrosshairAction",
         .text = ViewCommands::tr("&Orbit about the crosshair"),
         .key = "O",
         .run = [projection] { projection->setOrbitsCrosshair(!projection->orbitsCrosshair()); },
         .isChecked = [projection] { return projection->orbitsCrosshair(); }},
        {.id = "freeRotationAction",
         .text = ViewCommands::tr("&Free rotation (trackball)"),
         .run =
             [projection] {
                 projection->setTurnsFreely(!projection->turnsFreely());
                 QSettings().setValue(freeRotationKey, projection->turnsFreely());
             },
         .isChecked = [projection] { return projection->turnsFreely(); }},
        {.id = "tintSegmentsAction",
         .text = ViewCommands::tr("&Tint segments in the planes"),
         .run = [&document] { document.setTintsSegments(!document.tintsSegments()); },
         .isEnabled = [&document] { return document.segments() != nullptr; },
         .isChecked = [&document] { return document.tintsSegments(); }},
        {.id = "compareAction",
         .text = ViewCommands::tr("&Compare with previous look"),
         .run = [&window, projection] { window.compareLooks(!projection->isComparing()); },
         .isChecked = [projection] { return projection->isComparing(); },
         .fixedKey = ViewCommands::tr("hold Q")},
        {.id = "annotationsAction",
         .text = ViewCommands::tr("A&nnotations"),
         .key = "H",
         .run =
             [&pair] {
                 Overlays overlays = pair.overlays();
                 overlays.texts = !overlays.texts;
                 pair.setOverlays(overlays);
             },
         .isChecked = [&pair] { return pair.overlays().texts; }},
        {.id = "crosshairAction",
         .text = ViewCommands::tr("Cross&hair"),
         .key = "Shift+H",
         .run =
             [&pair] {
                 Overlays overlays = pair.overlays();
                 overlays.crosshair = !overlays.crosshair;
                 pair.setOverlays(overlays);
             },
         .isChecked = [&pair] { return pair.overlays().crosshair; }},
        {.id = "bannerAction",
         .text = ViewCommands::tr("Patient &banner"),
         .key = "Shift+B",
         .run =
             [&pair] {
                 pair.setBannerShown(!pair.showsBanner());
                 QSettings().setValue(bannerKey, pair.showsBanner());
             },
         .isChecked = [&pair] { return pair.showsBanner(); }},
        {.id = "linkStudiesAction",
         .text = ViewCommands::tr("Lin&k views"),
         .key = "Shift+Y",
         .icon = "link",
         .run = [&pair] { pair.toggleLink(); },
         .isEnabled = isBeside,
         .isChecked = [&pair] { return pair.isLinked(); }},
        {.id = "closeBesideAction",
         .text = ViewCommands::tr("Close secon&d study"),
         .key = "Ctrl+Shift+W",
         .run = [&pair] { pair.closeBeside(); },
         .isEnabled = isBeside},
        {.id = "prepareAgainAction",
         .text = ViewCommands::tr("Recompute pro&jection"),
         .key = "F5",
         .run = [&preparer = scope.bench.study.preparer] { preparer.prepareAgain(); }},
        layout(scope, "onePlusThreeAction", ViewCommands::tr("One large pane, three small"),
               "one-plus-three", PaneLayout::onePlusThree),
        layout(scope, "twoByTwoAction", ViewCommands::tr("Four equal panes"), "two-by-two",
               PaneLayout::twoByTwo),
        engine(scope, "automaticEngineAction", ViewCommands::tr("&Automatic"),
               EngineChoice::automatic),
        engine(scope, "processorEngineAction", ViewCommands::tr("&Processor"),
               EngineChoice::processor),
        engine(scope, "cardEngineAction", ViewCommands::tr("&Graphics card"), EngineChoice::card),
        {.id = "fullScreenAction",
         .text = ViewCommands::tr("&Full screen"),
         .key = "F11",
         .run = [&window] { window.setWindowState(window.windowState() ^ Qt::WindowFullScreen); },
         .isChecked = [&window] { return window.isFullScreen(); }},
    };
}

} // namespace pellucid::ui
