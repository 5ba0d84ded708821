// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/class_dialog.h"

#include <algorithm>

#include <QColorDialog>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPushButton>

#include "core/task/error.h"
#include "ui/dialogs/class_steps.h"
#include "ui/document/document.h"
#include "ui/language/number_text.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/widgets/dialog_place.h"
#include "ui/widgets/limit_box.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

// The first items of the source box; segments follow.
enum SourceItem { ofValues, drawn };

} // namespace

ClassDialog::ClassDialog(Document &document, std::size_t index, QWidget *parent)
    : QDialog(parent), m_document(document), m_index(index),
      m_original(document.scene().look.classes[index]), m_tissue(m_original), m_name(new QLineEdit),
      m_source(new QComboBox), m_edge(new QDoubleSpinBox), m_color(new QPushButton),
      m_steps(new ClassSteps(m_original, document.scene().look)), m_message(new PlainLabel) {
    const classify::TissueClass &tissue = m_original;
    setObjectName("classDialog");
    setWindowTitle(tr("Class"));
    setAttribute(Qt::WA_DeleteOnClose);
    setMinimumWidth(420);
    m_name->setObjectName("classNameEdit");
    m_name->setText(QString::fromStdString(tissue.name));
    m_edge->setObjectName("classEdgeBox");
    m_edge->setRange(0.0, classify::softestEdge);
    m_edge->setSingleStep(0.25);
    m_edge->setSuffix(tr(" samples"));
    m_edge->setToolTip(tr("Smooths the edge of a region to avoid ringing"));
    m_edge->setValue(tissue.edge);
    m_color->setObjectName("classColorButton");
    m_color->setAutoDefault(false);
    m_message->setObjectName("classMessage");
    m_message->setProperty("role", "warning");
    m_message->setWordWrap(true);

    auto *form = new QFormLayout(this);
    form->addRow(tr("Name"), m_name);
    form->addRow(tr("Color"), m_color);
    addSource(*form);
    form->addRow(tr("Steps"), m_steps);
    form->addRow(tr("Soft edge"), m_edge);
    form->addRow(m_message);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    form->addRow(buttons);
    for (QAbstractButton *button : buttons->buttons())
        static_cast<QPushButton *>(button)->setAutoDefault(false);

    connect(buttons, &QDialogButtonBox::accepted, this, &ClassDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &ClassDialog::reject);
    connect(m_color, &QPushButton::clicked, this, &ClassDialog::chooseColor);
    connect(m_steps, &ClassSteps::changed, m_message, &PlainLabel::clear);
    for (QDoubleSpinBox *box : {m_low, m_high, m_softness})
        connect(box, &QDoubleSpinBox::valueChanged, this, &ClassDialog::showTint);
    showColor();
    showTint();
}

void ClassDialog::addSource(QFormLayout &form) {
    const classify::FieldWindow window = m_document.fieldWindow();
    const double width = window.high - window.low;
    m_low = new LimitBox("classLowBox", classify::lowestValue, classify::highestValue, width);
    m_high = new LimitBox("classHighBox", classify::lowestValue, classify::highestValue, width);
    m_softness = new LimitBox("classSoftnessBox", 0.0, classify::highestValue, width);
    m_low->setNumber(m_tissue.low);
    m_high->setNumber(m_tissue.high);
    m_softness->setNumber(m_tissue.softness);
    m_softness->setToolTip(tr("Width of the soft edge at both ends of the range"));
    m_source->setObjectName("classSourceBox");
    m_source->setToolTip(tr("What the class consists of before its steps"));
    m_source->addItem(tr("The values of the volume"));
    m_source->addItem(tr("Empty (add strokes or classes later)"));
    QStringList segments;
    if (m_document.segments())
        for (const segment::Segmentation &file : m_document.segments()->segmentations())
            for (const segment::Segment &segment : file.segments)
                segments << QString::fromStdString(segment.name);
    const QString own = QString::fromStdString(m_tissue.segment);
    if (!own.isEmpty() && !segments.contains(own))
        segments << own;
    for (const QString &name : segments)
        m_source->addItem(tr("Segment %1").arg(shownText(name)), name);
    m_source->setCurrentIndex(m_tissue.isDrawn ? drawn
                              : own.isEmpty()  ? ofValues
                                               : m_source->findData(own));
    if (m_document.volume())
        for (QDoubleSpinBox *box : {m_low, m_high, m_softness})
            box->setSuffix(unitSuffix(m_document.volume()->unit()));
    form.addRow(tr("Source"), m_source);
    form.addRow(tr("From"), m_low);
    form.addRow(tr("To"), m_high);
    form.addRow(tr("Softness"), m_softness);
}

// Enter takes what was typed; only the buttons close the dialog.
void ClassDialog::keyPressEvent(QKeyEvent *event) {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
        event->accept();
    else
        QDialog::keyPressEvent(event);
}

void ClassDialog::showEvent(QShowEvent *event) {
    QDialog::showEvent(event);
    if (!event->spontaneous())
        placeBeside(*this);
}

void ClassDialog::done(int result) {
    m_document.setTint(std::nullopt);
    QDialog::done(result);
}

classify::TissueClass ClassDialog::typed(const classify::TissueClass &now) const {
    classify::TissueClass tissue = now;
    tissue.name = m_name->text().trimmed().toStdString();
    tissue.low = m_low->exact();
    tissue.high = m_high->exact();
    tissue.softness = m_softness->exact();
    tissue.color = m_tissue.color;
    tissue.isDrawn = m_source->currentIndex() == drawn;
    tissue.segment = m_source->currentData().toString().toStdString();
    tissue.edge = m_edge->value();
    tissue.steps = m_steps->steps();
    classify::validate(tissue);
    return tissue;
}

void ClassDialog::accept() {
    try {
        classify::Look look = m_document.scene().look; // it may have changed meanwhile
        classify::replaceClass(look, m_index, typed(m_tissue));
        classify::validate(look);
        QDialog::accept();
    } catch (const task::Error &error) {
        m_message->setText(translated(error.reason()));
    }
}

void ClassDialog::chooseColor() {
    const classify::Color &c = m_tissue.color;
    const QColor chosen = QColorDialog::getColor(
        QColor::fromRgbF(float(c.red), float(c.green), float(c.blue)), this, tr("Color"));
    if (!chosen.isValid())
        return;
    m_tissue.color = classify::colorFromText(chosen.name().toStdString());
    showColor();
    showTint();
}

void ClassDialog::showColor() {
    const QString text = QString::fromStdString(classify::colorText(m_tissue.color));
    m_color->setText(text);
    m_color->setStyleSheet(QString("border-left: 16px solid %1;").arg(text));
}

void ClassDialog::showTint() {
    classify::TissueClass shown = m_tissue;
    shown.low = m_low->value();
    shown.high = m_high->value();
    shown.softness = m_softness->value();
    // The planes tint segments anyway; a range of all values would tint everything else, too.
    m_document.setTint(shown.hasRange() ? std::optional(shown) : std::nullopt);
}

} // namespace pellucid::ui
