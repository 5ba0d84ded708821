// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/volume/statistics.h"
#include "ui/document/commands.h"
#include "ui/theme/theme.h"

class QDoubleSpinBox;
class QLabel;
class QSpinBox;

namespace pellucid::ui {

class CurveEditor;
class Document;

/// The transfer function of the whole volume, or of the selected class: its curve, the number of
/// its control points, typed weights, copy and paste.
class TransferFunctionPanel : public QWidget {
    Q_OBJECT
public:
    TransferFunctionPanel(Document &document, const Theme &theme, QWidget *parent = nullptr);

    /// Stands beside the panel's heading.
    QWidget *corner();
    /// The counts of the open volume's values.
    void setHistogram(const volume::Histogram &histogram);

private:
    void layOut();
    const classify::TransferFunction &function() const;
    void change(const classify::TransferFunction &function, const QString &what,
                DragId drag = noDrag);
    void setWeight(int index, double weight, DragId drag);
    void copy();
    void paste();
    void showScene();
    void showHistogram();

    Document &m_document;
    CurveEditor *m_editor;
    QLabel *m_subject;
    QSpinBox *m_points;
    QDoubleSpinBox *m_weight;
    volume::Histogram m_histogram;
};

} // namespace pellucid::ui
