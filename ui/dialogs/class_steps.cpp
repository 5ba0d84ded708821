// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/class_steps.h"

#include <algorithm>
#include <utility>

#include <QFormLayout>
#include <QHBoxLayout>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "ui/language/names.h"
#include "ui/language/shown_text.h"
#include "ui/language/step_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/limit_box.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

using classify::Step;
using classify::StepDescription;
using classify::StepEffect;
using classify::StepInput;

constexpr int listHeight = 110;

bool changesValues(const Step &step) {
    return describe(step.kind).effect == StepEffect::values;
}

// Typical sizes of a parameter's values, for the decimals and steps of its box.
double scaleOf(const classify::StepParameter &parameter) {
    const double width = parameter.maximum - parameter.minimum;
    return width > 1e6 ? std::max(10.0 * parameter.defaultValue, 200.0) : std::min(width, 20.0);
}

} // namespace

ClassSteps::ClassSteps(const classify::TissueClass &tissue, const classify::Look &look,
                       QWidget *parent)
    : QWidget(parent), m_tissue(tissue), m_look(look), m_steps(tissue.steps),
      m_list(new QListWidget),
      m_remove(makeButton(tr("Remove"), "removeStepButton", tr("Remove the selected step"))),
      m_up(makeButton(tr("Up"), "stepUpButton", tr("Run the selected step earlier"))),
      m_down(makeButton(tr("Down"), "stepDownButton", tr("Run the selected step later"))) {
    m_list->setObjectName("classSteps");
    m_list->setAccessibleName(tr("Steps"));
    m_list->setFixedHeight(listHeight);
    m_list->setProperty("role", "plain");
    m_list->setWordWrap(true);
    QPushButton *const add =
        makeButton(tr("Add step"), "addStepButton", tr("Add a step after the others"));
    // Enter belongs to the dialog's own buttons.
    for (QPushButton *button : {m_remove, m_up, m_down, add})
        button->setAutoDefault(false);
    auto *menu = new QMenu(add);
    menu->setObjectName("stepMenu");
    menu->setToolTipsVisible(true);
    fillMenu(*menu);
    add->setMenu(menu);
    auto *buttons = new QHBoxLayout;
    buttons->addWidget(add);
    buttons->addStretch();
    for (QPushButton *const button : {m_up, m_down, m_remove})
        buttons->addWidget(button);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(m_list);
    column->addLayout(buttons);
    connect(m_list, &QListWidget::currentRowChanged, this, &ClassSteps::showNumbers);
    connect(m_remove, &QPushButton::clicked, this, &ClassSteps::remove);
    connect(m_up, &QPushButton::clicked, this, [this] { move(-1); });
    connect(m_down, &QPushButton::clicked, this, [this] { move(1); });
    list(m_steps.empty() ? -1 : 0);
}

// Strokes and cuts are drawn with their tools.
void ClassSteps::fillMenu(QMenu &menu) {
    bool wasValues = true;
    for (const StepDescription &kind : classify::stepDescriptions()) {
        if (kind.input == StepInput::strokes || kind.input == StepInput::cuts)
            continue;
        const bool isValues = kind.effect == StepEffect::values;
        if (wasValues && !isValues)
            menu.addSeparator();
        wasValues = isValues;
        if (kind.input != StepInput::otherClass) {
            QAction *const action =
                menu.addAction(stepName(kind.kind), this, [this, &kind] { add({kind.kind}); });
            action->setObjectName(QString("step_%1").arg(QString::fromStdString(kind.name)));
            continue;
        }
        QMenu *const others = menu.addMenu(stepName(kind.kind));
        others->setObjectName(QString("step_%1").arg(QString::fromStdString(kind.name)));
        for (const classify::TissueClass &other : m_look.classes) {
            if (other.name == m_tissue.name || dependsOn(m_look, other, m_tissue.name))
                continue;
            others->addAction(menuText(translatedName(other.name)), this,
                              [this, &kind, name = other.name] {
                                  Step step{kind.kind};
                                  step.operand.name = name;
                                  add(step);
                              });
        }
        others->setEnabled(!others->isEmpty());
    }
}

// Steps that change values come before those that find the region.
void ClassSteps::add(const Step &step) {
    const auto at = changesValues(step)
                        ? std::find_if_not(m_steps.begin(), m_steps.end(), changesValues)
                        : m_steps.end();
    const auto index = int(at - m_steps.begin());
    m_steps.insert(at, step);
    list(index);
    emit changed();
}

void ClassSteps::move(int by) {
    const int from = m_list->currentRow(), to = from + by;
    if (from < 0 || to < 0 || to >= int(m_steps.size()))
        return;
    std::swap(m_steps[std::size_t(from)], m_steps[std::size_t(to)]);
    list(to);
    emit changed();
}

void ClassSteps::remove() {
    const int row = m_list->currentRow();
    if (row < 0)
        return;
    m_steps.erase(m_steps.begin() + row);
    list(std::min(row, int(m_steps.size()) - 1));
    emit changed();
}

void ClassSteps::list(int selected) {
    {
        const QSignalBlocker quiet(m_list);
        m_list->clear();
        for (const Step &step : m_steps) {
            auto *const item = new QListWidgetItem(stepWords(step), m_list);
            item->setToolTip(plainToolTip(stepName(step.kind) + ": " + stepWords(step)));
        }
        m_list->setCurrentRow(selected);
    }
    showNumbers();
}

void ClassSteps::showNumbers() {
    delete std::exchange(m_numbers, nullptr);
    const int row = m_list->currentRow();
    const bool isChosen = row >= 0 && row < int(m_steps.size());
    const auto mayBe = [&](int other) {
        return isChosen && other >= 0 && other < int(m_steps.size()) &&
               changesValues(m_steps[std::size_t(row)]) ==
                   changesValues(m_steps[std::size_t(other)]);
    };
    m_remove->setEnabled(isChosen);
    m_up->setEnabled(mayBe(row - 1));
    m_down->setEnabled(mayBe(row + 1));
    if (!isChosen)
        return;
    m_numbers = new QWidget;
    auto *form = new QFormLayout(m_numbers);
    form->setContentsMargins(0, 0, 0, 0);
    const Step &step = m_steps[std::size_t(row)];
    for (const classify::StepParameter &parameter : describe(step.kind).parameters) {
        auto *box = new LimitBox("", parameter.minimum, parameter.maximum, scaleOf(parameter));
        box->setObjectName(QString("stepNumber_%1").arg(QString::fromStdString(parameter.name)));
        if (parameter.isInteger) {
            box->setDecimals(0);
            box->setSingleStep(1.0);
        }
        box->setNumber(step.at(parameter.name));
        auto *label = new PlainLabel(parameterText(parameter));
        label->setWordWrap(true);
        label->setBuddy(box);
        form->addRow(label, box);
        connect(box, &QDoubleSpinBox::valueChanged, this,
                [this, row, box, name = parameter.name, defaultValue = parameter.defaultValue] {
                    Step &edited = m_steps[std::size_t(row)];
                    if (const double value = box->exact(); value == defaultValue)
                        edited.parameters.erase(name);
                    else
                        edited.parameters[name] = value;
                    m_list->item(row)->setText(stepWords(edited));
                    emit changed();
                });
    }
    layout()->addWidget(m_numbers);
}

} // namespace pellucid::ui
