// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/views/measure_tool.h"

namespace pellucid::ui {

class Document;

/// What stands over the projection: names, figures of the picture, letters, cube, scale,
/// measurements. It lets the mouse through, and lies over a canvas that may be an OpenGL surface.
class ProjectionOverlay : public QWidget {
public:
    struct Texts {
        QString lookName, message;
        QString figures; ///< engine, time and error of the picture; empty while there is none
    };

    ProjectionOverlay(const Document &document, const MeasureTool &measure, QWidget *parent);

    void setTexts(const Texts &texts);
    void setMapping(const PaneMapping &mapping);
    /// Over any picture of the pane's size.
    void paint(QPainter &painter);

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void paintPicture(QPainter &painter);

    const Document &m_document;
    const MeasureTool &m_measure;
    Texts m_texts;
    PaneMapping m_mapping;
};

} // namespace pellucid::ui
