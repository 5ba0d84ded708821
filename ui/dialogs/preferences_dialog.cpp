// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/preferences_dialog.h"

#include <algorithm>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeySequenceEdit>
#include <QLineEdit>
#include <QPushButton>
#include <QTabWidget>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "ui/language/shown_text.h"
#include "ui/studies/search_words.h"
#include "ui/widgets/plain_label.h"

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
    check->setToolTip(plainToolTip(tip));
    check->setChecked(isOn);
    return check;
}

} // namespace

PreferencesDialog::PreferencesDialog(ActionTable &actions, const QString &spoken, QWidget *window)
    : QDialog(window), m_actions(actions), m_spoken(spoken) {
    setObjectName("preferencesDialog");
    setWindowTitle(tr("Preferences"));
    setAttribute(Qt::WA_DeleteOnClose);
    auto *tabs = new QTabWidget;
    tabs->setObjectName("preferencesTabs");
    tabs->addTab(makeGeneral(), tr("General"));
    tabs->addTab(makeShortcuts(), tr("Keys"));
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    auto *layout = new QVBoxLayout(this);
    layout->addWidget(tabs);
    layout->addWidget(buttons);
    resize(640, 560);
}

QWidget *PreferencesDialog::makeGeneral() {
    const Preferences now = Preferences::load();
    m_language = box("languageBox",
                     {{tr("System default"), ""},
                      {"English", "en"},
                      {QString::fromUtf8("繁體中文"), "zh_TW"}}, // each in its own language
                     now.language);
    m_theme = box("themeBox", {{tr("Dark"), "dark"}, {tr("Light"), "light"}}, now.theme);
    m_toolBar = box("toolBarBox",
                    {{tr("Icons"), int(ToolBarStyle::icons)},
                     {tr("Text"), int(ToolBarStyle::words)},
                     {tr("Icons and text"), int(ToolBarStyle::both)}},
                    int(now.toolBar));
    m_remembers =
        check("remembersBox", tr("Remember opened studies"),
              tr("Stores their paths and the last session on this computer"), now.remembersStudies);
    m_resumes = check("resumesBox", tr("Reopen the last study at startup"),
                      tr("Otherwise, the start page offers it"), now.resumesAtStart);
    m_resumes->setEnabled(now.remembersStudies);
    m_title =
        check("patientTitleBox", tr("Show patient names in the window title and recent studies"),
              tr("Window titles are visible in task bars and to other programs. If this is off, "
                 "paths that name a patient are not remembered either"),
              now.showsPatient);
    auto *page = new QWidget;
    auto *form = new QFormLayout(page);
    form->setVerticalSpacing(10);
    auto *restart = new PlainLabel(tr("The language changes at the next start"));
    restart->setObjectName("languageNote");
    restart->setProperty("role", "muted");
    const auto tell = [this, restart] {
        restart->setVisible(m_language->currentData() != m_spoken);
    };
    connect(m_language, &QComboBox::activated, restart, tell);
    tell();
    form->addRow(tr("Language"), m_language);
    form->addRow(QString(), restart);
    form->addRow(tr("Theme"), m_theme);
    form->addRow(tr("Tool bar"), m_toolBar);
    form->addRow(m_remembers);
    form->addRow(m_resumes);
    form->addRow(m_title);
    for (QComboBox *choice : {m_language, m_theme, m_toolBar})
        connect(choice, &QComboBox::activated, this, &PreferencesDialog::change);
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
    m_key->setAccessibleName(tr("Key of the selected command"));
    auto *restore = new QPushButton(tr("Default"));
    restore->setObjectName("defaultKeyButton");
    auto *none = new QPushButton(tr("No key"));
    none->setObjectName("noKeyButton");
    auto *all = new QPushButton(tr("Restore all defaults"));
    all->setObjectName("defaultKeysButton");
    m_conflict = new PlainLabel;
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
    connect(m_key, &QKeySequenceEdit::editingFinished, this, &PreferencesDialog::assignKey);
    connect(restore, &QPushButton::clicked, this, [this] {
        if (chosen() == nullptr)
            return;
        m_key->setKeySequence(chosen()->defaultKey);
        assignKey();
    });
    connect(none, &QPushButton::clicked, this, [this] {
        m_key->clear();
        assignKey();
    });
    connect(all, &QPushButton::clicked, this, [this] {
        for (const ActionTable::Row *entry : m_actions.listed())
            m_actions.setKey(*entry, entry->defaultKey);
        m_conflict->clear();
        showShortcuts();
    });
    showShortcuts();
    return page;
}

void PreferencesDialog::showShortcuts() {
    const ActionTable::Row *const before = chosen();
    m_commands->clear();
    for (std::size_t n = 0; n < m_actions.listed().size(); ++n) {
        const ActionTable::Row &row = *m_actions.listed()[n];
        const QString key = row.action->shortcut().toString(QKeySequence::NativeText);
        if (!containsWords(row.path + "\n" + key, m_filter->text()))
            continue;
        auto *item = new QTreeWidgetItem(m_commands, {row.path, key});
        item->setData(0, Qt::UserRole, int(n));
        if (row.action->shortcut() != row.defaultKey) {
            QFont changed = font();
            changed.setBold(true);
            item->setFont(1, changed);
        }
        if (&row == before)
            m_commands->setCurrentItem(item);
    }
}

const ActionTable::Row *PreferencesDialog::chosen() const {
    const QTreeWidgetItem *const item = m_commands->currentItem();
    return item == nullptr ? nullptr : m_actions.listed()[item->data(0, Qt::UserRole).toUInt()];
}

void PreferencesDialog::showChosenKey() {
    m_key->setEnabled(chosen() != nullptr);
    if (chosen() != nullptr)
        m_key->setKeySequence(chosen()->action->shortcut());
}

void PreferencesDialog::assignKey() {
    if (chosen() == nullptr)
        return;
    const ActionTable::Row &entry = *chosen();
    const QKeySequence key = m_key->keySequence();
    m_conflict->clear();
    // The panes always use these keys.
    for (const char *const fixed : {"Q", "R", "Up", "Down", "Left", "Right", "Home", "End", "Esc"})
        if (key == QKeySequence(fixed)) {
            m_conflict->setText(tr("%1 is reserved for the panes; choose a different key")
                                    .arg(key.toString(QKeySequence::NativeText)));
            showChosenKey();
            return;
        }
    // A key runs only one action: take it from the action that has it.
    for (const ActionTable::Row *other : m_actions.listed())
        if (!key.isEmpty() && other != &entry && other->action->shortcut() == key) {
            m_actions.setKey(*other, {});
            m_conflict->setText(tr("%1 was taken from \"%2\", which now has no key")
                                    .arg(key.toString(QKeySequence::NativeText), other->path));
        }
    m_actions.setKey(entry, key);
    showShortcuts();
}

} // namespace pellucid::ui
