// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/settings/file_dialogs.h"

#include <array>

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHash>
#include <QLineEdit>
#include <QMimeData>
#include <QSettings>
#include <QToolButton>
#include <QUrl>
#include <QVariant>

#include "ui/language/shown_text.h"

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

// The folder of each purpose, until the program ends: folders may name patients.
QString &folderOf(const QString &purpose) {
    static QHash<QString, QString> folders;
    return folders[purpose];
}

void keepFolder(const QString &purpose, const QString &file) {
    if (!file.isEmpty())
        folderOf(purpose) = QFileInfo(file).absolutePath();
}

// Studies are opened and imported from the same places.
constexpr auto studies = "studies";

} // namespace

QStringList askForFiles(QWidget *parent, const QString &title) {
    const DialogHistoryGuard guard;
    const QStringList files = QFileDialog::getOpenFileNames(parent, title, folderOf(studies));
    keepFolder(studies, files.value(0));
    return files;
}

QString askForFile(QWidget *parent, const QString &title, const QString &filter) {
    const DialogHistoryGuard guard;
    const QString file = QFileDialog::getOpenFileName(parent, title, folderOf(filter), filter);
    keepFolder(filter, file);
    return file;
}

QString askForFolder(QWidget *parent, const QString &title) {
    const DialogHistoryGuard guard;
    const QString folder = QFileDialog::getExistingDirectory(parent, title, folderOf(studies));
    keepFolder(studies, folder);
    return folder;
}

QString askForSavePath(QWidget *parent, const QString &title, const QString &path,
                       const QString &filter) {
    const DialogHistoryGuard guard;
    const bool hasFolder = QFileInfo(path).isAbsolute() || folderOf(filter).isEmpty();
    const QString file = QFileDialog::getSaveFileName(
        parent, title, hasFolder ? path : QDir(folderOf(filter)).filePath(path), filter);
    keepFolder(filter, file);
    return file;
}

QStringList localPaths(const QMimeData &data) {
    QStringList paths;
    for (const QUrl &url : data.urls())
        if (url.isLocalFile())
            paths << url.toLocalFile();
    return paths;
}

QLineEdit *addFileRow(QFormLayout &form, const QString &label, const char *name,
                      const QString &tip) {
    auto *edit = new QLineEdit;
    edit->setObjectName(name);
    edit->setToolTip(plainToolTip(tip));
    auto *choose = new QToolButton;
    choose->setText("...");
    choose->setToolTip(plainToolTip(tip));
    QObject::connect(choose, &QToolButton::clicked, edit, [edit, label] {
        const QStringList chosen = askForFiles(edit, label);
        if (!chosen.isEmpty())
            edit->setText(QDir::toNativeSeparators(chosen.front()));
    });
    auto *row = new QWidget;
    auto *layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(edit, 1);
    layout->addWidget(choose);
    form.addRow(label, row);
    return edit;
}

} // namespace pellucid::ui
