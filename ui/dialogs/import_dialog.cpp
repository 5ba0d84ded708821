// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/import_dialog.h"

#include <QDialogButtonBox>
#include <QDir>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QListWidget>
#include <QPushButton>
#include <QRadioButton>
#include <QSettings>
#include <QVBoxLayout>

#include "ui/language/shown_text.h"
#include "ui/settings/file_dialogs.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

constexpr const char *copyKey = "library/copy";
constexpr int listHeight = 140;

} // namespace

ImportDialog::ImportDialog(const QStringList &paths, QWidget *parent)
    : QDialog(parent),
      m_hint(new PlainLabel(tr("Choose files, folders, a DICOMDIR or ZIP archives. "
                               "Folders are searched recursively."))),
      m_list(new QListWidget), m_remove(new QPushButton(tr("Remove"))),
      m_refer(new QRadioButton(tr("&Leave the files where they are"))),
      m_copy(new QRadioButton(tr("&Copy the files into the library"))) {
    setObjectName("importDialog");
    setWindowTitle(tr("Import into the library"));
    setAttribute(Qt::WA_DeleteOnClose);
    m_hint->setWordWrap(true);
    m_hint->setMinimumWidth(420);
    m_list->setObjectName("importPaths");
    m_list->setAccessibleName(tr("Files and folders to import"));
    m_list->setProperty("role", "plain");
    m_list->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_list->setTextElideMode(Qt::ElideMiddle);
    m_list->setFixedHeight(listHeight);
    m_remove->setObjectName("importRemoveButton");
    m_remove->setToolTip(tr("Remove the selected files and folders from the list (Del)"));
    m_list->installEventFilter(this);
    connect(m_remove, &QPushButton::clicked, this, &ImportDialog::removeSelected);
    connect(m_list, &QListWidget::itemSelectionChanged, this, &ImportDialog::showPaths);
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
    choose->addWidget(m_remove);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    m_import = buttons->addButton(tr("Import"), QDialogButtonBox::AcceptRole);
    m_import->setObjectName("importNowButton");
    connect(buttons, &QDialogButtonBox::accepted, this, &ImportDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &ImportDialog::reject);
    auto *layout = new QVBoxLayout(this);
    layout->setSpacing(10);
    layout->addWidget(m_hint);
    layout->addWidget(m_list);
    layout->addLayout(choose);
    layout->addWidget(m_refer);
    layout->addWidget(m_copy);
    layout->addWidget(buttons);
    add(paths);
}

void ImportDialog::add(const QStringList &paths) {
    for (const QString &path : paths)
        if (!m_paths.contains(path)) {
            m_paths << path;
            const QString text = QDir::toNativeSeparators(path);
            auto *item = new QListWidgetItem(shownText(text), m_list);
            item->setToolTip(plainToolTip(text));
        }
    showPaths();
}

bool ImportDialog::eventFilter(QObject *watched, QEvent *event) {
    const bool isRemoval = watched == m_list && event->type() == QEvent::KeyPress &&
                           static_cast<QKeyEvent *>(event)->key() == Qt::Key_Delete;
    if (isRemoval)
        removeSelected();
    return isRemoval || QDialog::eventFilter(watched, event);
}

void ImportDialog::removeSelected() {
    for (int row = m_list->count() - 1; row >= 0; --row)
        if (m_list->item(row)->isSelected()) {
            m_paths.removeAt(row);
            delete m_list->takeItem(row);
        }
    showPaths();
}

void ImportDialog::showPaths() {
    m_hint->setVisible(m_paths.isEmpty());
    m_list->setVisible(!m_paths.isEmpty());
    m_remove->setVisible(!m_paths.isEmpty());
    m_remove->setEnabled(!m_list->selectedItems().isEmpty());
    m_import->setEnabled(!m_paths.isEmpty());
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
