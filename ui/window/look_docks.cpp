// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/look_docks.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QScrollArea>

#include "ui/engine/card_copier.h"
#include "ui/engine/look_preparer.h"
#include "ui/panels/classes_panel.h"
#include "ui/panels/presets_panel.h"
#include "ui/panels/quality_panel.h"
#include "ui/panels/radiograph_panel.h"
#include "ui/panels/shading_panel.h"
#include "ui/panels/transfer_function_panel.h"
#include "ui/theme/dock.h"
#include "ui/views/projection_view.h"

namespace pellucid::ui {

namespace {

constexpr int panelWidth = 300;

// Lets a panel scroll, so that all docks fit in a height of 720 pixels.
QWidget *scrolling(QWidget *panel) {
    auto *area = new QScrollArea;
    area->setObjectName(panel->objectName() + "Area");
    area->setWidget(panel);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setMinimumHeight(48);
    return area;
}

} // namespace

LookDocks::LookDocks(QMainWindow &window, Document &document, LookPreparer &preparer,
                     CardCopier &copier, ProjectionView &projection, const Theme &theme)
    : QObject(&window), m_previewer(document), m_presets(new PresetsPanel(document)),
      m_radiograph(new RadiographPanel(document)), m_classes(new ClassesPanel(document)),
      m_function(new TransferFunctionPanel(document, theme)),
      m_shading(new ShadingPanel(document, theme)), m_quality(new QualityPanel(document)) {
    // At these heights, the docks fit in 900 pixels.
    dock(window, tr("PRESETS"), "presetsDock", m_presets, m_presets->corner(), 150);
    dock(window, tr("RADIOGRAPH"), "radiographDock", scrolling(m_radiograph),
         m_radiograph->corner(), 116);
    dock(window, tr("CLASSES"), "classesDock", m_classes, m_classes->corner(), 140);
    dock(window, tr("TRANSFER FUNCTION"), "transferFunctionDock", m_function, m_function->corner(),
         165);
    dock(window, tr("SHADING"), "shadingDock", scrolling(m_shading), m_shading->corner(), 145);
    dock(window, tr("QUALITY"), "qualityDock", scrolling(m_quality), m_quality->corner(), 140);

    connect(m_presets, &PresetsPanel::presetsListed, &m_previewer, &LookPreviewer::preview);
    connect(m_presets, &PresetsPanel::lookNamed, &projection, &ProjectionView::setLookName);
    connect(&m_previewer, &LookPreviewer::pictureReady, m_presets, &PresetsPanel::setPicture);
    connect(&m_previewer, &LookPreviewer::histogramReady, m_function,
            &TransferFunctionPanel::setHistogram);
    connect(&copier, &CardCopier::engineReady, m_quality, &QualityPanel::showPlan);
    connect(m_quality, &QualityPanel::chosenAgain, &preparer, &LookPreparer::prepareAgain);
    connect(&projection, &ProjectionView::frameShown, m_quality, &QualityPanel::showFrame);
}

void LookDocks::unfold(QWidget &panel) {
    for (QDockWidget *dock : m_docks)
        if (dock->isAncestorOf(&panel)) {
            dock->show();
            dock->widget()->show();
        }
}

void LookDocks::dock(QMainWindow &window, const QString &title, const char *name, QWidget *panel,
                     QWidget *corner, int height) {
    QDockWidget *dock = makeDock(title, name, panel, corner);
    panel->setMinimumWidth(panelWidth);
    window.addDockWidget(Qt::RightDockWidgetArea, dock);
    m_docks.push_back(dock);
    m_heights.push_back(height);
    window.resizeDocks(QList<QDockWidget *>(m_docks.begin(), m_docks.end()),
                       QList<int>(m_heights.begin(), m_heights.end()), Qt::Vertical);
}

} // namespace pellucid::ui
