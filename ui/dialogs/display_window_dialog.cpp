// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/display_window_dialog.h"

#include <algorithm>
#include <utility>

#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>

#include "ui/document/document.h"
#include "ui/language/names.h"
#include "ui/language/number_text.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

enum Column { nameColumn, widthColumn, centerColumn, unitColumn };

constexpr double maxValue = 1e9, minWidth = 1e-6;

QDoubleSpinBox *numberBox(const char *name, double low) {
    auto *box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setRange(low, maxValue);
    box->setKeyboardTracking(false);
    box->setAlignment(Qt::AlignRight);
    return box;
}

} // namespace

DisplayWindowDialog::DisplayWindowDialog(Document &document, QWidget *parent)
    : QDialog(parent), m_document(document), m_width(numberBox("windowWidthBox", minWidth)),
      m_center(numberBox("windowCenterBox", -maxValue)), m_table(new QTableWidget(0, 4)),
      m_add(new QPushButton(tr("Add the current window"))), m_remove(new QPushButton(tr("Remove"))),
      m_up(new QPushButton(tr("Up"))), m_down(new QPushButton(tr("Down"))),
      m_presets(windowPresets()), m_drag(nextDragId()) {
    setObjectName("displayWindowDialog");
    setWindowTitle(tr("Display window"));
    setAttribute(Qt::WA_DeleteOnClose);
    m_table->setObjectName("windowPresetTable");
    m_table->setAccessibleName(tr("Window presets"));
    m_table->setHorizontalHeaderLabels({tr("Name"), tr("Width"), tr("Center"), tr("Unit")});
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    m_table->horizontalHeader()->setSectionResizeMode(nameColumn, QHeaderView::Stretch);
    m_add->setObjectName("addWindowPresetButton");
    m_remove->setObjectName("removeWindowPresetButton");
    m_up->setObjectName("windowPresetUpButton");
    m_down->setObjectName("windowPresetDownButton");
    auto *defaults = new QPushButton(tr("Restore defaults"));
    defaults->setObjectName("defaultWindowPresetsButton");
    auto *form = new QFormLayout;
    form->addRow(tr("Width"), m_width);
    form->addRow(tr("Center"), m_center);
    auto *hint =
        new PlainLabel(tr("The first eight presets of a unit are on the keys 1 to 8. Key 0 "
                          "sets the automatic window, key 9 the file's own."));
    hint->setProperty("role", "muted");
    hint->setWordWrap(true);
    auto *edits = new QHBoxLayout;
    for (QPushButton *button : {m_remove, m_up, m_down, defaults})
        edits->addWidget(button);
    edits->addStretch();
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    // Enter takes the number that was typed; it does not close the dialog.
    for (QPushButton *button :
         {m_add, m_remove, m_up, m_down, defaults, buttons->button(QDialogButtonBox::Close)})
        button->setAutoDefault(false);
    auto *column = new QVBoxLayout(this);
    column->addLayout(form);
    column->addWidget(m_add, 0, Qt::AlignLeft);
    column->addSpacing(8);
    column->addWidget(new PlainLabel(tr("Presets")));
    column->addWidget(m_table, 1);
    column->addLayout(edits);
    column->addWidget(hint);
    column->addWidget(buttons);
    resize(430, 520);
    for (QDoubleSpinBox *box : {m_width, m_center})
        connect(box, &QDoubleSpinBox::valueChanged, this, &DisplayWindowDialog::apply);
    connect(m_table, &QTableWidget::cellChanged, this, &DisplayWindowDialog::changeCell);
    connect(m_table, &QTableWidget::itemSelectionChanged, this, &DisplayWindowDialog::showButtons);
    connect(m_add, &QPushButton::clicked, this, &DisplayWindowDialog::addPreset);
    connect(m_remove, &QPushButton::clicked, this, &DisplayWindowDialog::removePreset);
    connect(m_up, &QPushButton::clicked, this, [this] { movePreset(-1); });
    connect(m_down, &QPushButton::clicked, this, [this] { movePreset(1); });
    connect(defaults, &QPushButton::clicked, this, [this] {
        m_presets = defaultWindowPresets();
        store(-1);
    });
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    document.whenever(Change::displayWindow, this, &DisplayWindowDialog::showWindow);
    showPresets(-1);
    showWindow();
    m_width->setFocus();
    m_width->selectAll();
}

DisplayWindowDialog::~DisplayWindowDialog() {
    // A box that loses the focus with the dialog reports what was typed.
    for (QDoubleSpinBox *box : {m_width, m_center})
        box->disconnect(this);
}

