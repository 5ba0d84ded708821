// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QApplication>
#include <QElapsedTimer>

#include "core/task/reason.h"

namespace pellucid::ui {

/// What the user interface's thread lets fall is caught between two events and said: the program
/// goes on. Qt itself would end.
class Application : public QApplication {
    Q_OBJECT
public:
    using QApplication::QApplication;
    bool notify(QObject *receiver, QEvent *event) override;

signals:
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    /// What fails at every repaint is not said each time.
    std::optional<task::Reason> m_lastFailure;
    QElapsedTimer m_sinceFailure;
};

} // namespace pellucid::ui
