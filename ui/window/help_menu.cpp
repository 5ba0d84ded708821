// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/help_menu.h"

#include <QCoreApplication>
#include <QDesktopServices>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QFile>
#include <QHeaderView>
#include <QLocale>
#include <QMenu>
#include <QPlainTextEdit>
#include <QTabWidget>
#include <QTreeWidget>
#include <QUrl>
#include <QVBoxLayout>

#include "core/files/reasons.h"
#include "ui/document/add_command.h"
#include "ui/language/plain_label.h"
#include "ui/window/libraries.h"
#include "ui/window/reasons.h"

namespace pellucid::ui {

namespace {

struct HelpMenuTexts {
    Q_DECLARE_TR_FUNCTIONS(HelpMenuTexts)
};

// The manual in the program's language, or in English, where the installer puts it.
QString manual() {
    const QDir folder(QCoreApplication::applicationDirPath() + "/../share/doc/pellucid/manual");
    const QString translated = QCoreApplication::translate("HelpMenuTexts", "manual.html",
                                                           "file name of the translated manual");
    return QDir::cleanPath(
        folder.filePath(folder.exists(translated) ? translated : QString("manual.html")));
}

QWidget *libraryTable() {
    auto *table = new QTreeWidget;
    table->setObjectName("aboutLibraries");
    table->setAccessibleName(HelpMenuTexts::tr("Libraries"));
    table->setHeaderLabels(
        {HelpMenuTexts::tr("Library"), HelpMenuTexts::tr("Version"), HelpMenuTexts::tr("License")});
    table->setRootIsDecorated(false);
    for (const ThirdParty &library : thirdParties)
        new QTreeWidgetItem(table, {library.name,
                                    QString(library.name) == "Qt" ? qVersion() : library.version,
                                    library.licence});
    table->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    return table;
}

QWidget *licence() {
    auto *text = new QPlainTextEdit;
    text->setReadOnly(true);
    text->setAccessibleName(HelpMenuTexts::tr("License"));
    QFile file(":/pellucid/LICENSE");
    if (file.open(QIODevice::ReadOnly))
        text->setPlainText(QString::fromUtf8(file.readAll()));
    return text;
}

void showAbout(QWidget &window) {
    auto *dialog = new QDialog(&window);
    dialog->setObjectName("aboutDialog");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(HelpMenuTexts::tr("About Pellucid"));
    auto *name = new PlainLabel("Pellucid " + QCoreApplication::applicationVersion());
    name->setProperty("role", "title");
    auto *what =
        new PlainLabel(HelpMenuTexts::tr("Projections of DICOM studies in the frequency domain."));
    auto *warning = new PlainLabel(HelpMenuTexts::tr("Not for diagnostic use."));
    warning->setObjectName("aboutWarning");
    warning->setProperty("role", "warning");
    auto *terms = new PlainLabel(
        HelpMenuTexts::tr("Free software under the GNU General Public License, version 3 "
                          "or later; without any warranty."));
    terms->setWordWrap(true);
    auto *tabs = new QTabWidget;
    tabs->addTab(libraryTable(), HelpMenuTexts::tr("Libraries"));
    tabs->addTab(licence(), HelpMenuTexts::tr("License"));
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::close);
    auto *layout = new QVBoxLayout(dialog);
    for (QWidget *part : std::initializer_list<QWidget *>{name, what, warning, terms})
        layout->addWidget(part);
    layout->addWidget(tabs, 1);
    layout->addWidget(buttons);
    dialog->resize(560, 560);
    dialog->show();
}

} // namespace

void addHelpMenu(QMenu &menu, QWidget &window,
                 const std::function<void(const task::Reason &, const QString &)> &failed) {
    addCommand(menu, HelpMenuTexts::tr("&Manual"), "manualAction", QKeySequence("F1"), &menu,
               [failed] {
                   const QString page = manual();
                   if (!QFile::exists(page))
                       failed(task::because::doesNotExist, page);
                   else if (!QDesktopServices::openUrl(QUrl::fromLocalFile(page)))
                       failed(task::because::noBrowserForTheManual, page);
               });
    addCommand(menu, HelpMenuTexts::tr("&About Pellucid"), "aboutAction", {}, &menu,
               [&window] { showAbout(window); });
}

} // namespace pellucid::ui
