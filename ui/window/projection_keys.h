// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

class QWidget;

namespace pellucid::ui {

class ProjectionView;

/// Keys of the projection wherever in the window the keyboard is: lists would search for a held
/// letter, and the digits of the keypad would be those of the windows. Who types keeps the keys.
class ProjectionKeys : public QObject {
    Q_OBJECT
public:
    ProjectionKeys(QWidget &window, ProjectionView &projection);
    bool eventFilter(QObject *watched, QEvent *event) override;

signals:
    /// Q is held, or let go.
    void comparisonRequested(bool isComparing);

private:
    QWidget &m_window;
    ProjectionView &m_projection;
    bool m_isForwarding = false;
};

} // namespace pellucid::ui
