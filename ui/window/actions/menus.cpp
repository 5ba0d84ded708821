// SPDX-License-Identifier: GPL-3.0-or-later
#include <QCoreApplication>

#include "ui/window/actions/commands.h"

namespace pellucid::ui {

namespace {

struct MenuTexts {
    Q_DECLARE_TR_FUNCTIONS(MenuTexts)
};

const MenuEntry separator;

std::vector<MenuEntry> sides() {
    return {{"frontViewAction"}, {"backViewAction"}, {"leftViewAction"},
            {"rightViewAction"}, {"topViewAction"},  {"bottomViewAction"}};
}

MenuEntry fileMenu() {
    return {"",
            MenuTexts::tr("&File"),
            {{"openFilesAction"},
             {"openFolderAction"},
             {"importAction"},
             {"serversAction"},
             {"openSegmentationAction"},
             {"subtractAction"},
             {"", MenuTexts::tr("Open &phantom"), {{"headPhantomAction"}, {"chestPhantomAction"}}},
             separator,
             {"openSceneAction"},
             {"saveSceneAction"},
             {"saveSegmentsAction"},
             {"savePictureAction"},
             {"exportPictureAction"},
             {"copyPictureAction"},
             {"printAction"},
             {"exportMeasurementsAction"},
             {"headerAction"},
             separator,
             {"preferencesAction"},
             {"forgetRecentAction"},
             {"quitAction"}}};
}

MenuEntry editMenu() {
    return {"",
            MenuTexts::tr("&Edit"),
            {{"undoAction"},
             {"redoAction"},
             separator,
             {"findStudyAction"},
             separator,
             {"deleteMeasurementAction"}}};
}

MenuEntry viewMenu() {
    std::vector<MenuEntry> entries = standardViews();
    const std::vector<MenuEntry> rest{
        {"resetViewsAction"},
        {"orbitCrosshairAction"},
        {"freeRotationAction"},
        {"tintSegmentsAction"},
        {"compareAction"},
        separator,
        {"annotationsAction"},
        {"crosshairAction"},
        {"bannerAction"},
        separator,
        {"linkStudiesAction"},
        {"closeBesideAction"},
        {"prepareAgainAction"},
        separator,
        {"onePlusThreeAction"},
        {"twoByTwoAction"},
        separator,
        {"",
         MenuTexts::tr("Projection &engine"),
         {{"automaticEngineAction"}, {"processorEngineAction"}, {"cardEngineAction"}}},
        separator,
        {"fullScreenAction"}};
    entries.insert(entries.end(), rest.begin(), rest.end());
    return {"", MenuTexts::tr("&View"), entries};
}

MenuEntry lookMenu() {
    return {"",
            MenuTexts::tr("&Look"),
            {{"saveLookAction"},
             {"importPresetAction"},
             {"exportPresetAction"},
             separator,
             {"depthCueAction"},
             {"addLightAction"},
             {"resetShadingAction"},
             separator,
             {"",
              MenuTexts::tr("P&rojection interpolation"),
              {{"cubicAction"}, {"linearAction"}, {"splineAction"}, {"bandLimitedAction"}}},
             {"filmAction"},
             {"automaticToneAction"},
             {"removeCouchAction"},
             {"windowMenu",
              MenuTexts::tr("&Window presets"),
              {{"autoWindowAction"}, {"invertedPlanesAction"}, {"displayWindowAction"}}}}};
}

} // namespace

std::vector<MenuEntry> standardViews() {
    std::vector<MenuEntry> views = sides();
    views.push_back({"anglesAction"});
    return views;
}

Menus menus() {
    return {.bar = {fileMenu(),
                    editMenu(),
                    viewMenu(),
                    lookMenu(),
                    toolsMenu(),
                    {"dockMenu", MenuTexts::tr("W&indow"), {{"resetLayoutAction"}}},
                    {"", MenuTexts::tr("&Help"), {{"manualAction"}, {"aboutAction"}}}},
            .plane = {{"windowMenu"},
                      {"slabMenu"},
                      separator,
                      {"straightenAction"},
                      {"alongScanAction"}},
            .projection = {{"", MenuTexts::tr("&View"), sides()},
                           {"anglesAction"},
                           separator,
                           {"filmAction"},
                           {"automaticToneAction"},
                           {"removeCouchAction"},
                           {"depthCueAction"},
                           {"compareAction"}},
            .tools = toolEntries()};
}

} // namespace pellucid::ui
