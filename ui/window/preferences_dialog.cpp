// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/preferences_dialog.h"

#include <algorithm>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTabWidget>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "ui/studies/search_words.h"

namespace pellucid::ui {

namespace {

QComboBox *box(const char *name, const std::vector<std::pair<QString, QVariant>> &entries,
               const QVariant &chosen) {
    auto *box = new QComboBox;
    box->setObjectName(name);
    for (const auto &[text, value] : entries)
        box->addItem(text, value);
    box->setCurrentIndex(std::max(0, box->findData(chosen)));
    return box;
}

QCheckBox *check(const char *name, const QString &text, const QString &tip, bool isOn) {
    auto *check = new QCheckBox(text);
    check->setObjectName(name);
    check->setToolTip(tip);
    check->setChecked(isOn);
    return check;
}

} // namespace

PreferencesDialog::PreferencesDialog(QWidget *window)
    : QDialog(window), m_entries(shortcutEntries(*window)) {
    setObjectName("preferencesDialog");
    setWindowTitle(tr("Preferences"));
    setAttribute(Qt::WA_DeleteOnClose);
    m_tabs = new QTabWidget;
    m_tabs->setObjectName("preferencesTabs");
    m_tabs->addTab(makeGeneral(), tr("General"));
    m_tabs->addTab(makeShortcuts(), tr("Keys"));
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    auto *layout = new QVBoxLayout(this);
    layout->addWidget(m_tabs);
    layout->addWidget(buttons);
    resize(640, 560);
}

PreferencesDialog::Place PreferencesDialog::place() const {
    const QWidget *const focus = focusWidget();
    return {saveGeometry(), m_tabs->currentIndex(), focus != nullptr ? focus->objectName() : "",
            m_filter->text()};
}

void PreferencesDialog::setPlace(const Place &place) {
    restoreGeometry(place.geometry);
    m_tabs->setCurrentIndex(place.tab);
    m_filter->setText(place.filter);
    if (auto *const focus = findChild<QWidget *>(place.focus); focus && !place.focus.isEmpty())
        focus->setFocus();
}

QWidget *PreferencesDialog::makeGeneral() {
    const Preferences now = Preferences::load();
    m_language = box("languageBox",
                     {{tr("As the system"), ""},
                      {"English", "en"},
                      {QString::fromUtf8("繁體中文"), "zh_TW"}}, // each in its own language
                     now.language);
    m_theme = box("themeBox", {{tr("Dark"), "dark"}, {tr("Light"), "light"}}, now.theme);
    m_toolBar = box("toolBarBox",
                    {{tr("Icons"), int(ToolBarStyle::icons)},
                     {tr("Words"), int(ToolBarStyle::words)},
                     {tr("Icons and words"), int(ToolBarStyle::both)}},
                    int(now.toolBar));
    m_remembers =
        check("remembersBox", tr("Remember studies that were opened"),
              tr("Their paths, and what was open last, on this computer"), now.remembersStudies);
    m_resumes = check("resumesBox", tr("Begin with what was open last"),
                      tr("Otherwise the first page offers it"), now.resumesAtStart);
    m_resumes->setEnabled(now.remembersStudies);
    m_title =
        check("patientTitleBox", tr("Patients' names in the window title and among recent studies"),
              tr("Titles are seen in task bars and by other programs. Otherwise paths that name "
                 "a patient are not remembered either"),
              now.showsPatient);
    auto *page = new QWidget;
    auto *form = new QFormLayout(page);
    form->setVerticalSpacing(10);
    form->addRow(tr("Language"), m_language);
    form->addRow(tr("Colours"), m_theme);
    form->addRow(tr("Tool bar"), m_toolBar);
    form->addRow(m_remembers);
    form->addRow(m_resumes);
    form->addRow(m_title);
    // The window is made anew for a language; the dialog is gone then.
    for (QComboBox *choice : {m_language, m_theme, m_toolBar})
        connect(choice, &QComboBox::activated, this, &PreferencesDialog::change,
                Qt::QueuedConnection);
    for (QCheckBox *choice : {m_remembers, m_resumes, m_title})
        connect(choice, &QCheckBox::toggled, this, &PreferencesDialog::change);
    return page;
}

void PreferencesDialog::change() {
    Preferences now;
    now.language = m_language->currentData().toString();
    now.theme = m_theme->currentData().toString();
    now.toolBar = ToolBarStyle(m_toolBar->currentData().toInt());
    now.remembersStudies = m_remembers->isChecked();
    now.resumesAtStart = m_resumes->isChecked();
    now.showsPatient = m_title->isChecked();
    m_resumes->setEnabled(now.remembersStudies);
    now.save();
    emit changed(now);
}

QWidget *PreferencesDialog::makeShortcuts() {
    m_filter = new QLineEdit;
    m_filter->setObjectName("shortcutFilter");
    m_filter->setPlaceholderText(tr("Search commands and keys"));
    m_filter->setClearButtonEnabled(true);
    m_commands = new QTreeWidget;
    m_commands->setObjectName("shortcutList");
    m_commands->setAccessibleName(tr("Commands and their keys"));
    m_commands->setHeaderLabels({tr("Command"), tr("Key")});
    m_commands->setRootIsDecorated(false);
    m_commands->setUniformRowHeights(true);
    m_commands->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_commands->header()->setStretchLastSection(false);
    m_commands->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    m_key = new QKeySequenceEdit;
    m_key->setObjectName("shortcutEdit");
    m_key->setAccessibleName(tr("Key of the chosen command"));
    auto *restore = new QPushButton(tr("Default"));
    restore->setObjectName("defaultKeyButton");
    auto *none = new QPushButton(tr("No key"));
    none->setObjectName("noKeyButton");
    auto *all = new QPushButton(tr("Restore all defaults"));
    all->setObjectName("defaultKeysButton");
    m_conflict = new QLabel;
    m_conflict->setObjectName("shortcutConflict");
    m_conflict->setProperty("role", "warning");
    m_conflict->setWordWrap(true);
    auto *row = new QHBoxLayout;
    row->addWidget(m_key, 1);
    row->addWidget(restore);
    row->addWidget(none);
    row->addWidget(all);
    auto *page = new QWidget;
    auto *layout = new QVBoxLayout(page);
    layout->addWidget(m_filter);
    layout->addWidget(m_commands, 1);
    layout->addLayout(row);
    layout->addWidget(m_conflict);
    connect(m_filter, &QLineEdit::textChanged, this, &PreferencesDialog::showShortcuts);
    connect(m_commands, &QTreeWidget::currentItemChanged, this, &PreferencesDialog::showChosenKey);
    connect(m_key, &QKeySequenceEdit::editingFinished, this, &PreferencesDialog::giveKey);
    connect(restore, &QPushButton::clicked, this, [this] {
        if (chosen() < 0)
            return;
        m_key->setKeySequence(m_entries[std::size_t(chosen())].defaultKey);
        giveKey();
    });
    connect(none, &QPushButton::clicked, this, [this] {
        m_key->clear();
        giveKey();
    });
    connect(all, &QPushButton::clicked, this, [this] {
        for (const ShortcutEntry &entry : m_entries)
            setShortcut(entry, entry.defaultKey);
        m_conflict->clear();
        showShortcuts();
    });
    showShortcuts();
    return page;
}

void PreferencesDialog::showShortcuts() {
    const int before = chosen();
    m_commands->clear();
    for (std::size_t n = 0; n < m_entries.size(); ++n) {
        const ShortcutEntry &entry = m_entries[n];
        const QString key = entry.action->shortcut().toString(QKeySequence::NativeText);
        if (!holdsWords(entry.text + "\n" + key, m_filter->text()))
            continue;
        auto *item = new QTreeWidgetItem(m_commands, {entry.text, key});
        item->setData(0, Qt::UserRole, int(n));
        if (entry.action->shortcut() != entry.defaultKey) {
            QFont changed = font();
            changed.setBold(true);
            item->setFont(1, changed);
        }
        if (int(n) == before)
            m_commands->setCurrentItem(item);
    }
}

int PreferencesDialog::chosen() const {
    const QTreeWidgetItem *const item = m_commands->currentItem();
    return item == nullptr ? -1 : item->data(0, Qt::UserRole).toInt();
}

void PreferencesDialog::showChosenKey() {
    m_key->setEnabled(chosen() >= 0);
    if (chosen() >= 0)
        m_key->setKeySequence(m_entries[std::size_t(chosen())].action->shortcut());
}

void PreferencesDialog::giveKey() {
    if (chosen() < 0)
        return;
    const ShortcutEntry &entry = m_entries[std::size_t(chosen())];
    const QKeySequence key = m_key->keySequence();
    m_conflict->clear();
    // Panes have these whatever a command is given.
    for (const char *const fixed : {"Q", "R", "Up", "Down", "Left", "Right", "Home", "End", "Esc"})
        if (key == QKeySequence(fixed)) {
            m_conflict->setText(tr("%1 belongs to the panes: choose another key")
                                    .arg(key.toString(QKeySequence::NativeText)));
            showChosenKey();
            return;
        }
    // A key runs one command: it is taken from the one that had it.
    for (const ShortcutEntry &other : m_entries)
        if (!key.isEmpty() && other.action != entry.action && other.action->shortcut() == key) {
            setShortcut(other, {});
            m_conflict->setText(tr("%1 was the key of \"%2\", which has none now")
                                    .arg(key.toString(QKeySequence::NativeText), other.text));
        }
    setShortcut(entry, key);
    showShortcuts();
}

} // namespace pellucid::ui
