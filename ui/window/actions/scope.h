// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/views/viewer.h"

namespace pellucid::ui {

class Cine;
class FileActions;
class LookDocks;
class MainWindow;
class ServerCommands;
class StudyDocks;
class StudyPair;
class WindowChooser;
struct Workbench;

/// What the user's commands act on.
struct Scope {
    MainWindow &window;
    Workbench &bench;
    Viewer viewer; ///< of the open study
    StudyPair &pair;
    StudyDocks &docks;
    LookDocks &look;
    FileActions &files;
    ServerCommands &servers;
    WindowChooser &windows;
    Cine &cine;
};

} // namespace pellucid::ui
