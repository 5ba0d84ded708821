// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QApplication>
#include <QElapsedTimer>

namespace pellucid::ui {

/// What the user interface's thread lets fall is caught between two events and said: the program
/// goes on. Qt itself would end.
class Application : public QApplication {
    Q_OBJECT
public:
    using QApplication::QApplication;
    bool notify(QObject *receiver, QEvent *event) override;

signals:
    void failed(const QString &what, const QString &path);

private:
    QString m_lastFailure; ///< what fails at every repaint is not said each time
    QElapsedTimer m_sinceFailure;
};

} // namespace pellucid::ui
