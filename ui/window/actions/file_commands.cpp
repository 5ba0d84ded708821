// SPDX-License-Identifier: GPL-3.0-or-later
#include <QCoreApplication>
#include <QDockWidget>
#include <QUndoStack>

#include "ui/panels/measurements_panel.h"
#include "ui/panels/study_panel.h"
#include "ui/window/actions/commands.h"
#include "ui/window/file_actions.h"
#include "ui/window/help.h"
#include "ui/window/main_window.h"
#include "ui/window/reopening.h"
#include "ui/window/server_commands.h"
#include "ui/window/study_docks.h"

namespace pellucid::ui {

namespace {

struct FileCommands {
    Q_DECLARE_TR_FUNCTIONS(FileCommands)
};

} // namespace

std::vector<Command> fileCommands(const Scope &scope) {
    MainWindow &window = scope.window;
    Document &document = scope.bench.study.document;
    FileActions &files = scope.files;
    StudyDocks &docks = scope.docks;
    QUndoStack *const edits = document.undoStack();
    const auto isOpen = [&document] { return document.volume() && !document.isPreview(); };
    // Nothing is made of a part of a study.
    const auto isWhole = [&document] { return !document.isPreview(); };
    return {
        {.id = "openFilesAction",
         .text = FileCommands::tr("&Open files..."),
         .key = "Ctrl+O",
         .icon = "open",
         .run = [&files] { files.chooseFiles(); },
         .label = FileCommands::tr("Open")},
        {.id = "openFolderAction",
         .text = FileCommands::tr("Open &folder..."),
         .key = "Ctrl+Shift+O",
         .run = [&files] { files.chooseFolder(); }},
        {.id = "importAction",
         .text = FileCommands::tr("&Import into the library..."),
         .key = "Ctrl+I",
         .icon = "import",
         .run = [&files] { files.importPaths({}); },
         .label = FileCommands::tr("Import")},
        {.id = "serversAction",
         .text = FileCommands::tr("Ser&vers..."),
         .run = [&servers = scope.servers] { servers.showServers(); }},
        {.id = "openSegmentationAction",
         .text = FileCommands::tr("Open se&gmentation..."),
         .run = [&files] { files.chooseSegmentations(); },
         .isEnabled = isOpen},
        {.id = "subtractAction",
         .text = FileCommands::tr("Su&btract a volume..."),
         .run = [&files] { files.chooseSubtrahend(); },
         .isEnabled =
             [&document, isOpen] {
                 return isOpen() && !document.volume()->notes().isDifference &&
                        document.volume()->notes().placed;
             }},
        {.id = "headPhantomAction",
         .text = FileCommands::tr("&Head"),
         .run = [&window] { window.openPhantom("head"); }},
        {.id = "chestPhantomAction",
         .text = FileCommands::tr("&Chest"),
         .run = [&window] { window.openPhantom("chest"); }},
        {.id = "openSceneAction",
         .text = FileCommands::tr("Open &scene..."),
         .run = [&files] { files.openScene(); }},
        {.id = "saveSceneAction",
         .text = FileCommands::tr("Save s&cene as..."),
         .run = [&files] { files.saveScene(); },
         .isEnabled = isWhole},
        {.id = "saveSegmentsAction",
         .text = FileCommands::tr("Save classes as segmenta&tion..."),
         .run = [&files] { files.saveSegments(); },
         .isEnabled = isWhole},
        {.id = "savePictureAction",
         .text = FileCommands::tr("Save p&icture as..."),
         .key = "F12",
         .icon = "picture",
         .run = [&files] { files.savePicture(); },
         .isEnabled = isWhole,
         .label = FileCommands::tr("Picture")},
        {.id = "exportPictureAction",
         .text = FileCommands::tr("&Export picture..."),
         .key = "Ctrl+E",
         .icon = "export",
         .run = [&files] { files.exportPicture(); },
         .isEnabled = isWhole,
         .label = FileCommands::tr("Export")},
        {.id = "copyPictureAction",
         .text = FileCommands::tr("Cop&y picture"),
         .key = "Ctrl+C",
         .icon = "copy",
         .run = [&files] { files.copyPicture(); },
         .isEnabled = isWhole},
        {.id = "printAction",
         .text = FileCommands::tr("Pri&nt..."),
         .key = "Ctrl+P",
         .icon = "print",
         .run = [&files] { files.printPicture(); },
         .isEnabled = isWhole},
        {.id = "exportMeasurementsAction",
         .text = FileCommands::tr("Export &measurements..."),
         .run = [&files] { files.exportMeasurements(); }},
        {.id = "headerAction",
         .text = FileCommands::tr("&DICOM header..."),
         .key = "Ctrl+D",
         .icon = "tags",
         .run = [&files] { files.showHeader(); },
         .isEnabled = [&files] { return !files.headerFiles().isEmpty(); }},
        {.id = "preferencesAction",
         .text = FileCommands::tr("P&references..."),
         .key = "Ctrl+,",
         .icon = "preferences",
         .run = [&window] { window.openPreferences(); }},
        {.id = "forgetRecentAction",
         .text = FileCommands::tr("Clear recent st&udies"),
         .run = [&window] { window.reopening().forgetAll(); }},
        {.id = "quitAction",
         .text = FileCommands::tr("&Quit"),
         .key = "Ctrl+Q",
         .run = [&window] { window.close(); }},

        {.id = "undoAction",
         .key = "Ctrl+Z",
         .icon = "undo",
         .label = FileCommands::tr("Undo"), // of the button; the menu names the edit
         .action = edits->createUndoAction(&window, FileCommands::tr("Undo"))},
        {.id = "redoAction",
         .key = "Ctrl+Shift+Z",
         .icon = "redo",
         .label = FileCommands::tr("Redo"),
         .action = edits->createRedoAction(&window, FileCommands::tr("Redo"))},
        {.id = "findStudyAction",
         .text = FileCommands::tr("&Find a study"),
         .key = "Ctrl+F",
         .icon = "search",
         .run =
             [&docks] {
                 docks.study().show();
                 docks.studies().focusSearch();
             }},
        {.id = "deleteMeasurementAction",
         .text = FileCommands::tr("&Delete measurement"),
         .key = "Del",
         .run = [&docks] { docks.measurements().removeSelected(); }},

        {.id = "resetLayoutAction",
         .text = FileCommands::tr("&Reset layout"),
         .run = [&window] { window.resetLayout(); }},
        {.id = "manualAction",
         .text = FileCommands::tr("&Manual"),
         .key = "F1",
         .icon = "manual",
         .run = [&notices = scope.bench.notices] { openManual(notices); }},
        {.id = "aboutAction",
         .text = FileCommands::tr("&About Pellucid"),
         .run = [&window] { showAbout(window); }},
    };
}

} // namespace pellucid::ui
