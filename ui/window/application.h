// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QApplication>
#include <QElapsedTimer>

#include "core/task/reason.h"

namespace pellucid::ui {

/// Catches exceptions that event handlers throw and reports them, so that the program continues. Qt
/// itself would terminate it.
class Application : public QApplication {
    Q_OBJECT
public:
    using QApplication::QApplication;
    bool notify(QObject *receiver, QEvent *event) override;

signals:
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    /// Prevents repeated reports of an error that recurs at every repaint.
    std::optional<task::Reason> m_lastFailure;
    QElapsedTimer m_sinceFailure;
};

} // namespace pellucid::ui
