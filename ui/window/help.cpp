// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/help.h"

#include <QCoreApplication>
#include <QDesktopServices>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QFile>
#include <QHeaderView>
#include <QLocale>
#include <QPlainTextEdit>
#include <QTabWidget>
#include <QTreeWidget>
#include <QUrl>
#include <QVBoxLayout>

#include "ui/document/notices.h"
#include "ui/widgets/plain_label.h"
#include "ui/window/libraries.h"
#include "ui/window/reasons.h"

namespace pellucid::ui {

namespace {

struct HelpTexts {
    Q_DECLARE_TR_FUNCTIONS(HelpTexts)
};

// The manual in the program's language, or in English, where the installer puts it.
QString manual() {
    const QDir folder(QCoreApplication::applicationDirPath() + "/../share/doc/pellucid/manual");
    const QString translated = QCoreApplication::translate("HelpTexts", "manual.html",
                                                           "file name of the translated manual");
    return QDir::cleanPath(
        folder.filePath(folder.exists(translated) ? translated : QString("manual.html")));
}

QWidget *libraryTable() {
    auto *table = new QTreeWidget;
    table->setObjectName("aboutLibraries");
    table->setAccessibleName(HelpTexts::tr("Libraries"));
    table->setHeaderLabels(
        {HelpTexts::tr("Library"), HelpTexts::tr("Version"), HelpTexts::tr("License")});
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
    text->setAccessibleName(HelpTexts::tr("License"));
    QFile file(":/pellucid/LICENSE");
    if (file.open(QIODevice::ReadOnly))
        text->setPlainText(QString::fromUtf8(file.readAll()));
    return text;
}

} // namespace

void openManual(Notices &notices) {
    const QString page = manual();
    if (!QFile::exists(page))
        notices.report(task::because::manualIsNotInstalled, page);
    else if (!QDesktopServices::openUrl(QUrl::fromLocalFile(page)))
        notices.report(task::because::noBrowserForTheManual, page);
}

void showAbout(QWidget &window) {
    auto *dialog = new QDialog(&window);
    dialog->setObjectName("aboutDialog");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(HelpTexts::tr("About Pellucid"));
    auto *name = new PlainLabel("Pellucid " + QCoreApplication::applicationVersion());
    name->setProperty("role", "title");
    auto *what =
        new PlainLabel(HelpTexts::tr("Projections of DICOM studies in the frequency domain."));
    auto *warning = new PlainLabel(HelpTexts::tr("Not for diagnostic use."));
    warning->setObjectName("aboutWarning");
    warning->setProperty("role", "warning");
    auto *terms = new PlainLabel(
        HelpTexts::tr("Free software under the GNU General Public License, version 3 "
                      "or later; without any warranty."));
    terms->setWordWrap(true);
    auto *tabs = new QTabWidget;
    tabs->addTab(libraryTable(), HelpTexts::tr("Libraries"));
    tabs->addTab(licence(), HelpTexts::tr("License"));
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

} // namespace pellucid::ui
