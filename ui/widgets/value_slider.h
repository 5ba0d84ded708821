// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QWidget>

#include "ui/widgets/drag_id.h"

class QDoubleSpinBox;
class QSlider;

namespace pellucid::ui {

/// A slider with a number box beside it; a double-click restores the initial value, or asks for the
/// automatic one.
class ValueSlider : public QWidget {
    Q_OBJECT
public:
    struct Range {
        double largest = 1.0;                ///< from 0
        std::optional<double> initial = 1.0; ///< none: it is automatic
    };
    /// Takes the object names of the two controls.
    ValueSlider(const Range &range, const QString &sliderName, const QString &valueName,
                QWidget *parent = nullptr);

    void setValue(double value);
    void setNames(const QString &accessibleName, const QString &tip);

signals:
    /// `drag`: constant during one drag.
    void changed(double value, pellucid::ui::DragId drag);
    void pressed();
    /// The value is to be automatic.
    void automaticRequested();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    Range m_range;
    QSlider *m_slider;
    QDoubleSpinBox *m_value;
    DragId m_drag = noDrag;
};

} // namespace pellucid::ui
