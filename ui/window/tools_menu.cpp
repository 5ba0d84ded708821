// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/tools_menu.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include <QActionGroup>
#include <QInputDialog>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>

#include "ui/document/add_command.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/document/region_commands.h"
#include "ui/language/shown_text.h"
#include "ui/opening/phases.h"
#include "ui/views/cine.h"
#include "ui/views/mpr_view.h"
#include "ui/views/projection_view.h"

namespace pellucid::ui {

namespace {

using classify::StepKind;

// Off, and the usual thicknesses for chest, vessels and joints.
constexpr double thicknessesMm[] = {0.0, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0};
constexpr double maxThicknessMm = 500.0;

} // namespace

ToolsMenu::ToolsMenu(QMenu &menu, Document &document, const std::array<MprView *, 3> &planes,
                     ProjectionView &projection, Phases &phases)
    : QObject(&menu), m_document(document), m_planes(planes), m_projection(projection),
      m_cine(new Cine(planes, projection, this)), m_tools(new QActionGroup(this)),
      m_thicknesses(new QActionGroup(this)), m_modes(new QActionGroup(this)),
      m_interpolations(new QActionGroup(this)) {
    addTools(menu);
    addRegion(menu);
    menu.addSeparator();
    addSlab(menu);
    addInterpolation(menu);
    m_wholeVolume = addCommand(menu, tr("S&how the whole volume"), "wholeVolumeAction",
                               QKeySequence("Shift+K"), this, [this] {
                                   editScene(m_document, tr("Whole volume"), noDrag,
                                             [](scene::Scene &scene) { scene.crop = {}; });
                               });
    m_straighten = addCommand(menu, tr("S&traighten the planes"), "straightenAction",
                              QKeySequence("Shift+C"), this, [this] {
                                  m_document.undoStack()->push(new EditPlaneAxes(
                                      m_document, {}, tr("Straighten the planes")));
                              });
    m_alongScan =
        addCommand(menu, tr("A&lign the planes with the scan"), "alongScanAction",
                   QKeySequence("Shift+P"), this, [this] {
                       m_document.undoStack()->push(new EditPlaneAxes(
                           m_document, mpr::PlaneAxes::along(m_document.volume()->lattice()),
                           tr("Align the planes with the scan")));
                   });
    menu.addSeparator();
    addCine(menu);
    addPhases(menu, phases);
    document.whenever(Change::scene | Change::cut, this, [this](Changes changes) {
        if (changes & Change::volume)
            m_cine->stop();
        showCut();
    });
    showCut();
}

void ToolsMenu::addTools(QMenu &menu) {
    const struct {
        QString text, hint;
        const char *name;
        Tool tool;
        const char *key;
    } tools[] = {
        {tr("Window"), tr("drag for width and center"), "windowToolAction", Tool::window, "W"},
        {tr("Pan"), tr("drag the picture"), "panToolAction", Tool::pan, "P"},
        {tr("Zoom"), tr("drag up and down"), "zoomToolAction", Tool::zoom, "Z"},
        {tr("Crosshair"), tr("drag the crosshair; its dots turn the planes"), "crosshairToolAction",
         Tool::crosshair, "C"},
        {tr("Distance"), tr("drag a line, also in the projection"), "distanceToolAction",
         Tool::distance, "M"},
        {tr("Polyline"), tr("click its corners; a double-click ends it"), "polylineToolAction",
         Tool::polyline, "Shift+M"},
        {tr("Angle"), tr("drag one leg, click the end of the other"), "angleToolAction",
         Tool::angle, "A"},
        {tr("Cobb angle"), tr("drag a line along each of two end plates"), "cobbToolAction",
         Tool::cobbAngle, "Shift+A"},
        {tr("Ellipse"), tr("drag its bounding box"), "ellipseToolAction", Tool::ellipse, "E"},
        {tr("Rectangle"), tr("drag from corner to corner"), "rectangleToolAction", Tool::rectangle,
         "B"},
        {tr("Arrow"), tr("drag from what it shows to where its text is"), "arrowToolAction",
         Tool::arrow, "Y"},
        {tr("Text"), tr("click where it begins; a double-click changes it"), "textToolAction",
         Tool::text, "Shift+T"},
        {tr("Crop"), tr("drag the sides of the box in the planes"), "cropToolAction", Tool::crop,
         "K"},
        {tr("Connected"), tr("click connected tissue of similar values, also in the projection"),
         "connectedToolAction", Tool::connected, "G"},
        {tr("Paint"), tr("paint a region with a brush; Shift erases"), "paintToolAction",
         Tool::paint, "T"},
        {tr("Scissors"), tr("draw around the part to cut along the line of sight"),
         "scissorsToolAction", Tool::scissors, "X"}};
    for (const auto &t : tools) {
        QAction *action = addCommand(menu, t.text, t.name, QKeySequence(t.key), this,
                                     [this, tool = t.tool] { chooseTool(tool); });
        action->setToolTip(plainToolTip(tr("%1: %2").arg(t.text, t.hint)));
        action->setCheckable(true);
        action->setActionGroup(m_tools);
    }
    m_tools->actions().first()->setChecked(true);
}

void ToolsMenu::addToolsTo(QMenu &menu) const {
    menu.addActions(m_tools->actions());
}

void ToolsMenu::chooseTool(Tool tool) {
    for (MprView *plane : m_planes)
        plane->setTool(tool);
    m_projection.setTool(tool);
    m_document.marking().setTool(regionToolOf(tool));
    m_tool = tool;
    emit toolChosen(tool);
}

void ToolsMenu::addRegion(QMenu &menu) {
    QMenu *region = menu.addMenu(tr("&Region"));
    region->setObjectName("regionMenu");
    const auto askForMm = [this](const QString &title, const QString &label, StepKind kind) {
        const classify::StepParameter &mm = classify::describe(kind).parameters.front();
        bool isGiven = false;
        const double value =
            QInputDialog::getDouble(m_planes.front()->window(), title, label, mm.defaultValue,
                                    mm.minimum, mm.maximum, 1, &isGiven);
        if (isGiven)
            useStep(m_document, {kind, {{mm.name, value}}}, title);
    };
    const auto add = [&](const QString &text, const char *name, const auto &run) {
        m_regionActions << addCommand(*region, text, name, {}, this, run);
    };
    add(tr("&Grow..."), "growRegionAction",
        [askForMm] { askForMm(tr("Grow"), tr("Grow the class by, mm"), StepKind::grow); });
    add(tr("&Shrink..."), "shrinkRegionAction",
        [askForMm] { askForMm(tr("Shrink"), tr("Shrink the class by, mm"), StepKind::shrink); });
    add(tr("&Fill holes"), "fillRegionAction",
        [this] { useStep(m_document, {StepKind::fill}, tr("Fill holes")); });
    add(tr("&Largest part"), "largestRegionAction",
        [this] { useStep(m_document, {StepKind::largestComponent}, tr("Largest part")); });
    region->addSeparator();
    m_classVolumes =
        addCommand(*region, tr("Class &volumes..."), "classVolumesAction", QKeySequence("Shift+V"),
                   this, [this] { emit classVolumesRequested(); });
    region->addSeparator();
    m_removeBone = addCommand(*region, tr("Remove connected &bone"), "removeBoneAction", {}, this,
                              [this] { removeBone(); });
    RegionMarking &marking = m_document.marking();
    connect(&marking, &RegionMarking::toolRequested, this, [this](RegionTool wanted) {
        const auto tools = m_tools->actions();
        for (qsizetype n = 0; n < tools.size(); ++n)
            if (regionToolOf(Tool(n)) == wanted) {
                tools[n]->setChecked(true);
                chooseTool(Tool(n));
            }
    });
    m_document.whenever(Change::scene, this, &ToolsMenu::showRegion);
    showRegion();
}

void ToolsMenu::showRegion() {
    for (QAction *action : m_regionActions)
        action->setEnabled(m_document.volume() && m_document.selectedClass() >= 0);
    m_removeBone->setEnabled(m_document.volume() && !m_document.isPreview());
    m_classVolumes->setEnabled(m_removeBone->isEnabled() &&
                               !m_document.scene().look.classes.empty());
}

// The next click names the bone.
void ToolsMenu::removeBone() {
    RegionOptions options = m_document.marking().options();
    options.use = classify::RegionUse::remove;
    options.addsPoints = false;
    options.ofEveryClass = true;
    options.isBone = true;
    m_document.marking().setOptions(options);
    m_document.marking().requestTool(RegionTool::connected);
}

void ToolsMenu::addSlab(QMenu &menu) {
    m_slabMenu = menu.addMenu(tr("&Slab"));
    m_slabMenu->setObjectName("slabMenu");
    m_slab = addCommand(*m_slabMenu, tr("&Slab"), "slabAction", QKeySequence("S"), this,
                        [this] { toggleSlab(); });
    m_slab->setCheckable(true);
    m_slab->setToolTip(tr("Slab: give the planes a thickness; [ and ] change it"));
    m_slabMenu->addSeparator();
    const struct {
        QString text;
        const char *name;
        mpr::SlabMode mode;
    } modes[] = {{tr("&Mean"), "meanSlabAction", mpr::SlabMode::mean},
                 {tr("M&aximum (MIP)"), "maximumSlabAction", mpr::SlabMode::maximum},
                 {tr("M&inimum (MinIP)"), "minimumSlabAction", mpr::SlabMode::minimum}};
    for (const auto &m : modes) {
        QAction *action = addCommand(*m_slabMenu, m.text, m.name, {}, this, [this, mode = m.mode] {
            const double now = m_document.cut().options.slab.thicknessMm;
            setSlab({now > 0.0 ? now : m_lastThicknessMm, mode});
        });
        action->setCheckable(true);
        action->setActionGroup(m_modes);
        action->setData(int(m.mode));
    }
    m_slabMenu->addSeparator();
    for (const double mm : thicknessesMm) {
        if (mm == 0.0)
            continue;
        QAction *action =
            addCommand(*m_slabMenu, tr("%1 mm").arg(mm),
                       qPrintable(QString("slab%1Action").arg(mm)), {}, this, [this, mm] {
                           setSlab({mm, m_document.cut().options.slab.mode});
                       });
        action->setCheckable(true);
        action->setActionGroup(m_thicknesses);
        action->setData(mm);
    }
    addCommand(*m_slabMenu, tr("&Other thickness..."), "otherSlabAction", {}, this,
               [this] { askForThickness(); });
    addCommand(*m_slabMenu, tr("T&hicker"), "thickerAction", QKeySequence("]"), this,
               [this] { changeThickness(1); });
    addCommand(*m_slabMenu, tr("Thi&nner"), "thinnerAction", QKeySequence("["), this,
               [this] { changeThickness(-1); });
}

void ToolsMenu::setSlab(const mpr::Slab &slab) {
    if (slab.thicknessMm > 0.0)
        m_lastThicknessMm = slab.thicknessMm;
    Cut cut = m_document.cut();
    cut.options.slab = slab;
    m_document.setCut(cut);
    showCut(); // a click on a checked entry would uncheck it
}

void ToolsMenu::toggleSlab() {
    const mpr::Slab &slab = m_document.cut().options.slab;
    setSlab({slab.thicknessMm > 0.0 ? 0.0 : m_lastThicknessMm, slab.mode});
}

void ToolsMenu::changeThickness(int steps) {
    const mpr::Slab &slab = m_document.cut().options.slab;
    const auto *const first = std::begin(thicknessesMm), *const end = std::end(thicknessesMm);
    const auto *at = steps > 0 ? std::upper_bound(first, end, slab.thicknessMm)
                               : std::lower_bound(first, end, slab.thicknessMm);
    if (steps > 0 && at == end)
        return;
    if (steps < 0 && at-- == first)
        return;
    setSlab({*at, slab.mode});
}

void ToolsMenu::askForThickness() {
    bool isGiven = false;
    const double mm = QInputDialog::getDouble(
        m_planes.front()->window(), tr("Slab"), tr("Slab thickness, mm"),
        m_document.cut().options.slab.thicknessMm, 0.0, maxThicknessMm, 1, &isGiven);
    if (isGiven)
        setSlab({mm, m_document.cut().options.slab.mode});
}

void ToolsMenu::addInterpolation(QMenu &menu) {
    QMenu *submenu = menu.addMenu(tr("&Interpolation"));
    const struct {
        QString text;
        const char *name;
        mpr::Interpolation which;
    } ways[] = {{tr("&Linear"), "linearPlanesAction", mpr::Interpolation::linear},
                {tr("&Nearest sample"), "nearestPlanesAction", mpr::Interpolation::nearest}};
    for (const auto &w : ways) {
        QAction *action = addCommand(*submenu, w.text, w.name, {}, this, [this, which = w.which] {
            Cut cut = m_document.cut();
            cut.options.interpolation = which;
            m_document.setCut(cut);
        });
        action->setCheckable(true);
        action->setActionGroup(m_interpolations);
        action->setData(int(w.which));
    }
}

void ToolsMenu::addCine(QMenu &menu) {
    QAction *play = addCommand(menu, tr("Pla&y"), "playAction", QKeySequence(Qt::Key_Space), this,
                               [this] { m_cine->toggle(); });
    play->setCheckable(true);
    play->setToolTip(tr("Play the slices of the plane, or turn the projection around the patient"));
    // Elsewhere, Space activates the focused control.
    play->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    m_projection.addAction(play);
    for (MprView *plane : m_planes)
        plane->addAction(play);
    connect(m_cine, &Cine::playingChanged, play, &QAction::setChecked);
    QMenu *rates = menu.addMenu(tr("S&peed"));
    auto *group = new QActionGroup(this);
    for (const int rate : {5, 10, 15, 25, 40}) {
        QAction *action = addCommand(*rates, tr("%1 frames per second").arg(rate),
                                     qPrintable(QString("rate%1Action").arg(rate)), {}, this,
                                     [this, rate] { m_cine->setFramesPerSecond(rate); });
        action->setCheckable(true);
        action->setActionGroup(group);
        action->setChecked(rate == 15);
    }
}

void ToolsMenu::addPhases(QMenu &menu, Phases &phases) {
    const struct {
        QString text;
        const char *name, *key;
        std::function<void()> run;
    } commands[] = {
        {tr("&Next phase"), "nextPhaseAction", ".", [&phases] { phases.step(1); }},
        {tr("P&revious phase"), "previousPhaseAction", ",", [&phases] { phases.step(-1); }},
        {tr("Play p&hases"), "playPhasesAction", "Shift+Space",
         [&phases] { phases.togglePlaying(); }}};
    QList<QAction *> actions;
    for (const auto &c : commands)
        actions << addCommand(menu, c.text, c.name, QKeySequence(c.key), this, c.run);
    actions.back()->setCheckable(true);
    const auto show = [actions, &phases] {
        for (QAction *action : actions)
            action->setEnabled(phases.count() > 1);
        actions.back()->setChecked(phases.isPlaying());
    };
    connect(&phases, &Phases::changed, this, show);
    show();
}

void ToolsMenu::addTo(QToolBar &bar) {
    const auto addButton = [&](const char *name, QAction *action, QMenu *menu) {
        auto *button = new QToolButton;
        button->setObjectName(name);
        button->setDefaultAction(action);
        button->setMenu(menu);
        button->setPopupMode(QToolButton::MenuButtonPopup);
        button->setToolButtonStyle(bar.toolButtonStyle());
        bar.addWidget(button);
        return button;
    };
    // Similar tools share a button, which shows the one that was chosen last.
    const struct {
        const char *name;
        std::vector<Tool> tools;
    } groups[] = {{"lengthButton", {Tool::distance, Tool::polyline}},
                  {"angleButton", {Tool::angle, Tool::cobbAngle}},
                  {"valuesButton", {Tool::ellipse, Tool::rectangle}},
                  {"annotationButton", {Tool::arrow, Tool::text}}};
    const QList<QAction *> tools = m_tools->actions();
    for (qsizetype n = 0; n < tools.size(); ++n) {
        if (Tool(n) == Tool::distance) {
            addButton("slabButton", m_slab, m_slabMenu);
            bar.addSeparator();
        }
        const auto *const group =
            std::find_if(std::begin(groups), std::end(groups), [&](const auto &candidate) {
                return std::find(candidate.tools.begin(), candidate.tools.end(), Tool(n)) !=
                       candidate.tools.end();
            });
        if (group == std::end(groups)) {
            bar.addAction(tools[n]);
            continue;
        }
        if (group->tools.front() != Tool(n))
            continue;
        auto *menu = new QMenu(&bar);
        QToolButton *const button = addButton(group->name, tools[n], menu);
        for (const Tool tool : group->tools) {
            QAction *const action = tools[qsizetype(tool)];
            menu->addAction(action);
            connect(action, &QAction::toggled, button, [button, action](bool isChosen) {
                if (isChosen)
                    button->setDefaultAction(action);
            });
        }
    }
}

void ToolsMenu::showCut() {
    const Cut &cut = m_document.cut();
    const mpr::Slab &slab = cut.options.slab;
    m_slab->setChecked(slab.thicknessMm > 0.0);
    for (QAction *action : m_modes->actions())
        action->setChecked(action->data().toInt() == int(slab.mode));
    m_thicknesses->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
    for (QAction *action : m_thicknesses->actions())
        action->setChecked(action->data().toDouble() == slab.thicknessMm);
    for (QAction *action : m_interpolations->actions())
        action->setChecked(action->data().toInt() == int(cut.options.interpolation));
    m_straighten->setEnabled(!cut.axes.areStandard());
    m_alongScan->setEnabled(m_document.volume() && m_document.volume()->notes().placed &&
                            !(cut.axes == mpr::PlaneAxes::along(m_document.volume()->lattice())));
    m_wholeVolume->setEnabled(!m_document.scene().crop.isWhole());
}

} // namespace pellucid::ui
