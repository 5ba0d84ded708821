// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/class_dialog.h"

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
#include "ui/document.h"

namespace pellucid::ui {

namespace {

QDoubleSpinBox *valueBox(const char *name, double value, double step) {
    auto *box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setRange(-1e9, 1e9);
    box->setDecimals(1);
    box->setSingleStep(step);
    box->setValue(value);
    return box;
}

QString stepHelp() {
    QString text;
    for (const auto &kind : classify::stepKinds()) {
        text += "<b>" + QString::fromStdString(kind.name) +
                "</b>: " + QString::fromStdString(kind.what);
        for (const auto &p : kind.parameters)
            text += QString(" (%1 = %2%3)")
                        .arg(QString::fromStdString(p.name))
                        .arg(p.usual)
                        .arg(p.unit.empty() ? QString() : " " + QString::fromStdString(p.unit));
        text += "<br>";
    }
    return text;
}

} // namespace

ClassDialog::ClassDialog(Document &document, const classify::TissueClass &tissue, QWidget *parent)
    : QDialog(parent), m_document(document), m_tissue(tissue), m_name(new QLineEdit),
      m_step(new QLineEdit), m_color(new QPushButton), m_steps(new QListWidget),
      m_said(new QLabel) {
    setObjectName("classDialog");
    setWindowTitle(tr("Class"));
    setAttribute(Qt::WA_DeleteOnClose);
    // As fine as the values are: a hundredth of the window, a tenth of it for coarse values.
    const classify::FieldWindow window = document.fieldWindow();
    const double step = (window.high - window.low) / 200.0;
    m_name->setObjectName("classNameEdit");
    m_name->setText(QString::fromStdString(tissue.name));
    m_low = valueBox("classLowBox", tissue.low, step);
    m_high = valueBox("classHighBox", tissue.high, step);
    m_softness = valueBox("classSoftnessBox", tissue.softness, step);
    m_softness->setMinimum(0.0);
    m_softness->setToolTip(tr("Width over which the class fades in and out about its ends"));
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
    m_said->setObjectName("classSaid");
    m_said->setProperty("role", "warning");
    m_said->setWordWrap(true);

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
    form->addRow(tr("Colour"), m_color);
    form->addRow(tr("Steps"), m_steps);
    form->addRow(QString(), stepRow);
    form->addRow(m_said);
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

ClassDialog::~ClassDialog() {
    m_document.setTint(std::nullopt);
}

classify::TissueClass ClassDialog::tissue() const {
    classify::TissueClass typed = m_tissue;
    typed.name = m_name->text().trimmed().toStdString();
    typed.low = m_low->value();
    typed.high = m_high->value();
    typed.softness = m_softness->value();
    typed.steps.clear();
    for (int n = 0; n < m_steps->count(); ++n)
        typed.steps.push_back(classify::stepFromText(m_steps->item(n)->text().toStdString()));
    classify::validate(typed);
    return typed;
}

void ClassDialog::accept() {
    try {
        tissue();
        QDialog::accept();
    } catch (const task::Error &error) {
        m_said->setText(QString::fromStdString(error.reason()));
    }
}

void ClassDialog::addStep() {
    try {
        const auto step = classify::stepFromText(m_step->text().trimmed().toStdString());
        m_steps->addItem(QString::fromStdString(classify::stepText(step)));
        m_step->clear();
        m_said->clear();
    } catch (const task::Error &error) {
        m_said->setText(QString::fromStdString(error.reason()));
    }
}

void ClassDialog::chooseColor() {
    const classify::Color &c = m_tissue.color;
    const QColor chosen = QColorDialog::getColor(
        QColor::fromRgbF(float(c.red), float(c.green), float(c.blue)), this, tr("Colour"));
    if (!chosen.isValid())
        return;
    m_tissue.color = {chosen.redF(), chosen.greenF(), chosen.blueF()};
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
    m_document.setTint(shown);
}

} // namespace pellucid::ui
