// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/class_group.h"

#include <utility>

#include <QHBoxLayout>
#include <QMouseEvent>
#include <QPainter>
#include <QToolButton>

#include "ui/language/shown_text.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

// A dot: filled if all classes of the group are shown, half if some are.
QIcon groupIcon(const QColor &color, int shownCount, int count) {
    constexpr int side = 32; // shown at half the size, so that it is sharp at 200 %
    QPixmap pixmap(side, side);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(color, 3.0));
    const QRectF circle(5, 5, side - 10, side - 10);
    painter.drawEllipse(circle);
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    constexpr int half = 180 * 16; // QPainter's unit is a sixteenth of a degree
    if (shownCount == count)
        painter.drawEllipse(circle);
    else if (shownCount > 0)
        painter.drawPie(circle, half / 2, half);
    return QIcon(pixmap);
}

} // namespace

ClassGroup::ClassGroup(const QString &title, std::filesystem::path path, QWidget *parent)
    : QWidget(parent), m_title(shownText(title)), m_path(std::move(path)), m_fold(new QToolButton),
      m_eye(new QToolButton), m_name(new PlainLabel) {
    setObjectName("classGroup");
    m_fold->setObjectName("classGroupFold");
    m_fold->setProperty("role", "bare");
    m_eye->setObjectName("classGroupEye");
    m_eye->setProperty("role", "bare");
    m_eye->setIconSize({16, 16});
    m_eye->setToolTip(tr("Show or hide all classes of this group that the list shows"));
    m_eye->setAccessibleName(tr("Show %1").arg(m_title));
    m_name->setObjectName("classGroupName");
    m_name->setProperty("role", "muted");
    m_name->setMinimumWidth(20);
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 6, 2, 0);
    row->setSpacing(4);
    row->addWidget(m_fold);
    row->addWidget(m_eye);
    row->addWidget(m_name, 1);
    connect(m_fold, &QToolButton::clicked, this, [this] {
        m_isFolded = !m_isFolded;
        showFold();
        emit folded();
    });
    connect(m_eye, &QToolButton::clicked, this, [this] { emit toggled(); });
    showFold();
}

void ClassGroup::showFold() {
    m_fold->setArrowType(m_isFolded ? Qt::RightArrow : Qt::DownArrow);
    const QString text = m_isFolded ? tr("Unfold %1").arg(m_title) : tr("Fold %1").arg(m_title);
    m_fold->setAccessibleName(text);
    m_fold->setToolTip(plainToolTip(text));
}

void ClassGroup::showCounts(int shownCount, int count) {
    m_shownCount = shownCount;
    m_count = count;
    m_eye->setIcon(groupIcon(palette().color(QPalette::WindowText), shownCount, count));
    m_name->setText(
        tr("%1: %2 of %3").arg(m_title, QString::number(shownCount), QString::number(count)));
    m_name->setToolTip(plainToolTip(m_name->text()));
}

void ClassGroup::changeEvent(QEvent *event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) // the icon has a color of the theme
        showCounts(m_shownCount, m_count);
}

void ClassGroup::mousePressEvent(QMouseEvent *event) {
    m_fold->click();
    event->accept();
}

} // namespace pellucid::ui
