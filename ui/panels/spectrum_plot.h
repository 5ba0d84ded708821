// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QImage>
#include <QWidget>

#include "core/render/spectrum_slice.h"
#include "ui/theme/theme.h"

namespace pellucid::ui {

/// Draws a slice of a spectrum with axes in cycles per mm, the circle of its band, and a grey scale
/// in decibels.
class SpectrumPlot : public QWidget {
    Q_OBJECT
public:
    explicit SpectrumPlot(const Theme &theme, QWidget *parent = nullptr);

    /// None shows an empty square.
    void setSlice(const std::optional<render::SpectrumSlice> &slice);
    /// The slice without axes, one pixel for each frequency; null if there is no slice.
    const QImage &picture() const { return m_picture; }
    /// The square that contains the slice. *Units*: logical pixels.
    QRectF square() const;

    QSize sizeHint() const override { return {222, 260}; }
    QSize minimumSizeHint() const override { return {180, 230}; }

signals:
    /// The readout at the mouse; empty if there is none.
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
