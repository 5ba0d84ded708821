// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/look_menu.h"

#include <QActionGroup>
#include <QMenu>

#include "core/classify/couch.h"
#include "ui/document/add_command.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/document/region_commands.h"
#include "ui/panels/presets_panel.h"
#include "ui/panels/shading_panel.h"
#include "ui/views/projection_view.h"
#include "ui/window/look_docks.h"

namespace pellucid::ui {

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
        projection.retakeExposure();
    });
    m_couch = add(menu, tr("Remove the c&ouch"), "removeCouchAction", {}, [this] {
        setWithoutCouch(m_document, !classify::isWithoutCouch(m_document.scene().look));
    });
    m_couch->setCheckable(true);
    m_windowMenu = menu.addMenu(tr("&Window presets"));
    m_windowMenu->setObjectName("windowMenu");
    m_document.whenever(Change::scene, this, &LookMenu::showScene);
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
    m_couch->setChecked(classify::isWithoutCouch(scene.look));
    // The body is found by HU.
    m_couch->setEnabled(m_document.volume() &&
                        m_document.volume()->unit() == volume::ValueUnit::hounsfield);
    for (QAction *action : m_shadingActions)
        action->setEnabled(m_document.volume().has_value());
}

} // namespace pellucid::ui
