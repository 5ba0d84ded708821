// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/study_docks.h"

#include <QAction>
#include <QDockWidget>
#include <QMainWindow>
#include <QUndoView>

#include "ui/panels/earlier_panel.h"
#include "ui/panels/measurements_panel.h"
#include "ui/panels/study_panel.h"
#include "ui/panels/transfers_panel.h"
#include "ui/widgets/dock.h"
#include "ui/window/workbench.h"

namespace pellucid::ui {

StudyDocks::StudyDocks(QMainWindow &window, Workbench &bench)
    : QObject(&window), m_window(window),
      m_studies(new StudyPanel(bench.study.document, bench.library, bench.serverSearch)),
      m_measurements(new MeasurementsPanel(bench.study.document)),
      m_earlier(new EarlierPanel(bench.earlier)) {
    m_study = makeDock(tr("STUDIES"), "studyDock", m_studies, m_studies->corner());
    m_studies->setMinimumWidth(250);
    window.addDockWidget(Qt::LeftDockWidgetArea, m_study);
    m_measured =
        makeDock(tr("MEASUREMENTS"), "measurementsDock", m_measurements, m_measurements->corner());
    window.addDockWidget(Qt::LeftDockWidgetArea, m_measured);
    window.resizeDocks({m_study, m_measured}, {700, 180}, Qt::Vertical);
    m_earlierDock = makeDock(tr("PRIOR STUDIES"), "earlierDock", m_earlier, nullptr);
    window.addDockWidget(Qt::LeftDockWidgetArea, m_earlierDock);
    m_earlierDock->hide();
    m_transfersPanel = new TransfersPanel(bench.transfers, bench.receiver, bench.servers);
    m_transfers =
        makeDock(tr("TRANSFERS"), "transfersDock", m_transfersPanel, m_transfersPanel->corner());
    window.addDockWidget(Qt::LeftDockWidgetArea, m_transfers);
    m_transfers->hide();
    m_history = addHistory(window, bench);
    arrange();
    // A tab that is asked for comes to the front.
    for (QDockWidget *dock : {m_measured, m_earlierDock, m_transfers})
        connect(dock->toggleViewAction(), &QAction::triggered, dock, [dock](bool isShown) {
            if (isShown)
                dock->raise();
        });
}

// One above the other, they would leave room for a few rows each.
void StudyDocks::arrange() {
    for (QDockWidget *dock : {m_earlierDock, m_transfers})
        m_window.tabifyDockWidget(m_measured, dock);
}

void StudyDocks::reset() {
    for (QDockWidget *dock : {m_study, m_measured, m_earlierDock, m_transfers, m_history}) {
        dock->setFloating(false);
        m_window.addDockWidget(Qt::LeftDockWidgetArea, dock);
        dock->setVisible(dock == m_study || dock == m_measured);
    }
    arrange();
    m_studies->show();
    m_measurements->show();
    m_window.resizeDocks({m_study, m_measured}, {700, 180}, Qt::Vertical);
}

QDockWidget *StudyDocks::addHistory(QMainWindow &window, Workbench &bench) {
    auto *history = new QUndoView(bench.study.document.undoStack());
    history->setObjectName("historyView");
    history->setAccessibleName(tr("Edit history"));
    history->setToolTip(tr("Click an edit to return to the state after it"));
    history->setEmptyLabel(tr("As opened"));
    QDockWidget *dock = makeDock(tr("HISTORY"), "historyDock", history, nullptr);
    window.addDockWidget(Qt::LeftDockWidgetArea, dock);
    dock->hide();
    return dock;
}

} // namespace pellucid::ui
