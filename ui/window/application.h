// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QApplication>
#include <QElapsedTimer>

#include "core/task/reason.h"

namespace pellucid::ui {

/// Catches exceptions that event handlers throw and reports them, so that the program continues. Qt
/// itself would terminate it. Also makes the labels that Qt creates show plain text.
class Application : public QApplication {
    Q_OBJECT
public:
    Application(int &argc, char **argv);
    ~Application() override;
    bool notify(QObject *receiver, QEvent *event) override;

    /// Whether a helper runs without the protection that keeps it from everything else.
    bool isUnprotected() const { return m_isUnprotected; }

signals:
    /// The first such helper has started.
    void unprotected();
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    /// Prevents repeated reports of an error that recurs at every repaint.
    std::optional<task::Reason> m_lastFailure;
    QElapsedTimer m_sinceFailure;
    bool m_isUnprotected = false;
};

} // namespace pellucid::ui
