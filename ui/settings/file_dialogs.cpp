// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/settings/file_dialogs.h"

#include <array>

#include <QFileDialog>
#include <QSettings>
#include <QVariant>

namespace pellucid::ui {

namespace {

// Restores the history settings that Qt's dialogs write when they close.
class DialogHistoryGuard {
public:
    DialogHistoryGuard() {
        for (std::size_t n = 0; n < keys.size(); ++n)
            m_before[n] = m_qtSettings.value(keys[n]);
    }
    ~DialogHistoryGuard() {
        m_qtSettings.sync();
        for (std::size_t n = 0; n < keys.size(); ++n)
            if (m_before[n].isValid())
                m_qtSettings.setValue(keys[n], m_before[n]);
            else
                m_qtSettings.remove(keys[n]);
    }
    DialogHistoryGuard(const DialogHistoryGuard &) = delete;
    DialogHistoryGuard &operator=(const DialogHistoryGuard &) = delete;

private:
    static constexpr std::array keys{"FileDialog/history", "FileDialog/lastVisited"};
    QSettings m_qtSettings{QSettings::UserScope, "QtProject"};
    std::array<QVariant, 2> m_before;
};

} // namespace

QStringList askForFiles(QWidget *parent, const QString &title) {
    const DialogHistoryGuard guard;
    return QFileDialog::getOpenFileNames(parent, title);
}

QString askForFile(QWidget *parent, const QString &title, const QString &filter) {
    const DialogHistoryGuard guard;
    return QFileDialog::getOpenFileName(parent, title, {}, filter);
}

QString askForFolder(QWidget *parent, const QString &title) {
    const DialogHistoryGuard guard;
    return QFileDialog::getExistingDirectory(parent, title);
}

QString askForSavePath(QWidget *parent, const QString &title, const QString &path,
                       const QString &filter) {
    const DialogHistoryGuard guard;
    return QFileDialog::getSaveFileName(parent, title, path, filter);
}

} // namespace pellucid::ui
