// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/class_dialog.h"

#include <algorithm>
#include <cmath>

#include <QColorDialog>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>

#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/language/reasons.h"

namespace pellucid::ui {

namespace {

// The decimals resolve a thousandth of the window.
QDoubleSpinBox *valueBox(const char *name, double value, double windowWidth) {
    auto *box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setRange(-1e9, 1e9);
    box->setDecimals(std::clamp(int(std::ceil(3.0 - std::log10(windowWidth))), 1, 9));
    box->setSingleStep(windowWidth / 200.0);
    box->setValue(value);
    return box;
}

QString stepHelp() {
    QString text;
    for (const auto &step : classify::stepDescriptions()) {
        text += "<b>" + QString::fromStdString(step.name) +
                "</b>: " + QString::fromStdString(step.text);
        for (const auto &p : step.parameters)
            text += QString(" (%1 = %2%3)")
                        .arg(QString::fromStdString(p.name))
                        .arg(p.defaultValue)
                        .arg(p.unit.empty() ? QString() : " " + QString::fromStdString(p.unit));
        text += "<br>";
    }
    return text;
}

} // namespace

ClassDialog::ClassDialog(Document &document, const classify::TissueClass &tissue, QWidget *parent)
    : QDialog(parent), m_document(document), m_tissue(tissue), m_name(new QLineEdit),
      m_step(new QLineEdit), m_color(new QPushButton), m_steps(new QListWidget),
      m_message(new QLabel) {
    setObjectName("classDialog");
    setWindowTitle(tr("Class"));
    setAttribute(Qt::WA_DeleteOnClose);
    const classify::FieldWindow window = document.fieldWindow();
    const double width = std::max(window.high - window.low, 1e-9);
    m_name->setObjectName("classNameEdit");
    m_name->setText(QString::fromStdString(tissue.name));
    m_low = valueBox("classLowBox", tissue.low, width);
    m_high = valueBox("classHighBox", tissue.high, width);
    m_softness = valueBox("classSoftnessBox", tissue.softness, width);
    m_softness->setMinimum(0.0);
    m_shownLow = m_low->value();
    m_shownHigh = m_high->value();
    m_shownSoftness = m_softness->value();
    m_softness->setToolTip(tr("Width of the soft edge at both ends of the range"));
    m_color->setObjectName("classColorButton");
    m_steps->setObjectName("classSteps");
    m_steps->setMaximumHeight(90);
    m_steps->setProperty("role", "plain");
    for (const classify::Step &one : tissue.steps)
        m_steps->addItem(QString::fromStdString(classify::stepText(one)));
    m_step->setObjectName("classStepEdit");
    m_step->setPlaceholderText(tr("a step, such as median(radius_mm=1.5)"));
    m_step->setToolTip(stepHelp());
    auto *add = new QPushButton(tr("Add"));
    add->setObjectName("addStepButton");
    add->setAutoDefault(false);
    auto *removal = new QPushButton(tr("Remove"));
    removal->setObjectName("removeStepButton");
    removal->setAutoDefault(false);
    m_color->setAutoDefault(false);
    m_message->setObjectName("classMessage");
    m_message->setProperty("role", "warning");
    m_message->setWordWrap(true);

    auto *stepRow = new QHBoxLayout;
    stepRow->addWidget(m_step, 1);
    stepRow->addWidget(add);
    stepRow->addWidget(removal);
    auto *form = new QFormLayout(this);
    const bool isHu =
        document.volume() && document.volume()->unit() == volume::ValueUnit::hounsfield;
    const QString unit = isHu ? tr(" HU") : QString();
    for (QDoubleSpinBox *box : {m_low, m_high, m_softness})
        box->setSuffix(unit);
    form->addRow(tr("Name"), m_name);
    form->addRow(tr("From"), m_low);
    form->addRow(tr("To"), m_high);
    form->addRow(tr("Softness"), m_softness);
    form->addRow(tr("Color"), m_color);
    form->addRow(tr("Steps"), m_steps);
    form->addRow(QString(), stepRow);
    form->addRow(m_message);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    form->addRow(buttons);

    connect(buttons, &QDialogButtonBox::accepted, this, &ClassDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &ClassDialog::reject);
    connect(add, &QPushButton::clicked, this, &ClassDialog::addStep);
    connect(m_step, &QLineEdit::returnPressed, this, &ClassDialog::addStep);
    connect(removal, &QPushButton::clicked, this, [this] { delete m_steps->currentItem(); });
    connect(m_color, &QPushButton::clicked, this, &ClassDialog::chooseColor);
    for (QDoubleSpinBox *box : {m_low, m_high, m_softness})
        connect(box, &QDoubleSpinBox::valueChanged, this, &ClassDialog::showTint);
    showColor();
    showTint();
}

void ClassDialog::done(int result) {
    m_document.setTint(std::nullopt);
    QDialog::done(result);
}

// A value that was not edited must not be rounded.
double ClassDialog::valueOf(const QDoubleSpinBox &box, double shown, double former) const {
    return box.value() == shown ? former : box.value();
}

classify::TissueClass ClassDialog::typed(const classify::TissueClass &now) const {
    classify::TissueClass tissue = now;
    tissue.name = m_name->text().trimmed().toStdString();
    tissue.low = valueOf(*m_low, m_shownLow, m_tissue.low);
    tissue.high = valueOf(*m_high, m_shownHigh, m_tissue.high);
    tissue.softness = valueOf(*m_softness, m_shownSoftness, m_tissue.softness);
    tissue.color = m_tissue.color;
    tissue.steps.clear();
    for (int n = 0; n < m_steps->count(); ++n)
        tissue.steps.push_back(classify::stepFromText(m_steps->item(n)->text().toStdString()));
    classify::validate(tissue);
    return tissue;
}

void ClassDialog::accept() {
    try {
        typed(m_tissue);
        QDialog::accept();
    } catch (const task::Error &error) {
        m_message->setText(translated(error.reason()));
    }
}

void ClassDialog::addStep() {
    try {
        const auto step = classify::stepFromText(m_step->text().trimmed().toStdString());
        m_steps->addItem(QString::fromStdString(classify::stepText(step)));
        m_step->clear();
        m_message->clear();
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
