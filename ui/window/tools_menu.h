// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <QList>
#include <QObject>

#include "core/mpr/reslice.h"
#include "ui/views/tools/tool.h"

class QAction;
class QActionGroup;
class QMenu;
class QToolBar;

namespace pellucid::ui {

class Cine;
class Document;
class MprView;
class Phases;
class ProjectionView;

/// The Tools menu: mouse tools, regions, slab, interpolation, turned planes, cine. The tool bar
/// also has the tools and the slab.
class ToolsMenu : public QObject {
    Q_OBJECT
public:
    ToolsMenu(QMenu &menu, Document &document, const std::array<MprView *, 3> &planes,
              ProjectionView &projection, Phases &phases);

    void addTo(QToolBar &bar);
    /// Adds the mouse tools.
    void addToolsTo(QMenu &menu) const;
    Tool tool() const { return m_tool; }

signals:
    void toolChosen(pellucid::ui::Tool tool);
    void classVolumesRequested();

private:
    void addTools(QMenu &menu);
    void addRegion(QMenu &menu);
    void showRegion();
    void removeBone();
    void addSlab(QMenu &menu);
    void addInterpolation(QMenu &menu);
    void addCine(QMenu &menu);
    void addPhases(QMenu &menu, Phases &phases);
    void chooseTool(Tool tool);
    void setSlab(const mpr::Slab &slab);
    void toggleSlab();
    /// Steps through the thicknesses of the menu; negative: thinner.
    void changeThickness(int steps);
    void askForThickness();
    void showCut();

    Document &m_document;
    std::array<MprView *, 3> m_planes;
    ProjectionView &m_projection;
    Cine *m_cine;
    Tool m_tool = Tool::window;
    QActionGroup *m_tools, *m_thicknesses, *m_modes, *m_interpolations;
    QMenu *m_slabMenu = nullptr;
    QAction *m_slab = nullptr, *m_alongScan = nullptr, *m_straighten = nullptr,
            *m_wholeVolume = nullptr, *m_removeBone = nullptr, *m_classVolumes = nullptr;
    QList<QAction *> m_regionActions; ///< for the selected class
    double m_lastThicknessMm = 10.0;
};

} // namespace pellucid::ui
