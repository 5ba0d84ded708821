// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/class_row.h"

#include <QContextMenuEvent>
#include <QGridLayout>
#include <QPainter>
#include <QStyle>
#include <QToolButton>

#include "ui/language/names.h"
#include "ui/language/shown_text.h"
#include "ui/language/step_text.h"
#include "ui/widgets/plain_label.h"
#include "ui/widgets/value_slider.h"

namespace pellucid::ui {

namespace {

QColor colorOf(const classify::Color &color) {
    return QColor::fromRgbF(float(color.red), float(color.green), float(color.blue));
}

// Filled while the class is shown.
QIcon dotIcon(const QColor &color, bool isShown) {
    constexpr int side = 32; // shown at half the size, so that it is sharp at 200 %
    QPixmap pixmap(side, side);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    // A darker outline keeps a white dot visible on white.
    painter.setPen(isShown ? QPen(color.darker(150), 1.5) : QPen(color, 3.0));
    painter.setBrush(isShown ? QBrush(color) : QBrush(Qt::NoBrush));
    painter.drawEllipse(QRectF(5, 5, side - 10, side - 10));
    return QIcon(pixmap);
}

// The size of the segment, the range unless it contains every value, and the steps.
QString rangeText(const classify::TissueClass &tissue, const segment::Segment *segment) {
    QStringList parts;
    if (segment != nullptr)
        parts << ClassRow::tr("%1 ml").arg(segment->volumeMm3 / 1000.0, 0, 'f', 1);
    if (tissue.hasRange() || segment == nullptr)
        parts << sourceWords(tissue);
    for (const classify::Step &step : tissue.steps)
        parts << stepWords(step);
    return parts.join(", ");
}

} // namespace

ClassRow::ClassRow(int index, QWidget *parent)
    : QWidget(parent), m_index(index), m_dot(new QToolButton), m_name(new PlainLabel),
      m_range(new PlainLabel),
      m_weight(new ValueSlider({.largest = classify::TransferFunction::largestWeight},
                               QString("classSlider%1").arg(index),
                               QString("classWeight%1").arg(index))) {
    setObjectName(QString("classRow%1").arg(index));
    setAttribute(Qt::WA_StyledBackground);
    m_dot->setObjectName(QString("classEye%1").arg(index));
    m_dot->setToolTip(tr("Show or hide the class"));
    m_dot->setIconSize({16, 16});
    m_dot->setProperty("role", "bare");
    m_range->setObjectName("classRange");
    m_range->setProperty("role", "small");
    m_name->setMinimumWidth(20);
    m_range->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // cut to what there is
    m_weight->setFixedWidth(134);
    auto *grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    grid->setHorizontalSpacing(6);
    grid->setVerticalSpacing(0);
    grid->addWidget(m_dot, 0, 0, 2, 1);
    grid->addWidget(m_name, 0, 1);
    grid->addWidget(m_weight, 0, 2);
    grid->addWidget(m_range, 1, 1, 1, 2);
    grid->setColumnStretch(1, 1);

    connect(m_dot, &QToolButton::clicked, this, [this] { emit toggled(m_index); });
    connect(m_weight, &ValueSlider::pressed, this, [this] { emit chosen(m_index); });
    connect(m_weight, &ValueSlider::changed, this,
            [this](double weight, DragId drag) { emit weightChanged(m_index, weight, drag); });
}

void ClassRow::show(const classify::TissueClass &tissue, const segment::Segment *segment,
                    bool isSelected) {
    const QString name = translatedName(tissue.name);
    m_dot->setIcon(dotIcon(colorOf(tissue.color), tissue.weight > 0.0));
    m_dot->setAccessibleName(tr("Show %1").arg(name));
    m_weight->setNames(tr("Weight of %1").arg(name), tr("Weight; double-click sets it to 1"));
    m_name->setText(name);
    m_rangeText = rangeText(tissue, segment);
    m_range->setToolTip(plainToolTip(m_rangeText));
    cutRange();
    m_weight->setValue(tissue.weight);
    setProperty("selected", isSelected);
    style()->polish(this);
}

void ClassRow::cutRange() {
    m_range->setText(
        m_range->fontMetrics().elidedText(m_rangeText, Qt::ElideRight, m_range->width()));
}

void ClassRow::resizeEvent(QResizeEvent *event) {
    QWidget::resizeEvent(event);
    layout()->activate(); // the label has its width
    cutRange();
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
