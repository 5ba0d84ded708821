// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>
#include <memory>

#include <QCoreApplication>
#include <QInputDialog>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>

#include "ui/beside/study_pair.h"
#include "ui/document/commands.h"
#include "ui/document/region_commands.h"
#include "ui/views/cine.h"
#include "ui/window/actions/commands.h"
#include "ui/window/main_window.h"

namespace pellucid::ui {

namespace {

using classify::StepKind;

struct ToolCommands {
    Q_DECLARE_TR_FUNCTIONS(ToolCommands)
};

// Off, and the usual thicknesses for chest, vessels and joints.
constexpr double thicknessesMm[] = {0.0, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0};
constexpr double maxThicknessMm = 500.0;
constexpr int framesPerSecond[] = {5, 10, 15, 25, 40};

// A mouse tool. Those that share a button of the tool bar name it.
struct ToolRow {
    Tool tool;
    const char *id, *key, *icon;
    const char *text, *hint;
    const char *button = "";
};
constexpr ToolRow toolRows[] = {
    {Tool::window, "windowToolAction", "W", "window", QT_TRANSLATE_NOOP("ToolCommands", "Window"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag for width and center")},
    {Tool::pan, "panToolAction", "P", "pan", QT_TRANSLATE_NOOP("ToolCommands", "Pan"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag the picture")},
    {Tool::zoom, "zoomToolAction", "Z", "zoom", QT_TRANSLATE_NOOP("ToolCommands", "Zoom"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag up and down")},
    {Tool::crosshair, "crosshairToolAction", "C", "crosshair",
     QT_TRANSLATE_NOOP("ToolCommands", "Crosshair"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag the crosshair; its dots turn the planes")},
    {Tool::distance, "distanceToolAction", "M", "distance",
     QT_TRANSLATE_NOOP("ToolCommands", "Distance"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag a line, also in the projection"), "lengthButton"},
    {Tool::polyline, "polylineToolAction", "Shift+M", "polyline",
     QT_TRANSLATE_NOOP("ToolCommands", "Polyline"),
     QT_TRANSLATE_NOOP("ToolCommands", "click its corners; a double-click ends it"),
     "lengthButton"},
    {Tool::angle, "angleToolAction", "A", "angle", QT_TRANSLATE_NOOP("ToolCommands", "Angle"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag one leg, click the end of the other"), "angleButton"},
    {Tool::cobbAngle, "cobbToolAction", "Shift+A", "cobb",
     QT_TRANSLATE_NOOP("ToolCommands", "Cobb angle"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag a line along each of two end plates"), "angleButton"},
    {Tool::ellipse, "ellipseToolAction", "E", "ellipse",
     QT_TRANSLATE_NOOP("ToolCommands", "Ellipse"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag its bounding box"), "valuesButton"},
    {Tool::rectangle, "rectangleToolAction", "B", "rectangle",
     QT_TRANSLATE_NOOP("ToolCommands", "Rectangle"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag from corner to corner"), "valuesButton"},
    {Tool::arrow, "arrowToolAction", "Y", "arrow", QT_TRANSLATE_NOOP("ToolCommands", "Arrow"),
     QT_TRANSLATE_NOOP("ToolCommands",
                       "drag from the structure it points to, to where the text goes"),
     "annotationButton"},
    {Tool::text, "textToolAction", "Shift+T", "text", QT_TRANSLATE_NOOP("ToolCommands", "Text"),
     QT_TRANSLATE_NOOP("ToolCommands", "click where it begins; a double-click changes it"),
     "annotationButton"},
    {Tool::crop, "cropToolAction", "K", "crop", QT_TRANSLATE_NOOP("ToolCommands", "Crop"),
     QT_TRANSLATE_NOOP("ToolCommands", "drag the sides of the box in the planes")},
    {Tool::connected, "connectedToolAction", "G", "connected",
     QT_TRANSLATE_NOOP("ToolCommands", "Connected"),
     QT_TRANSLATE_NOOP("ToolCommands",
                       "click connected tissue of similar values, also in the projection")},
    {Tool::paint, "paintToolAction", "T", "paint", QT_TRANSLATE_NOOP("ToolCommands", "Paint"),
     QT_TRANSLATE_NOOP("ToolCommands", "paint a region with a brush; Shift erases")},
    {Tool::scissors, "scissorsToolAction", "X", "scissors",
     QT_TRANSLATE_NOOP("ToolCommands", "Scissors"),
     QT_TRANSLATE_NOOP("ToolCommands", "draw around the part to cut along the line of sight")}};

QString slabId(double mm) {
    return QString("slab%1Action").arg(mm);
}
QString rateId(int rate) {
    return QString("rate%1Action").arg(rate);
}

// The thickness of the planes, and the one to return to.
class SlabChoice {
public:
    explicit SlabChoice(Document &document) : m_document(document) {}

    const mpr::Slab &slab() const { return m_document.cut().options.slab; }
    void set(const mpr::Slab &slab) {
        if (slab.thicknessMm > 0.0)
            m_lastMm = slab.thicknessMm;
        Cut cut = m_document.cut();
        cut.options.slab = slab;
        m_document.setCut(cut);
    }
    void toggle() { set({slab().thicknessMm > 0.0 ? 0.0 : m_lastMm, slab().mode}); }
    void setMode(mpr::SlabMode mode) {
        set({slab().thicknessMm > 0.0 ? slab().thicknessMm : m_lastMm, mode});
    }
    // Negative: thinner.
    void change(int steps) {
        const auto *const first = std::begin(thicknessesMm), *const end = std::end(thicknessesMm);
        const auto *at = steps > 0 ? std::upper_bound(first, end, slab().thicknessMm)
                                   : std::lower_bound(first, end, slab().thicknessMm);
        if ((steps > 0 && at == end) || (steps < 0 && at-- == first))
            return;
        set({*at, slab().mode});
    }
    void ask(QWidget &window) {
        bool isGiven = false;
        const double mm = QInputDialog::getDouble(
            &window, ToolCommands::tr("Slab"), ToolCommands::tr("Slab thickness, mm"),
            slab().thicknessMm, 0.0, maxThicknessMm, 1, &isGiven);
        if (isGiven)
            set({mm, slab().mode});
    }

private:
    Document &m_document;
    double m_lastMm = 10.0;
};

void addTools(const Scope &scope, std::vector<Command> &commands) {
    StudyPair &pair = scope.pair;
    for (const ToolRow &row : toolRows) {
        const QString text = ToolCommands::tr(row.text);
        commands.push_back({.id = row.id,
                            .text = text,
                            .key = row.key,
                            .icon = row.icon,
                            .run = [&pair, tool = row.tool] { pair.setTool(tool); },
                            .isChecked = [&pair, tool = row.tool] { return pair.tool() == tool; },
                            .tip = ToolCommands::tr("%1: %2").arg(text, ToolCommands::tr(row.hint)),
                            .group = "tool"});
    }
}

void addSlab(const Scope &scope, std::vector<Command> &commands) {
    MainWindow &window = scope.window;
    const auto choice = std::make_shared<SlabChoice>(scope.viewer.document);
    commands.push_back(
        {.id = "slabAction",
         .text = ToolCommands::tr("&Slab"),
         .key = "S",
         .icon = "slab",
         .run = [choice] { choice->toggle(); },
         .isChecked = [choice] { return choice->slab().thicknessMm > 0.0; },
         .tip = ToolCommands::tr("Slab: give the planes a thickness; [ and ] change it")});
    const auto addMode = [&](const char *id, const QString &text, mpr::SlabMode mode) {
        commands.push_back({.id = id,
                            .text = text,
                            .run = [choice, mode] { choice->setMode(mode); },
                            .isChecked = [choice, mode] { return choice->slab().mode == mode; },
                            .group = "slabMode"});
    };
    addMode("meanSlabAction", ToolCommands::tr("&Mean"), mpr::SlabMode::mean);
    addMode("maximumSlabAction", ToolCommands::tr("M&aximum (MIP)"), mpr::SlabMode::maximum);
    addMode("minimumSlabAction", ToolCommands::tr("M&inimum (MinIP)"), mpr::SlabMode::minimum);
    for (const double mm : thicknessesMm)
        if (mm > 0.0)
            commands.push_back(
                {.id = slabId(mm),
                 .text = ToolCommands::tr("%1 mm").arg(mm),
                 .run =
                     [choice, mm] {
                         choice->set({mm, choice->slab().mode});
                     },
                 .isChecked = [choice, mm] { return choice->slab().thicknessMm == mm; },
                 .group = "slabThickness"});
    commands.push_back({.id = "otherSlabAction",
                        .text = ToolCommands::tr("&Other thickness..."),
                        .run = [choice, &window] { choice->ask(window); }});
    commands.push_back(
        {.id = "thickerAction", .text = ToolCommands::tr("T&hicker"), .key = "]", .run = [choice] {
             choice->change(1);
         }});
    commands.push_back(
        {.id = "thinnerAction", .text = ToolCommands::tr("Thi&nner"), .key = "[", .run = [choice] {
             choice->change(-1);
         }});
}

void addPlanes(const Scope &scope, std::vector<Command> &commands) {
    Document &document = scope.viewer.document;
    const auto addWay = [&](const char *id, const QString &text, mpr::Interpolation which) {
        commands.push_back(
            {.id = id,
             .text = text,
             .run =
                 [&document, which] {
                     Cut cut = document.cut();
                     cut.options.interpolation = which;
                     document.setCut(cut);
                 },
             .isChecked = [&document,
                           which] { return document.cut().options.interpolation == which; },
             .group = "planeInterpolation"});
    };
    addWay("linearPlanesAction", ToolCommands::tr("&Linear"), mpr::Interpolation::linear);
    addWay("nearestPlanesAction", ToolCommands::tr("&Nearest sample"), mpr::Interpolation::nearest);
    const auto turn = [&document](const mpr::PlaneAxes &axes, const QString &text) {
        document.undoStack()->push(new EditPlaneAxes(document, axes, text));
    };
    commands.push_back({.id = "wholeVolumeAction",
                        .text = ToolCommands::tr("S&how the whole volume"),
                        .key = "Shift+K",
                        .run =
                            [&document] {
                                editScene(document, ToolCommands::tr("Whole volume"), noDrag,
                                          [](scene::Scene &scene) { scene.crop = {}; });
                            },
                        .isEnabled = [&document] { return !document.scene().crop.isWhole(); }});
    commands.push_back({.id = "straightenAction",
                        .text = ToolCommands::tr("S&traighten the planes"),
                        .key = "Shift+C",
                        .run = [turn] { turn({}, ToolCommands::tr("Straighten the planes")); },
                        .isEnabled = [&document] { return !document.cut().axes.areStandard(); }});
    commands.push_back({.id = "alongScanAction",
                        .text = ToolCommands::tr("A&lign the planes with the scan"),
                        .key = "Shift+P",
                        .run =
                            [turn, &document] {
                                turn(mpr::PlaneAxes::along(document.volume()->lattice()),
                                     ToolCommands::tr("Align the planes with the scan"));
                            },
                        .isEnabled =
                            [&document] {
                                return document.volume() && document.volume()->notes().placed &&
                                       !(document.cut().axes ==
                                         mpr::PlaneAxes::along(document.volume()->lattice()));
                            }});
}

// Asks by how many mm to grow or shrink the selected class.
void askForMm(MainWindow &window, Document &document, const QString &title, const QString &label,
              StepKind kind) {
    const classify::StepParameter &mm = classify::describe(kind).parameters.front();
    bool isGiven = false;
    const double value = QInputDialog::getDouble(&window, title, label, mm.defaultValue, mm.minimum,
                                                 mm.maximum, 1, &isGiven);
    if (isGiven)
        useStep(document, {kind, {{mm.name, value}}}, title);
}

// The next click names the bone.
void removeBone(RegionMarking &marking) {
    RegionOptions options = marking.options();
    options.use = classify::RegionUse::remove;
    options.addsPoints = false;
    options.ofEveryClass = true;
    options.isBone = true;
    marking.setOptions(options);
    marking.requestTool(RegionTool::connected);
}

void addRegions(const Scope &scope, std::vector<Command> &commands) {
    MainWindow &window = scope.window;
    Document &document = scope.viewer.document;
    const auto add = [&](const char *id, const QString &text, std::function<void()> run) {
        commands.push_back(
            {.id = id, .text = text, .run = std::move(run), .isEnabled = [&document] {
                 return document.volume() && document.selectedClass() >= 0;
             }});
    };
    add("growRegionAction", ToolCommands::tr("&Grow..."), [&] {
        askForMm(window, document, ToolCommands::tr("Grow"),
                 ToolCommands::tr("Grow the class by, mm"), StepKind::grow);
    });
    add("shrinkRegionAction", ToolCommands::tr("&Shrink..."), [&] {
        askForMm(window, document, ToolCommands::tr("Shrink"),
                 ToolCommands::tr("Shrink the class by, mm"), StepKind::shrink);
    });
    add("fillRegionAction", ToolCommands::tr("&Fill holes"),
        [&document] { useStep(document, {StepKind::fill}, ToolCommands::tr("Fill holes")); });
    add("largestRegionAction", ToolCommands::tr("&Largest part"), [&document] {
        useStep(document, {StepKind::largestComponent}, ToolCommands::tr("Largest part"));
    });
    const auto isWhole = [&document] { return document.volume() && !document.isPreview(); };
    commands.push_back(
        {.id = "classVolumesAction",
         .text = ToolCommands::tr("Class &volumes..."),
         .key = "Shift+V",
         .run = [&window] { window.showClassVolumes(); },
         .isEnabled = [&document,
                       isWhole] { return isWhole() && !document.scene().look.classes.empty(); }});
    commands.push_back({.id = "removeBoneAction",
                        .text = ToolCommands::tr("Remove connected &bone"),
                        .run = [&document] { removeBone(document.marking()); },
                        .isEnabled = isWhole});
}

void addMotion(const Scope &scope, std::vector<Command> &commands) {
    Cine &cine = scope.cine;
    Phases &phases = scope.bench.study.phases;
    commands.push_back(
        {.id = "playAction",
         .text = ToolCommands::tr("Pla&y"),
         .key = "Space",
         .icon = "play",
         .run = [&cine] { cine.toggle(); },
         .isChecked = [&cine] { return cine.isPlaying(); },
         .tip = ToolCommands::tr(
             "Play the slices of the plane, or turn the projection around the patient")});
    for (const int rate : framesPerSecond)
        commands.push_back({.id = rateId(rate),
                            .text = ToolCommands::tr("%1 frames per second").arg(rate),
                            .run = [&cine, rate] { cine.setFramesPerSecond(rate); },
                            .isChecked = [&cine, rate] { return cine.framesPerSecond() == rate; },
                            .group = "rate"});
    const auto hasPhases = [&phases] { return phases.count() > 1; };
    commands.push_back({.id = "nextPhaseAction",
                        .text = ToolCommands::tr("&Next phase"),
                        .key = ".",
                        .run = [&phases] { phases.step(1); },
                        .isEnabled = hasPhases});
    commands.push_back({.id = "previousPhaseAction",
                        .text = ToolCommands::tr("P&revious phase"),
                        .key = ",",
                        .run = [&phases] { phases.step(-1); },
                        .isEnabled = hasPhases});
    commands.push_back({.id = "playPhasesAction",
                        .text = ToolCommands::tr("Play p&hases"),
                        .key = "Shift+Space",
                        .run = [&phases] { phases.togglePlaying(); },
                        .isEnabled = hasPhases,
                        .isChecked = [&phases] { return phases.isPlaying(); }});
}

std::vector<MenuEntry> slabEntries() {
    const MenuEntry separator;
    std::vector<MenuEntry> entries{{"slabAction"},        separator,
                                   {"meanSlabAction"},    {"maximumSlabAction"},
                                   {"minimumSlabAction"}, separator};
    for (const double mm : thicknessesMm)
        if (mm > 0.0)
            entries.push_back({slabId(mm)});
    for (const char *const id : {"otherSlabAction", "thickerAction", "thinnerAction"})
        entries.push_back({id});
    return entries;
}

} // namespace

std::vector<Command> toolCommands(const Scope &scope) {
    std::vector<Command> commands;
    addTools(scope, commands);
    addRegions(scope, commands);
    addSlab(scope, commands);
    addPlanes(scope, commands);
    addMotion(scope, commands);
    return commands;
}

std::vector<MenuEntry> toolEntries() {
    std::vector<MenuEntry> entries;
    for (const ToolRow &row : toolRows)
        entries.push_back({row.id});
    return entries;
}

MenuEntry toolsMenu() {
    const MenuEntry separator;
    std::vector<MenuEntry> rates;
    for (const int rate : framesPerSecond)
        rates.push_back({rateId(rate)});
    std::vector<MenuEntry> entries = toolEntries();
    const std::vector<MenuEntry> rest{{"regionMenu",
                                       ToolCommands::tr("&Region"),
                                       {{"growRegionAction"},
                                        {"shrinkRegionAction"},
                                        {"fillRegionAction"},
                                        {"largestRegionAction"},
                                        separator,
                                        {"classVolumesAction"},
                                        separator,
                                        {"removeBoneAction"}}},
                                      separator,
                                      {"slabMenu", ToolCommands::tr("&Slab"), slabEntries()},
                                      {"",
                                       ToolCommands::tr("Plane &interpolation"),
                                       {{"linearPlanesAction"}, {"nearestPlanesAction"}}},
                                      {"wholeVolumeAction"},
                                      {"straightenAction"},
                                      {"alongScanAction"},
                                      separator,
                                      {"playAction"},
                                      {"", ToolCommands::tr("S&peed"), rates},
                                      {"nextPhaseAction"},
                                      {"previousPhaseAction"},
                                      {"playPhasesAction"}};
    entries.insert(entries.end(), rest.begin(), rest.end());
    return {"", ToolCommands::tr("&Tools"), entries};
}

void addToolButtons(QToolBar &bar, const ActionTable &actions) {
    const auto addButton = [&](const char *name, QAction *action, QMenu *menu) {
        auto *button = new QToolButton;
        button->setObjectName(name);
        button->setDefaultAction(action);
        button->setMenu(menu);
        button->setPopupMode(QToolButton::MenuButtonPopup);
        QObject::connect(&bar, &QToolBar::toolButtonStyleChanged, button,
                         &QToolButton::setToolButtonStyle);
        bar.addWidget(button);
        return button;
    };
    QHash<QString, QToolButton *> shared;
    for (const ToolRow &row : toolRows) {
        if (row.tool == Tool::distance) {
            addButton("slabButton", actions["slabAction"], actions.menu("slabMenu"));
            bar.addSeparator();
        }
        QAction *const action = actions[row.id];
        if (*row.button == '\0') {
            bar.addAction(action);
            continue;
        }
        QToolButton *&button = shared[row.button];
        if (button == nullptr)
            button = addButton(row.button, action, new QMenu(&bar));
        button->menu()->addAction(action);
        QObject::connect(action, &QAction::toggled, button,
                         [button = button, action](bool isChosen) {
                             if (isChosen)
                                 button->setDefaultAction(action);
                         });
    }
}

} // namespace pellucid::ui
