// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/start_page.h"

#include <QDir>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/language/shown_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

QPushButton *button(const QString &text, const char *name, const QString &tip) {
    QPushButton *wide = makeButton(text, name, tip);
    wide->setMinimumWidth(260);
    return wide;
}

} // namespace

StartPage::StartPage(QWidget *parent)
    : QWidget(parent), m_resume(button({}, "resumeButton", {})), m_recent(new QVBoxLayout) {
    setPanelBackground(*this, "startPage");
    auto *title = new PlainLabel(tr("Open a study"));
    title->setProperty("role", "title");
    auto *hint =
        new PlainLabel(tr("Drop DICOM files, folders, a DICOMDIR, a ZIP archive or a volume "
                          "(NRRD, NIfTI, MetaImage) anywhere in this window."));
    hint->setProperty("role", "muted");
    hint->setWordWrap(true);
    hint->setAlignment(Qt::AlignCenter);
    auto *files =
        button(tr("Open files..."), "openFilesButton", tr("Choose DICOM or volume files (Ctrl+O)"));
    auto *folder = button(tr("Open folder..."), "openFolderButton",
                          tr("Choose a folder; it is searched recursively (Ctrl+Shift+O)"));
    auto *phantomTitle = new PlainLabel(tr("TRY A PHANTOM"));
    phantomTitle->setProperty("role", "heading");
    auto *head = button(tr("Head phantom"), "headPhantomButton",
                        tr("A built-in head: skull, brain, sinuses, teeth"));
    auto *chest = button(tr("Chest phantom"), "chestPhantomButton",
                         tr("A built-in chest: ribs, lungs, heart, spine"));
    auto *layout = new QVBoxLayout(this);
    layout->addStretch(2);
    const auto add = [layout](QWidget *widget, int spaceAbove) {
        layout->addSpacing(spaceAbove);
        layout->addWidget(widget, 0, Qt::AlignHCenter);
    };
    add(title, 0);
    layout->addWidget(hint); // wraps at the width of the page
    add(m_resume, 12);
    add(files, 12);
    add(folder, 0);
    add(phantomTitle, 16);
    add(head, 0);
    add(chest, 0);
    layout->addSpacing(16);
    layout->addLayout(m_recent);
    layout->addStretch(3);
    m_resume->hide();
    connect(m_resume, &QPushButton::clicked, this, &StartPage::resumeRequested);
    connect(files, &QPushButton::clicked, this, &StartPage::openFilesRequested);
    connect(folder, &QPushButton::clicked, this, &StartPage::openFolderRequested);
    connect(head, &QPushButton::clicked, this, [this] { emit phantomRequested("head"); });
    connect(chest, &QPushButton::clicked, this, [this] { emit phantomRequested("chest"); });
}

void StartPage::setOffersResuming(bool offers, bool hasEnded) {
    m_resume->setText(hasEnded ? tr("Continue where you left off")
                               : tr("Recover the last session"));
    m_resume->setToolTip(
        hasEnded ? tr("Reopens the last study as you left it")
                 : tr("Pellucid ended unexpectedly. Reopens the last study with its last look"));
    m_resume->setVisible(offers);
}

void StartPage::setRecent(const std::vector<Recent> &recent) {
    while (QLayoutItem *item = m_recent->takeAt(0)) {
        // This may run inside the button's own click: delete it later.
        item->widget()->hide();
        item->widget()->deleteLater();
        delete item;
    }
    if (recent.empty())
        return;
    auto *heading = new PlainLabel(tr("RECENT"));
    heading->setProperty("role", "heading");
    m_recent->addWidget(heading, 0, Qt::AlignHCenter);
    for (const Recent &one : recent) {
        auto *link = new QPushButton(menuText(one.text));
        link->setProperty("role", "link");
        link->setToolTip(plainToolTip(tr("Open %1").arg(one.text)));
        m_recent->addWidget(link, 0, Qt::AlignHCenter);
        connect(link, &QPushButton::clicked, this,
                [this, entry = one.entry] { emit recentRequested(entry); });
    }
}

} // namespace pellucid::ui
