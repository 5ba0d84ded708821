// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/value_slider.h"

#include <cmath>

#include <QDoubleSpinBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QSlider>

#include "ui/language/shown_text.h"

namespace pellucid::ui {

namespace {

constexpr double perStep = 0.01;

} // namespace

ValueSlider::ValueSlider(const Range &range, const QString &sliderName, const QString &valueName,
                         QWidget *parent)
    : QWidget(parent), m_range(range), m_slider(new QSlider(Qt::Horizontal)),
      m_value(new QDoubleSpinBox) {
    const int steps = int(std::lround(range.largest / perStep));
    m_slider->setObjectName(sliderName);
    m_slider->setRange(0, steps);
    m_slider->setPageStep(steps / 20);
    m_slider->installEventFilter(this);
    m_value->setObjectName(valueName);
    m_value->setRange(0.0, range.largest);
    m_value->setDecimals(2);
    m_value->setKeyboardTracking(false); // apply only complete input
    m_value->setSingleStep(0.05);
    m_value->setButtonSymbols(QAbstractSpinBox::NoButtons);
    m_value->setFixedWidth(44);
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(6);
    row->addWidget(m_slider, 1);
    row->addWidget(m_value);

    connect(m_slider, &QSlider::sliderPressed, this, [this] {
        m_drag = nextDragId();
        emit pressed();
    });
    connect(m_slider, &QSlider::sliderReleased, this, [this] { m_drag = noDrag; });
    connect(m_slider, &QSlider::valueChanged, this,
            [this](int value) { emit changed(value * perStep, m_drag); });
    connect(m_value, &QDoubleSpinBox::valueChanged, this,
            [this](double value) { emit changed(value, noDrag); });
}

void ValueSlider::setValue(double value) {
    const QSignalBlocker noSlider(m_slider), noValue(m_value);
    // Do not move a slider while it is dragged.
    if (!m_slider->isSliderDown())
        m_slider->setValue(int(std::lround(value / perStep)));
    m_value->setValue(value);
}

void ValueSlider::setNames(const QString &accessibleName, const QString &tip) {
    m_slider->setAccessibleName(accessibleName);
    m_value->setAccessibleName(accessibleName);
    m_slider->setToolTip(plainToolTip(tip));
    m_value->setToolTip(plainToolTip(tip));
}

bool ValueSlider::eventFilter(QObject *watched, QEvent *event) {
    if (watched == m_slider && event->type() == QEvent::MouseButtonDblClick) {
        if (m_range.initial)
            emit changed(*m_range.initial, noDrag);
        else
            emit automaticRequested();
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace pellucid::ui
