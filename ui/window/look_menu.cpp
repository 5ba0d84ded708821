// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/look_menu.h"

#include <algorithm>

#include <QActionGroup>
#include <QMenu>

#include "ui/document/add_command.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/panels/presets_panel.h"
#include "ui/panels/shading_panel.h"
#include "ui/views/projection_view.h"
#include "ui/window/look_docks.h"

namespace pellucid::ui {

namespace {

using classify::Step;
using classify::StepKind;
using classify::TissueClass;

// A segment is what it is, with or without the couch.
bool isOfTheVolume(const TissueClass &tissue) {
    return tissue.segment.empty();
}

bool isOfTheBody(const TissueClass &tissue) {
    return std::any_of(tissue.steps.begin(), tissue.steps.end(),
                       [](const Step &step) { return step.kind == StepKind::body; });
}

// What stands for the whole volume once only the patient is to be shown.
TissueClass patientClass(const classify::TransferFunction &curve,
                         const classify::FieldWindow &window) {
    constexpr double highest = 32767.0; // of 16 bits
    TissueClass patient{"Patient", window.low, std::max(highest, window.high), 0.0, 1.0, {}};
    if (!(curve == classify::TransferFunction()))
        patient.transferFunction = curve;
    patient.steps = {{StepKind::body, {}}};
    return patient;
}

bool isWithoutCouch(const classify::Look &look) {
    return std::any_of(look.classes.begin(), look.classes.end(), isOfTheVolume) &&
           std::all_of(look.classes.begin(), look.classes.end(), [](const TissueClass &tissue) {
               return !isOfTheVolume(tissue) || isOfTheBody(tissue);
           });
}

void removeCouch(classify::Look &look, const classify::FieldWindow &window) {
    if (look.classes.empty())
        look.classes.push_back(patientClass(look.transferFunction, window));
    for (TissueClass &tissue : look.classes) {
        if (!isOfTheVolume(tissue) || isOfTheBody(tissue) ||
            tissue.steps.size() >= classify::maxSteps)
            continue;
        // First of the steps that restrict the region: the others are to find only the patient.
        const auto at =
            std::find_if(tissue.steps.begin(), tissue.steps.end(), [](const Step &step) {
                return classify::describe(step.kind).effect == classify::StepEffect::region;
            });
        tissue.steps.insert(at, {StepKind::body, {}});
    }
}

void restoreCouch(classify::Look &look, const classify::FieldWindow &window) {
    if (look.classes == std::vector{patientClass(look.transferFunction, window)}) {
        look.classes.clear();
        return;
    }
    for (TissueClass &tissue : look.classes)
        std::erase_if(tissue.steps, [](const Step &step) { return step.kind == StepKind::body; });
}

} // namespace

LookMenu::LookMenu(QMenu &menu, Document &document, LookDocks &docks, ProjectionView &projection)
    : QObject(&menu), m_document(document), m_reconstructions(new QActionGroup(this)) {
    PresetsPanel &presets = docks.presets();
    add(menu, tr("&Save look..."), "saveLookAction", QKeySequence::Save, [&docks, &presets] {
        docks.unfold(presets);
        presets.askForName();
    });
    add(menu, tr("&Import preset..."), "importPresetAction", {},
        [&presets] { presets.importPreset(); });
    add(menu, tr("&Export preset..."), "exportPresetAction", {},
        [&presets] { presets.exportPreset(); });
    menu.addSeparator();
    addShading(menu, docks);
    menu.addSeparator();
    addReconstructions(menu);
    m_film = add(menu, tr("&Film (inverted)"), "filmAction", QKeySequence("I"), [this] {
        editScene(m_document, tr("Film"), noDrag,
                  [](scene::Scene &scene) { scene.tone.inverted = !scene.tone.inverted; });
    });
    m_film->setCheckable(true);
    add(menu, tr("&Automatic brightness"), "automaticToneAction", {}, [this, &projection] {
        editScene(m_document, tr("Automatic brightness"), noDrag, [](scene::Scene &scene) {
            scene.tone.low.reset();
            scene.tone.high.reset();
        });
        projection.retakeTone();
    });
    m_couch = add(menu, tr("Remove the c&ouch"), "removeCouchAction", {}, [this] {
        const bool isRemoved = isWithoutCouch(m_document.scene().look);
        editScene(m_document, isRemoved ? tr("Show the couch") : tr("Remove the couch"), noDrag,
                  [&](scene::Scene &scene) {
                      (isRemoved ? restoreCouch : removeCouch)(scene.look,
                                                               m_document.fieldWindow());
                  });
    });
    m_couch->setCheckable(true);
    m_windowMenu = menu.addMenu(tr("&Window presets"));
    m_windowMenu->setObjectName("windowMenu");
    connect(&m_document, &Document::sceneChanged, this, &LookMenu::showScene);
    connect(&m_document, &Document::volumeChanged, this, &LookMenu::showScene);
    showScene();
}

QAction *LookMenu::add(QMenu &menu, const QString &text, const char *name, const QKeySequence &key,
                       const std::function<void()> &run) {
    return addCommand(menu, text, name, key, this, run);
}

void LookMenu::addShading(QMenu &menu, LookDocks &docks) {
    ShadingPanel &shading = docks.shading();
    m_cue = add(menu, tr("&Depth cue"), "depthCueAction", QKeySequence("D"),
                [&shading] { shading.toggleCue(); });
    m_cue->setCheckable(true);
    QAction *light =
        add(menu, tr("Add l&ight"), "addLightAction", QKeySequence("L"), [&docks, &shading] {
            docks.unfold(shading);
            shading.addLight();
        });
    QAction *none = add(menu, tr("Reset s&hading"), "resetShadingAction", QKeySequence("Shift+L"),
                        [&shading] { shading.reset(); });
    m_shadingActions = {m_cue, light, none};
}

void LookMenu::addReconstructions(QMenu &menu) {
    QMenu *submenu = menu.addMenu(tr("&Reconstruction"));
    using scene::Reconstruction;
    const auto addOne = [&](const QString &text, const char *name, Reconstruction which) {
        QAction *action = add(*submenu, text, name, {}, [this, which] {
            editScene(m_document, tr("Reconstruction"), noDrag,
                      [&](scene::Scene &scene) { scene.image.reconstruction = which; });
        });
        action->setCheckable(true);
        action->setActionGroup(m_reconstructions);
        action->setData(int(which));
    };
    addOne(tr("&Cubic"), "cubicAction", Reconstruction::cubic);
    addOne(tr("&Linear"), "linearAction", Reconstruction::linear);
    addOne(tr("S&pline"), "splineAction", Reconstruction::spline);
    addOne(tr("&Sharp (band-limited)"), "bandLimitedAction", Reconstruction::bandLimited);
}

void LookMenu::showScene() {
    const scene::Scene &scene = m_document.scene();
    for (QAction *action : m_reconstructions->actions())
        action->setChecked(action->data().toInt() == int(scene.image.reconstruction));
    m_film->setChecked(scene.tone.inverted);
    m_cue->setChecked(scene.shading.cue.isActive());
    m_couch->setChecked(isWithoutCouch(scene.look));
    // The body is found by HU.
    m_couch->setEnabled(m_document.volume() &&
                        m_document.volume()->unit() == volume::ValueUnit::hounsfield);
    for (QAction *action : m_shadingActions)
        action->setEnabled(m_document.volume().has_value());
}

} // namespace pellucid::ui
