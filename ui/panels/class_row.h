// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/classify/tissue_class.h"
#include "core/segment/segmentation.h"
#include "ui/document/commands.h"

class QToolButton;

namespace pellucid::ui {

class PlainLabel;
class ValueSlider;

/// One class of the table: a dot in its color that shows or hides it, its name and range, a slider
/// and the number for its weight.
class ClassRow : public QWidget {
    Q_OBJECT
public:
    explicit ClassRow(int index, QWidget *parent = nullptr);
    /// `segment`: of the class, or null.
    void show(const classify::TissueClass &tissue, const segment::Segment *segment,
              bool isSelected);

signals:
    void chosen(int index);
    void toggled(int index);
    void weightChanged(int index, double weight, pellucid::ui::DragId drag);
    void editRequested(int index);
    void menuRequested(int index, const QPoint &globalAt);

protected:
    void resizeEvent(QResizeEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;

private:
    void cutRange();

    int m_index;
    QToolButton *m_dot;
    PlainLabel *m_name, *m_range;
    QString m_rangeText; ///< all of it
    ValueSlider *m_weight;
};

} // namespace pellucid::ui
