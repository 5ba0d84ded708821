// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

class QWidget;

namespace pellucid::ui {

class ProjectionView;

/// Makes the projection's keys work with any focus in the window: otherwise, a list would search
/// for a held letter, and keypad digits would select window presets. Text fields keep their keys.
class ProjectionKeys : public QObject {
    Q_OBJECT
public:
    ProjectionKeys(QWidget &window, ProjectionView &projection);
    bool eventFilter(QObject *watched, QEvent *event) override;

signals:
    /// Q is pressed or released.
    void comparisonRequested(bool isComparing);

private:
    QWidget &m_window;
    ProjectionView &m_projection;
    bool m_isForwarding = false;
};

} // namespace pellucid::ui
