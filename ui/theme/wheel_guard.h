// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace pellucid::ui {

/// Keeps the wheel from changing the boxes and sliders of a panel while the panel scrolls under the
/// pointer: they follow the wheel once they have the keyboard's focus, which the wheel does not
/// give. To be installed on the application.
class WheelGuard : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
};

} // namespace pellucid::ui
