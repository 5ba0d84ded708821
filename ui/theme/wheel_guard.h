// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace pellucid::ui {

/// Keeps the wheel from changing a box or slider that it only passes over while a panel scrolls:
/// they follow the wheel once they have the keyboard's focus, which the wheel does not give.
class WheelGuard : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
};

} // namespace pellucid::ui
