// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/volume/statistics.h"
#include "ui/document/commands.h"

class QDoubleSpinBox;
class QSpinBox;

namespace pellucid::ui {

class CurveEditor;
class Document;
class LimitBox;
class PlainLabel;

/// Edits the transfer function of the whole volume or the selected class: curve, number of control
/// points, typed weights, copy and paste.
class TransferFunctionPanel : public QWidget {
    Q_OBJECT
public:
    TransferFunctionPanel(Document &document, QWidget *parent = nullptr);

    /// The box beside the panel's heading.
    QWidget *corner();
    /// The histogram of the open volume.
    void setHistogram(const volume::Histogram &histogram);

private:
    void layOut();
    const classify::TransferFunction &function() const;
    void change(const classify::TransferFunction &function, const QString &what,
                DragId drag = noDrag);
    void setWeight(int index, double weight, DragId drag);
    void setRange(double low, double high, DragId drag);
    void typeRange();
    /// The values of the curve's range.
    classify::FieldWindow shownRange() const;
    void copy();
    void paste();
    void showScene();
    void showHistogram();

    Document &m_document;
    CurveEditor *m_editor;
    PlainLabel *m_subject;
    QSpinBox *m_points;
    QDoubleSpinBox *m_weight;
    LimitBox *m_low, *m_high; ///< the range of the curve
    volume::Histogram m_histogram;
    /// The curve before the drag that changes its range, and after its last step.
    classify::TransferFunction m_beforeRange, m_lastRanged;
    DragId m_rangeDrag = noDrag;
};

} // namespace pellucid::ui
