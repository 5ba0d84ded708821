// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace pellucid::ui {

class Document;
class MprView;
class PaneArea;
class ProjectionView;

/// A document with the panes that show it. The panes belong to their area.
struct Viewer {
    Document &document;
    std::array<MprView *, 3> planes;
    ProjectionView *projection;
    PaneArea *area;
};

} // namespace pellucid::ui