void DisplayWindowDialog::showWindow() {
    const bool isOpen = m_document.volume().has_value();
    const volume::ValueWindow &window = m_document.displayWindow();
    const QString suffix = isOpen ? unitSuffix(m_document.volume()->unit()) : QString();
    const std::pair<QDoubleSpinBox *, double> boxes[] = {{m_width, window.width},
                                                         {m_center, window.center}};
    for (const auto &[box, value] : boxes) {
        const QSignalBlocker quiet(box);
        box->setEnabled(isOpen);
        box->setSuffix(suffix);
        // Narrow windows need decimals.
        box->setDecimals(window.width >= 50.0 ? 0 : window.width >= 1.0 ? 2 : 6);
        box->setSingleStep(window.width >= 50.0 ? 10.0 : 0.1 * window.width);
        box->setValue(value);
    }
    showButtons();
}

void DisplayWindowDialog::apply() {
    if (!m_document.volume())
        return;
    volume::ValueWindow window = m_document.displayWindow();
    // A number that was not edited keeps the digits that the box does not show.
    const auto typed = [](const QDoubleSpinBox *box, double now) {
        return box->text() == box->textFromValue(now) + box->suffix() ? now : box->value();
    };
    window.width = std::max(minWidth, typed(m_width, window.width));
    window.center = typed(m_center, window.center);
    window.name.clear();
    m_document.undoStack()->push(new EditDisplayWindow(m_document, window, m_drag));
}

void DisplayWindowDialog::showPresets(int selected) {
    const QSignalBlocker quiet(m_table);
    m_table->setRowCount(int(m_presets.size()));
    for (int row = 0; row < m_table->rowCount(); ++row) {
        const WindowPreset &preset = m_presets[std::size_t(row)];
        const QString texts[] = {translatedName(preset.window.name),
                                 numberText(preset.window.width, 6),
                                 numberText(preset.window.center, 6), unitText(preset.unit)};
        for (int c = nameColumn; c <= unitColumn; ++c) {
            auto *item = new QTableWidgetItem(texts[c]);
            if (c != nameColumn)
                item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            if (c == unitColumn)
                item->setFlags(item->flags() & ~Qt::ItemIsEditable);
            m_table->setItem(row, c, item);
        }
    }
    m_table->clearSelection();
    if (selected >= 0)
        m_table->selectRow(selected);
    showButtons();
}

void DisplayWindowDialog::changeCell(int row, int column) {
    WindowPreset &preset = m_presets[std::size_t(row)];
    const QString text = m_table->item(row, column)->text().simplified();
    bool isNumber = false;
    const double number = locale().toDouble(text, &isNumber);
    const bool isInRange = isNumber && std::abs(number) <= maxValue;
    if (column == nameColumn && !text.isEmpty() &&
        text != translatedName(preset.window.name)) // a built-in name stays translatable
        preset.window.name = text.toStdString();
    else if (column == widthColumn && isInRange && number >= minWidth)
        preset.window.width = number;
    else if (column == centerColumn && isInRange)
        preset.window.center = number;
    store(row); // also restores a text that is no number
}

void DisplayWindowDialog::addPreset() {
    WindowPreset preset{m_document.displayWindow(), m_document.volume()->unit()};
    preset.window.isInverted = false;
    preset.window.name = tr("Window %1").arg(m_presets.size() + 1).toStdString();
    m_presets.push_back(preset);
    const int row = int(m_presets.size()) - 1;
    store(row);
    m_table->editItem(m_table->item(row, nameColumn));
}

void DisplayWindowDialog::removePreset() {
    const int row = m_table->currentRow();
    m_presets.erase(m_presets.begin() + row);
    store(std::min(row, int(m_presets.size()) - 1));
}

void DisplayWindowDialog::movePreset(int by) {
    const int row = m_table->currentRow();
    std::swap(m_presets[std::size_t(row)], m_presets[std::size_t(row + by)]);
    store(row + by);
}

void DisplayWindowDialog::store(int selected) {
    storeWindowPresets(m_presets);
    showPresets(selected);
    emit presetsChanged();
}

void DisplayWindowDialog::showButtons() {
    const auto rows = m_table->selectionModel()->selectedRows();
    const int row = rows.isEmpty() ? -1 : rows.front().row();
    m_remove->setEnabled(row >= 0);
    m_up->setEnabled(row > 0);
    m_down->setEnabled(row >= 0 && row + 1 < m_table->rowCount());
    m_add->setEnabled(m_document.volume() && m_presets.size() < maxWindowPresets &&
                      volume::isCalibrated(m_document.volume()->unit()));
    m_add->setToolTip(m_add->isEnabled() ? QString()
                                         : tr("Window presets work only for HU and SUV: other "
                                              "values are not comparable between studies"));
}

} // namespace pellucid::ui
