// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/settings/file_dialogs.h"

#include <array>

#include <QFileDialog>
#include <QSettings>
#include <QVariant>

namespace pellucid::ui {

namespace {

// What the dialogs write down when they go is as it was before them.
class WithoutTrace {
public:
    WithoutTrace() {
        for (std::size_t n = 0; n < keys.size(); ++n)
            m_before[n] = m_ofQt.value(keys[n]);
    }
    ~WithoutTrace() {
        m_ofQt.sync();
        for (std::size_t n = 0; n < keys.size(); ++n)
            if (m_before[n].isValid())
                m_ofQt.setValue(keys[n], m_before[n]);
            else
                m_ofQt.remove(keys[n]);
    }
    WithoutTrace(const WithoutTrace &) = delete;
    WithoutTrace &operator=(const WithoutTrace &) = delete;

private:
    static constexpr std::array keys{"FileDialog/history", "FileDialog/lastVisited"};
    QSettings m_ofQt{QSettings::UserScope, "QtProject"};
    std::array<QVariant, 2> m_before;
};

} // namespace

QStringList askForFiles(QWidget *parent, const QString &title) {
    const WithoutTrace none;
    return QFileDialog::getOpenFileNames(parent, title);
}

QString askForFile(QWidget *parent, const QString &title, const QString &filter) {
    const WithoutTrace none;
    return QFileDialog::getOpenFileName(parent, title, {}, filter);
}

QString askForFolder(QWidget *parent, const QString &title) {
    const WithoutTrace none;
    return QFileDialog::getExistingDirectory(parent, title);
}

QString askWhereToWrite(QWidget *parent, const QString &title, const QString &path,
                        const QString &filter) {
    const WithoutTrace none;
    return QFileDialog::getSaveFileName(parent, title, path, filter);
}

} // namespace pellucid::ui
