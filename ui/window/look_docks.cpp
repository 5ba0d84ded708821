// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/look_docks.h"

#include <algorithm>

#include <QAction>
#include <QDockWidget>
#include <QMainWindow>
#include <QScopedValueRollback>
#include <QScrollArea>

#include "ui/engine/card_copier.h"
#include "ui/engine/look_preparer.h"
#include "ui/panels/classes_panel.h"
#include "ui/panels/presets_panel.h"
#include "ui/panels/quality_panel.h"
#include "ui/panels/radiograph_panel.h"
#include "ui/panels/shading_panel.h"
#include "ui/panels/transfer_function_panel.h"
#include "ui/views/projection_view.h"
#include "ui/widgets/dock.h"
#include "ui/widgets/panel_background.h"

namespace pellucid::ui {

namespace {

constexpr int panelWidth = 300;
// In a shorter window, the panels would not fit below each other.
constexpr int shortWindow = 960, tabsHeight = 300;

// Lets a panel scroll, so that all docks fit in a height of 720 pixels.
QWidget *scrolling(QWidget *panel) {
    auto *area = new QScrollArea;
    setPanelBackground(*area, panel->objectName() + "Area");
    area->setWidget(panel);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setMinimumHeight(48);
    return area;
}

} // namespace

LookDocks::LookDocks(QMainWindow &window, Document &document, LookPreparer &preparer,
                     CardCopier &copier, ProjectionView &projection)
    : QObject(&window), m_window(window), m_previewer(document),
      m_presets(new PresetsPanel(document)), m_radiograph(new RadiographPanel(document)),
      m_classes(new ClassesPanel(document)), m_function(new TransferFunctionPanel(document)),
      m_shading(new ShadingPanel(document)), m_quality(new QualityPanel(document)) {
    // At these heights, the docks fit in 900 pixels.
    dock(tr("PRESETS"), "presetsDock", m_presets, m_presets->corner(), 150, WhenShort::tab);
    dock(tr("RADIOGRAPH"), "radiographDock", scrolling(m_radiograph), m_radiograph->corner(), 116,
         WhenShort::tab);
    // Classes and the curve of the selected one are seen together.
    dock(tr("CLASSES"), "classesDock", m_classes, m_classes->corner(), 140, WhenShort::row);
    dock(tr("TRANSFER FUNCTION"), "transferFunctionDock", m_function, m_function->corner(), 165,
         WhenShort::row);
    dock(tr("SHADING"), "shadingDock", scrolling(m_shading), m_shading->corner(), 145,
         WhenShort::tab);
    dock(tr("QUALITY"), "qualityDock", scrolling(m_quality), m_quality->corner(), 140,
         WhenShort::tab);

    QList<QDockWidget *> rows;
    QList<int> heights;
    for (const Entry &entry : m_docks) {
        rows << entry.dock;
        heights << entry.height;
    }
    window.resizeDocks(rows, heights, Qt::Vertical);
    window.setTabPosition(Qt::RightDockWidgetArea, QTabWidget::North);
    for (QDockWidget *dock : docks()) {
        const auto moved = [this] {
            if (m_isArranging)
                return;
            m_areMoved = true;
            showHeadings();
        };
        connect(dock, &QDockWidget::topLevelChanged, this, moved);
        connect(dock, &QDockWidget::dockLocationChanged, this, moved);
    }
    connect(m_presets, &PresetsPanel::presetsListed, &m_previewer, &LookPreviewer::preview);
    connect(m_presets, &PresetsPanel::lookNamed, &projection, &ProjectionView::setLookName);
    connect(&m_previewer, &LookPreviewer::pictureReady, m_presets, &PresetsPanel::setPicture);
    connect(&m_previewer, &LookPreviewer::histogramReady, m_function,
            &TransferFunctionPanel::setHistogram);
    connect(&copier, &CardCopier::engineReady, m_quality, &QualityPanel::showPlan);
    connect(m_quality, &QualityPanel::chosenAgain, &preparer, &LookPreparer::prepareAgain);
    connect(&projection, &ProjectionView::frameShown, m_quality, &QualityPanel::showFrame);
    connect(&projection.frames(), &ProjectionFrames::errorMeasured, m_quality,
            &QualityPanel::showError);
}

std::vector<QDockWidget *> LookDocks::docks() const {
    std::vector<QDockWidget *> docks;
    for (const Entry &entry : m_docks)
        docks.push_back(entry.dock);
    return docks;
}

void LookDocks::unfold(QWidget &panel) {
    for (QDockWidget *dock : docks())
        if (dock->isAncestorOf(&panel)) {
            dock->show();
            dock->raise(); // in front of other tabs
            dock->widget()->show();
        }
}

// A tab names its dock.
void LookDocks::showHeadings() {
    for (QDockWidget *dock : docks())
        showHeading(*dock, dock->isFloating() || m_window.tabifiedDockWidgets(dock).isEmpty());
}

bool LookDocks::areTabs() const {
    return !m_window.tabifiedDockWidgets(m_docks.front().dock).isEmpty();
}

void LookDocks::fit(int windowHeight) {
    const bool asTabs = windowHeight < shortWindow;
    if (!m_areMoved && asTabs != areTabs())
        arrange(asTabs);
    showHeadings(); // also of a layout that was restored
}

void LookDocks::reset(int windowHeight) {
    for (QDockWidget *dock : docks()) {
        dock->setFloating(false);
        dock->show();
        dock->widget()->show();
    }
    m_areMoved = false;
    arrange(windowHeight < shortWindow);
}

void LookDocks::arrange(bool asTabs) {
    const QScopedValueRollback arranging(m_isArranging, true);
    QList<QDockWidget *> shown;
    for (QDockWidget *dock : docks()) {
        // Before the window is shown, docks that nobody has hidden count as hidden, too.
        const bool isClosed =
            dock->testAttribute(Qt::WA_WState_ExplicitShowHide) && dock->isHidden();
        if (!isClosed)
            shown << dock;
        m_window.removeDockWidget(dock);
    }
    QDockWidget *const first = m_docks.front().dock;
    QList<QDockWidget *> rows;
    QList<int> heights;
    for (const auto &[dock, height, place] : m_docks) {
        const bool isTab = asTabs && place == WhenShort::tab;
        m_window.addDockWidget(Qt::RightDockWidgetArea, dock);
        if (isTab && dock != first)
            m_window.tabifyDockWidget(first, dock);
        else {
            rows << dock;
            heights << (isTab ? tabsHeight : height);
        }
        dock->setVisible(shown.contains(dock));
    }
    first->raise();
    showHeadings();
    m_window.resizeDocks(rows, heights, Qt::Vertical);
}

void LookDocks::dock(const QString &title, const char *name, QWidget *panel, QWidget *corner,
                     int height, WhenShort place) {
    panel->setMinimumWidth(panelWidth);
    QDockWidget *const dock = makeDock(title, name, panel, corner);
    m_window.addDockWidget(Qt::RightDockWidgetArea, dock);
    m_docks.push_back({dock, height, place});
}

} // namespace pellucid::ui
