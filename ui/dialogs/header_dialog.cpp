// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/header_dialog.h"

#include <algorithm>
#include <functional>
#include <vector>

#include <QApplication>
#include <QClipboard>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QShortcut>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "core/decoding/client/decoder.h"
#include "core/files/table_cell.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

enum Column { tagColumn, nameColumn, typeColumn, valueColumn, columnCount };

QString text(const std::string &utf8) {
    return shownText(QString::fromStdString(utf8));
}

} // namespace

HeaderDialog::HeaderDialog(const QStringList &files, int file, QWidget *parent)
    : QDialog(parent), m_files(files), m_number(new QSpinBox),
      m_slider(new QSlider(Qt::Horizontal)), m_search(new QLineEdit), m_name(new PlainLabel),
      m_message(new PlainLabel), m_tree(new QTreeWidget) {
    setObjectName("headerDialog");
    setWindowTitle(tr("DICOM header"));
    setAttribute(Qt::WA_DeleteOnClose);
    m_search->setObjectName("headerSearch");
    m_search->setPlaceholderText(tr("Search tags, names and values"));
    m_search->setAccessibleName(tr("Search the attributes"));
    m_search->setClearButtonEnabled(true);
    m_number->setObjectName("headerFileBox");
    m_number->setRange(1, int(files.size()));
    m_number->setSuffix(tr(" of %1").arg(files.size()));
    m_number->setAccessibleName(tr("Number of the file"));
    m_slider->setRange(1, int(files.size()));
    m_slider->setAccessibleName(tr("Number of the file"));
    m_name->setProperty("role", "muted");
    m_name->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_message->setObjectName("headerMessage");
    m_message->setWordWrap(true);
    m_message->hide();
    m_tree->setObjectName("headerTree");
    m_tree->setAccessibleName(tr("Attributes"));
    m_tree->setColumnCount(columnCount);
    m_tree->setHeaderLabels({tr("Tag"), tr("Name"), tr("Type"), tr("Value")});
    m_tree->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_tree->setUniformRowHeights(true);
    m_tree->header()->resizeSection(tagColumn, 130);
    m_tree->header()->resizeSection(nameColumn, 230);
    m_tree->header()->resizeSection(typeColumn, 44);
    auto *copy = new QPushButton(tr("Copy"));
    copy->setObjectName("copyHeaderButton");
    copy->setToolTip(tr("Copy the selected attributes, or all that are listed (Ctrl+C)"));
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    buttons->addButton(copy, QDialogButtonBox::ActionRole);
    for (QAbstractButton *button : buttons->buttons())
        static_cast<QPushButton *>(button)->setAutoDefault(false);
    auto *row = new QHBoxLayout;
    row->addWidget(m_number);
    row->addWidget(m_slider, 1);
    auto *column = new QVBoxLayout(this);
    column->addLayout(row);
    column->addWidget(m_name);
    column->addWidget(m_search);
    column->addWidget(m_message);
    column->addWidget(m_tree, 1);
    column->addWidget(buttons);
    resize(760, 640);
    for (QWidget *widget : {static_cast<QWidget *>(m_number), static_cast<QWidget *>(m_slider)})
        widget->setVisible(files.size() > 1);
    connect(m_number, &QSpinBox::valueChanged, this, [this](int number) { showFile(number - 1); });
    connect(m_slider, &QSlider::valueChanged, this, [this](int number) { showFile(number - 1); });
    connect(m_search, &QLineEdit::textChanged, this, &HeaderDialog::search);
    connect(copy, &QPushButton::clicked, this, &HeaderDialog::copySelected);
    auto *key = new QShortcut(QKeySequence::Copy, m_tree);
    key->setContext(Qt::WidgetWithChildrenShortcut);
    connect(key, &QShortcut::activated, this, &HeaderDialog::copySelected);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    showFile(std::clamp(file, 0, int(files.size()) - 1));
    m_search->setFocus();
}

HeaderDialog::~HeaderDialog() = default;

