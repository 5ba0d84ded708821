// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QImage>
#include <QWidget>

#include "core/render/spectrum_slice.h"
#include "ui/theme/theme.h"

namespace pellucid::ui {

/// A slice of a spectrum with its axes in cycles per mm, the circle of its band, and the grey scale
/// in decibels.
class SpectrumPlot : public QWidget {
    Q_OBJECT
public:
    explicit SpectrumPlot(const Theme &theme, QWidget *parent = nullptr);

    /// None: an empty square.
    void setSlice(const std::optional<render::SpectrumSlice> &slice);
    /// The slice alone, one pixel for each frequency; null if there is none.
    const QImage &picture() const { return m_picture; }
    /// The square of the slice. *Units*: logical pixels.
    QRectF square() const;

    QSize sizeHint() const override { return {222, 260}; }
    QSize minimumSizeHint() const override { return {180, 230}; }

signals:
    /// What lies below the mouse, or nothing.
    void pointedAt(const QString &text);

protected:
    void paintEvent(QPaintEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void leaveEvent(QEvent *event) override;

private:
    void drawAxes(QPainter &painter) const;
    void drawScale(QPainter &painter) const;

    Theme m_theme;
    std::optional<render::SpectrumSlice> m_slice;
    QImage m_picture;
};

} // namespace pellucid::ui
