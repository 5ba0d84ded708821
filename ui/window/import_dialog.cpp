// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/import_dialog.h"
#include "ui/settings/file_dialogs.h"

#include <QDialogButtonBox>
#include <QDir>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QSettings>
#include <QVBoxLayout>

namespace pellucid::ui {

namespace {

constexpr const char *copyKey = "library/copy";
constexpr int maxListedPaths = 6;

} // namespace

ImportDialog::ImportDialog(const QStringList &paths, QWidget *parent)
    : QDialog(parent), m_pathsLabel(new QLabel),
      m_refer(new QRadioButton(tr("&Reference the files in place"))),
      m_copy(new QRadioButton(tr("&Copy the files into the library"))) {
    setObjectName("importDialog");
    setWindowTitle(tr("Import into the library"));
    setAttribute(Qt::WA_DeleteOnClose);
    m_pathsLabel->setObjectName("importPaths");
    m_pathsLabel->setWordWrap(true);
    m_pathsLabel->setMinimumWidth(420);
    m_refer->setObjectName("referButton");
    m_refer->setToolTip(tr("Takes no space; the files must stay where they are"));
    m_copy->setObjectName("copyButton");
    m_copy->setToolTip(tr("For discs and removable drives; archives are always copied"));
    const bool copies = QSettings().value(copyKey, false).toBool();
    m_copy->setChecked(copies);
    m_refer->setChecked(!copies);
    auto *files = new QPushButton(tr("Add &files..."));
    files->setObjectName("importFilesButton");
    auto *folder = new QPushButton(tr("Add f&older..."));
    folder->setObjectName("importFolderButton");
    connect(files, &QPushButton::clicked, this,
            [this] { add(askForFiles(this, tr("Files to import"))); });
    connect(folder, &QPushButton::clicked, this, [this] {
        const QString chosen = askForFolder(this, tr("Folder to import"));
        if (!chosen.isEmpty())
            add({chosen});
    });
    auto *choose = new QHBoxLayout;
    choose->addWidget(files);
    choose->addWidget(folder);
    choose->addStretch(1);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    m_import = buttons->addButton(tr("Import"), QDialogButtonBox::AcceptRole);
    m_import->setObjectName("importNowButton");
    connect(buttons, &QDialogButtonBox::accepted, this, &ImportDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &ImportDialog::reject);
    auto *layout = new QVBoxLayout(this);
    layout->setSpacing(10);
    layout->addWidget(m_pathsLabel);
    layout->addLayout(choose);
    layout->addWidget(m_refer);
    layout->addWidget(m_copy);
    layout->addWidget(buttons);
    add(paths);
}

void ImportDialog::add(const QStringList &paths) {
    m_paths << paths;
    m_paths.removeDuplicates();
    m_import->setEnabled(!m_paths.isEmpty());
    if (m_paths.isEmpty()) {
        m_pathsLabel->setText(tr("Choose files, folders, a DICOMDIR or ZIP archives. Folders are "
                                 "searched recursively."));
        return;
    }
    QStringList shown;
    for (const QString &path : m_paths.mid(0, maxListedPaths))
        shown << QDir::toNativeSeparators(path);
    if (m_paths.size() > maxListedPaths)
        shown << tr("and %n more", "", int(m_paths.size()) - maxListedPaths);
    m_pathsLabel->setText(shown.join("\n"));
}

void ImportDialog::accept() {
    QSettings().setValue(copyKey, m_copy->isChecked());
    Import import;
    for (const QString &path : m_paths)
        import.paths.emplace_back(path.toStdString());
    import.mode = m_copy->isChecked() ? ImportMode::copy : ImportMode::refer;
    emit chosen(import);
    QDialog::accept();
}

} // namespace pellucid::ui