void HeaderDialog::showFile(int file) {
    const QSignalBlocker noNumber(m_number), noSlider(m_slider);
    m_number->setValue(file + 1);
    m_slider->setValue(file + 1);
    const QString path = m_files.at(file);
    m_name->setText(shownText(QFileInfo(path).fileName()));
    m_name->setToolTip(plainToolTip(path));
    m_jobs.start(
        tr("Reading %1").arg(QFileInfo(path).fileName()),
        [this, path](const Job &job) {
            const decoding::AttributeList list =
                decoding::Decoder::shared().attributes(path.toStdString(), job.progress());
            job.deliver([this, list] { fill(list); });
        },
        [this](const Outcome &outcome) {
            if (outcome.kind != Outcome::Kind::failed)
                return;
            m_tree->clear();
            m_message->setText(translated(*outcome.reason));
            m_message->show();
        },
        path);
}

void HeaderDialog::fill(const decoding::AttributeList &list) {
    m_warning = list.isComplete ? QString()
                                : tr("The list is not complete: the file has more attributes, or "
                                     "the rest of it is damaged.");
    // The same attribute stays in view from file to file.
    const int scrolled = m_tree->verticalScrollBar()->value();
    m_tree->setUpdatesEnabled(false);
    m_tree->clear();
    std::vector<QTreeWidgetItem *> parents; // by depth
    QList<QTreeWidgetItem *> top;
    for (const decoding::Attribute &attribute : list.attributes) {
        const bool isItem = attribute.tag == 0;
        auto *row = new QTreeWidgetItem;
        row->setText(tagColumn, text(tagText(attribute)));
        row->setText(nameColumn,
                     isItem ? tr("Item %1").arg(text(attribute.name)) : text(attribute.name));
        row->setText(typeColumn, text(attribute.vr));
        row->setText(valueColumn, text(attribute.value));
        row->setToolTip(valueColumn, plainToolTip(QString::fromStdString(attribute.value)));
        parents.resize(std::size_t(attribute.depth));
        if (parents.empty())
            top << row;
        else
            parents.back()->addChild(row);
        parents.push_back(row);
    }
    m_tree->addTopLevelItems(top);
    search();
    m_tree->verticalScrollBar()->setValue(scrolled);
    m_tree->setUpdatesEnabled(true);
}

// A row stays if it or anything inside it is found; everything inside a found sequence stays.
void HeaderDialog::search() {
    const QStringList words = m_search->text().simplified().split(' ', Qt::SkipEmptyParts);
    const auto isFound = [&](const QTreeWidgetItem &row) {
        return std::all_of(words.begin(), words.end(), [&](const QString &word) {
            for (const int column : {tagColumn, nameColumn, valueColumn})
                if (row.text(column).contains(word, Qt::CaseInsensitive))
                    return true;
            return false;
        });
    };
    int shown = 0;
    const std::function<bool(QTreeWidgetItem &, bool)> show = [&](QTreeWidgetItem &row,
                                                                  bool isInside) {
        const bool isKept = isInside || isFound(row);
        bool hasKept = false;
        for (int n = 0; n < row.childCount(); ++n)
            hasKept = show(*row.child(n), isKept) || hasKept;
        row.setHidden(!isKept && !hasKept);
        row.setExpanded(!words.isEmpty() && hasKept && !isInside);
        shown += isKept || hasKept ? 1 : 0;
        return isKept || hasKept;
    };
    for (int n = 0; n < m_tree->topLevelItemCount(); ++n)
        show(*m_tree->topLevelItem(n), false);
    const bool isNothing = shown == 0 && m_tree->topLevelItemCount() > 0;
    m_message->setText(isNothing ? tr("Nothing found") : m_warning);
    m_message->setVisible(!m_message->text().isEmpty());
}

// Tabs separate columns, and spaces show the depth.
void HeaderDialog::copySelected() {
    const bool isAll = m_tree->selectedItems().isEmpty();
    QString text;
    const auto cell = [](const QString &value) {
        return QString::fromStdString(files::tabbedField(files::tableCell(value.toStdString())));
    };
    const std::function<void(const QTreeWidgetItem &, int)> add = [&](const QTreeWidgetItem &row,
                                                                      int depth) {
        if (!row.isHidden() && (isAll || row.isSelected()))
            text += QString(2 * depth, ' ') + row.text(tagColumn) + '\t' + row.text(typeColumn) +
                    '\t' + cell(row.text(nameColumn)) + '\t' + cell(row.text(valueColumn)) + '\n';
        for (int n = 0; n < row.childCount(); ++n)
            add(*row.child(n), depth + 1);
    };
    for (int n = 0; n < m_tree->topLevelItemCount(); ++n)
        add(*m_tree->topLevelItem(n), 0);
    QApplication::clipboard()->setText(text);
}

} // namespace pellucid::ui
