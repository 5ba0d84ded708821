// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme/wheel_guard.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QEvent>
#include <QScrollBar>

namespace pellucid::ui {

bool WheelGuard::eventFilter(QObject *watched, QEvent *event) {
    if (event->type() != QEvent::Wheel && event->type() != QEvent::Polish)
        return false;
    const bool isGuarded = qobject_cast<QComboBox *>(watched) != nullptr ||
                           qobject_cast<QAbstractSpinBox *>(watched) != nullptr ||
                           (qobject_cast<QAbstractSlider *>(watched) != nullptr &&
                            qobject_cast<QScrollBar *>(watched) == nullptr);
    if (!isGuarded)
        return false;
    auto *widget = static_cast<QWidget *>(watched);
    if (event->type() == QEvent::Polish) {
        if (widget->focusPolicy() == Qt::WheelFocus)
            widget->setFocusPolicy(Qt::StrongFocus);
        return false;
    }
    if (widget->hasFocus())
        return false;
    event->ignore(); // so that it goes on to what scrolls
    return true;
}

} // namespace pellucid::ui
