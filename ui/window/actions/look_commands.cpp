// SPDX-License-Identifier: GPL-3.0-or-later
#include <QCoreApplication>

#include "core/classify/couch.h"
#include "ui/document/commands.h"
#include "ui/document/region_commands.h"
#include "ui/panels/presets_panel.h"
#include "ui/panels/shading_panel.h"
#include "ui/views/projection_view.h"
#include "ui/window/actions/commands.h"
#include "ui/window/look_docks.h"
#include "ui/window/window_chooser.h"
#include "ui/window/workbench.h"

namespace pellucid::ui {

namespace {

struct LookCommands {
    Q_DECLARE_TR_FUNCTIONS(LookCommands)
};

Command reconstruction(Document &document, const QString &id, const QString &text,
                       scene::Reconstruction which) {
    return {
        .id = id,
        .text = text,
        .run =
            [&document, which] {
                editScene(document, LookCommands::tr("Projection interpolation"), noDrag,
                          [&](scene::Scene &scene) { scene.image.reconstruction = which; });
            },
        .isChecked = [&document, which] { return document.scene().image.reconstruction == which; },
        .group = "reconstruction"};
}

} // namespace

std::vector<Command> lookCommands(const Scope &scope) {
    using scene::Reconstruction;
    Document &document = scope.bench.study.document;
    LookDocks &docks = scope.look;
    PresetsPanel &presets = docks.presets();
    ShadingPanel &shading = docks.shading();
    WindowChooser &windows = scope.windows;
    const auto isOpen = [&document] { return document.volume().has_value(); };
    return {
        {.id = "saveLookAction",
         .text = LookCommands::tr("&Save look..."),
         .key = "Ctrl+S",
         .run =
             [&docks, &presets] {
                 docks.unfold(presets);
                 presets.askForName();
             }},
        {.id = "importPresetAction",
         .text = LookCommands::tr("&Import preset..."),
         .run = [&presets] { presets.importPreset(); }},
        {.id = "exportPresetAction",
         .text = LookCommands::tr("&Export preset..."),
         .run = [&presets] { presets.exportPreset(); }},
        {.id = "depthCueAction",
         .text = LookCommands::tr("&Depth cue"),
         .key = "D",
         .run = [&shading] { shading.toggleCue(); },
         .isEnabled = isOpen,
         .isChecked = [&document] { return document.scene().shading.cue.isActive(); }},
        {.id = "addLightAction",
         .text = LookCommands::tr("Add l&ight"),
         .key = "L",
         .run =
             [&docks, &shading] {
                 docks.unfold(shading);
                 shading.addLight();
             },
         .isEnabled = isOpen},
        {.id = "resetShadingAction",
         .text = LookCommands::tr("Reset s&hading"),
         .key = "Shift+L",
         .run = [&shading] { shading.reset(); },
         .isEnabled = isOpen},
        reconstruction(document, "cubicAction", LookCommands::tr("&Cubic"), Reconstruction::cubic),
        reconstruction(document, "linearAction", LookCommands::tr("&Linear"),
                       Reconstruction::linear),
        reconstruction(document, "splineAction", LookCommands::tr("S&pline"),
                       Reconstruction::spline),
        reconstruction(document, "bandLimitedAction", LookCommands::tr("&Sharp (band-limited)"),
                       Reconstruction::bandLimited),
        {.id = "filmAction",
         .text = LookCommands::tr("In&verted projection (bone dark)"),
         .key = "I",
         .run =
             [&document] {
                 editScene(document, LookCommands::tr("Inverted"), noDrag,
                           [](scene::Scene &scene) { scene.tone.inverted = !scene.tone.inverted; });
             },
         .isChecked = [&document] { return document.scene().tone.inverted; }},
        {.id = "automaticToneAction",
         .text = LookCommands::tr("&Automatic brightness"),
         .run =
             [&document, projection = scope.viewer.projection] {
                 editScene(document, LookCommands::tr("Automatic brightness"), noDrag,
                           [](scene::Scene &scene) {
                               scene.tone.low.reset();
                               scene.tone.high.reset();
                           });
                 projection->frames().retakeExposure();
             }},
        {.id = "removeCouchAction",
         .text = LookCommands::tr("Remove the c&ouch"),
         .run =
             [&document] {
                 setWithoutCouch(document, !classify::isWithoutCouch(document.scene().look));
             },
         // The body is found by HU.
         .isEnabled =
             [&document] {
                 return document.volume() &&
                        document.volume()->unit() == volume::ValueUnit::hounsfield;
             },
         .isChecked = [&document] { return classify::isWithoutCouch(document.scene().look); }},
        {.id = "autoWindowAction",
         .text = LookCommands::tr("Automatic window"),
         .key = "0",
         .run = [&windows] { windows.chooseAutomatic(); },
         .isEnabled = isOpen},
        {.id = "invertedPlanesAction",
         .text = LookCommands::tr("&Inverted grey"),
         .key = "N",
         .run = [&windows] { windows.invert(); },
         .isEnabled = isOpen,
         .isChecked = [&document] { return document.displayWindow().isInverted; }},
        {.id = "displayWindowAction",
         .text = LookCommands::tr("&Width and center..."),
         .key = "Shift+W",
         .run = [&windows] { windows.openDialog(); },
         .isEnabled = isOpen},
    };
}

} // namespace pellucid::ui
