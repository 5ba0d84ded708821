// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace pellucid::ui {

/// Prevents the wheel from changing boxes and sliders while it scrolls their panel: they respond
/// only with keyboard focus, which the wheel does not give. Install it on the application.
class WheelGuard : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
};

} // namespace pellucid::ui
