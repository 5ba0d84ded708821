// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/class_row.h"

#include <cmath>

#include <QContextMenuEvent>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QSlider>
#include <QStyle>
#include <QToolButton>

namespace pellucid::ui {

namespace {

constexpr int sliderSteps = 200; // of a weight of 2
constexpr double perStep = classify::TransferFunction::largestWeight / sliderSteps;

QColor colorOf(const classify::Color &color) {
    return QColor::fromRgbF(float(color.red), float(color.green), float(color.blue));
}

// Filled while the class is shown.
QIcon dotIcon(const QColor &color, bool isShown) {
    constexpr int side = 32; // drawn at half the size: sharp at 200 %
    QPixmap pixmap(side, side);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(color, 3.0));
    painter.setBrush(isShown ? QBrush(color) : QBrush(Qt::NoBrush));
    painter.drawEllipse(QRectF(5, 5, side - 10, side - 10));
    return QIcon(pixmap);
}

QString rangeText(const classify::TissueClass &tissue) {
    QString text = QString("%1 .. %2").arg(tissue.low, 0, 'g', 4).arg(tissue.high, 0, 'g', 5);
    for (const classify::Step &step : tissue.steps)
        text += ", " + QString::fromStdString(classify::stepText(step));
    return text;
}

} // namespace

ClassRow::ClassRow(int index, QWidget *parent)
    : QWidget(parent), m_index(index), m_dot(new QToolButton), m_name(new QLabel),
      m_range(new QLabel), m_slider(new QSlider(Qt::Horizontal)), m_weight(new QDoubleSpinBox) {
    setObjectName(QString("classRow%1").arg(index));
    setAttribute(Qt::WA_StyledBackground);
    m_dot->setObjectName(QString("classEye%1").arg(index));
    m_dot->setToolTip(tr("Show or hide the class"));
    m_dot->setIconSize({16, 16});
    m_dot->setProperty("role", "bare");
    m_range->setProperty("role", "small");
    m_name->setMinimumWidth(20);
    m_range->setMinimumWidth(20);
    m_slider->setObjectName(QString("classSlider%1").arg(index));
    m_slider->setToolTip(tr("Weight; double-click sets it to 1"));
    m_slider->setRange(0, sliderSteps);
    m_slider->setPageStep(sliderSteps / 20);
    m_slider->setFixedWidth(84);
    m_slider->installEventFilter(this);
    m_weight->setObjectName(QString("classWeight%1").arg(index));
    m_weight->setRange(0.0, classify::TransferFunction::largestWeight);
    m_weight->setDecimals(2);
    m_weight->setKeyboardTracking(false); // typed to the end before it counts
    m_weight->installEventFilter(this);
    m_weight->setSingleStep(0.05);
    m_weight->setButtonSymbols(QAbstractSpinBox::NoButtons);
    m_weight->setFixedWidth(44);
    auto *grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    grid->setHorizontalSpacing(6);
    grid->setVerticalSpacing(0);
    grid->addWidget(m_dot, 0, 0, 2, 1);
    grid->addWidget(m_name, 0, 1);
    grid->addWidget(m_range, 1, 1);
    grid->addWidget(m_slider, 0, 2, 2, 1);
    grid->addWidget(m_weight, 0, 3, 2, 1);
    grid->setColumnStretch(1, 1);

    connect(m_dot, &QToolButton::clicked, this, [this] { emit toggled(m_index); });
    connect(m_slider, &QSlider::sliderPressed, this, [this] {
        m_drag = nextDragId();
        emit chosen(m_index);
    });
    connect(m_slider, &QSlider::sliderReleased, this, [this] { m_drag = 0; });
    connect(m_slider, &QSlider::valueChanged, this,
            [this](int value) { emit weightChanged(m_index, value * perStep, m_drag); });
    connect(m_weight, &QDoubleSpinBox::valueChanged, this,
            [this](double weight) { emit weightChanged(m_index, weight, 0); });
}

void ClassRow::show(const classify::TissueClass &tissue, bool isSelected) {
    const QSignalBlocker noSlider(m_slider), noWeight(m_weight);
    const QString name = QString::fromStdString(tissue.name);
    m_dot->setIcon(dotIcon(colorOf(tissue.color), tissue.weight > 0.0));
    m_dot->setAccessibleName(tr("Show %1").arg(name));
    m_slider->setAccessibleName(tr("Weight of %1").arg(name));
    m_weight->setAccessibleName(tr("Weight of %1").arg(name));
    m_name->setText(name);
    m_range->setText(m_range->fontMetrics().elidedText(rangeText(tissue), Qt::ElideRight, 118));
    m_range->setToolTip(rangeText(tissue));
    // A slider in the hand is where the hand is.
    if (!m_slider->isSliderDown())
        m_slider->setValue(int(std::lround(tissue.weight / perStep)));
    m_weight->setValue(tissue.weight);
    setProperty("selected", isSelected);
    style()->polish(this);
}

bool ClassRow::eventFilter(QObject *watched, QEvent *event) {
    if (watched == m_slider && event->type() == QEvent::MouseButtonDblClick) {
        emit weightChanged(m_index, 1.0, 0);
        return true;
    }
    // Scrolling the table must not change weights on its way.
    if (event->type() == QEvent::Wheel && !static_cast<QWidget *>(watched)->hasFocus()) {
        event->ignore();
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

void ClassRow::mousePressEvent(QMouseEvent *event) {
    emit chosen(m_index);
    QWidget::mousePressEvent(event);
}

void ClassRow::mouseDoubleClickEvent(QMouseEvent *) {
    emit editRequested(m_index);
}

void ClassRow::contextMenuEvent(QContextMenuEvent *event) {
    emit menuRequested(m_index, event->globalPos());
}

} // namespace pellucid::ui
