// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QObject>

class QDockWidget;
class QMainWindow;

namespace pellucid::ui {

class EarlierPanel;
class MeasurementsPanel;
class StudyPanel;
class TransfersPanel;
struct Workbench;

/// The docks on the left of the window: studies; measurements, earlier studies and transfers, as
/// tabs; edit history. Earlier studies and those after them are hidden at first.
class StudyDocks : public QObject {
    Q_OBJECT
public:
    StudyDocks(QMainWindow &window, Workbench &bench);

    StudyPanel &studies() { return *m_studies; }
    MeasurementsPanel &measurements() { return *m_measurements; }
    EarlierPanel &earlier() { return *m_earlier; }
    /// The docks in the Window menu.
    std::vector<QDockWidget *> listed() const {
        return {m_study, m_measured, m_earlierDock, m_transfers, m_history};
    }
    TransfersPanel &transfersPanel() { return *m_transfersPanel; }
    QDockWidget &study() { return *m_study; }
    QDockWidget &transfers() { return *m_transfers; }

    /// Shows studies and measurements where they were at first, and hides the others.
    void reset();

private:
    void arrange();
    QDockWidget *addHistory(QMainWindow &window, Workbench &bench);

    QMainWindow &m_window;
    StudyPanel *m_studies;
    MeasurementsPanel *m_measurements;
    EarlierPanel *m_earlier;
    TransfersPanel *m_transfersPanel = nullptr;
    QDockWidget *m_study, *m_measured, *m_earlierDock, *m_transfers, *m_history;
};

} // namespace pellucid::ui
