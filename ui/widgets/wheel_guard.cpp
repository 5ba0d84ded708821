// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/wheel_guard.h"

#include <QAbstractScrollArea>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDockWidget>
#include <QEvent>
#include <QScrollBar>

namespace pellucid::ui {

namespace {

bool isInPanel(const QWidget *widget) {
    for (const QWidget *above = widget->parentWidget(); above != nullptr;
         above = above->parentWidget())
        if (qobject_cast<const QAbstractScrollArea *>(above) != nullptr ||
            qobject_cast<const QDockWidget *>(above) != nullptr)
            return true;
    return false;
}

} // namespace

bool WheelGuard::eventFilter(QObject *watched, QEvent *event) {
    if (event->type() != QEvent::Wheel && event->type() != QEvent::Polish)
        return false;
    const bool isGuarded = qobject_cast<QComboBox *>(watched) != nullptr ||
                           qobject_cast<QAbstractSpinBox *>(watched) != nullptr ||
                           (qobject_cast<QAbstractSlider *>(watched) != nullptr &&
                            qobject_cast<QScrollBar *>(watched) == nullptr);
    auto *widget = static_cast<QWidget *>(watched);
    if (!isGuarded || !isInPanel(widget))
        return false;
    if (event->type() == QEvent::Polish) {
        if (widget->focusPolicy() == Qt::WheelFocus)
            widget->setFocusPolicy(Qt::StrongFocus);
        return false;
    }
    if (widget->hasFocus())
        return false;
    event->ignore(); // so that it propagates to the scroll area
    return true;
}

} // namespace pellucid::ui
