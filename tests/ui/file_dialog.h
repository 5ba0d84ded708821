// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QApplication>
#include <QFileDialog>
#include <QLineEdit>
#include <QTimer>

namespace pellucid::test {

/// Enters a path in the next file dialog, once that is open. `parent` outlives the dialog.
inline void answerFileDialog(QObject *parent, const QString &path) {
    auto *waiting = new QTimer(parent);
    waiting->start(20);
    QObject::connect(waiting, &QTimer::timeout, parent, [path, waiting] {
        auto *const dialog = qobject_cast<QFileDialog *>(QApplication::activeModalWidget());
        if (dialog == nullptr)
            return;
        waiting->stop();
        waiting->deleteLater();
        dialog->findChild<QLineEdit *>("fileNameEdit")->setText(path);
        QMetaObject::invokeMethod(dialog, "accept");
    });
}

} // namespace pellucid::test
