// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/spectrum_plot.h"

#include <algorithm>
#include <cmath>

#include <QMouseEvent>
#include <QPainter>

#include "ui/views/overlay.h"

namespace pellucid::ui {

namespace {

// Margins around the square. *Units*: logical pixels.
constexpr double leftMargin = 30.0, topMargin = 6.0, rightMargin = 10.0, bottomMargin = 54.0;
constexpr double tick = 4.0, labelHeight = 14.0, scaleHeight = 6.0;
constexpr int labelPixels = 10;

// 1, 2 or 5 times a power of ten, with at most two steps on either side of 0.
double roundStep(double limit) {
    const double decade = std::pow(10.0, std::floor(std::log10(limit)));
    for (const double step : {0.5, 1.0, 2.0, 5.0})
        if (limit / (step * decade) < 3.0)
            return step * decade;
    return 10.0 * decade;
}

// Formats a value with a true minus sign and the decimals of the step.
QString numberText(double value, double step) {
    const int decimals = std::max(0, int(std::ceil(-std::log10(step) - 1e-9)));
    return QString::number(value, 'f', decimals).replace('-', QChar(0x2212));
}

} // namespace

SpectrumPlot::SpectrumPlot(const Theme &theme, QWidget *parent) : QWidget(parent), m_theme(theme) {
    setObjectName("spectrumPlot");
    setAccessibleName(tr("Spectrum of the view"));
    setToolTip(
        tr("The slice of the spectrum that this view takes, in decibels below the value at "
           "frequency 0; the circle is the band of the picture, at most that of the samples"));
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void SpectrumPlot::setSlice(const std::optional<render::SpectrumSlice> &slice) {
    m_slice = slice;
    m_picture = {};
    if (slice) {
        const auto rgba = render::greyLevels(*slice);
        m_picture = QImage(rgba.data(), slice->side, slice->side, QImage::Format_RGBA8888).copy();
        setAccessibleDescription(tr("Up to %1 cycles per mm").arg(slice->limitPerMm, 0, 'f', 2));
    } else {
        setAccessibleDescription({});
    }
    update();
}

QRectF SpectrumPlot::square() const {
    const double side = std::max(16.0, std::floor(std::min(width() - leftMargin - rightMargin,
                                                           height() - topMargin - bottomMargin)));
    return {leftMargin + std::floor(0.5 * (width() - leftMargin - rightMargin - side)), topMargin,
            side, side};
}

void SpectrumPlot::paintEvent(QPaintEvent *) {
    QPainter painter(this);
    const QRectF square = this->square();
    painter.fillRect(square, QColor(pictureBackground));
    if (!m_slice)
        return;
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(square, m_picture);
    // If the number of pixels is even, the pixel of frequency 0 is half a pixel off the center.
    const double pixel = square.width() / m_slice->side;
    const QPointF zero = square.topLeft() + (m_slice->side / 2 + 0.5) * QPointF(pixel, pixel);
    const double radius = m_slice->limitPerMm / m_slice->stepPerMm * pixel;
    painter.save();
    painter.setClipRect(square);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(overlayColors("accent").accent, 1.0));
    painter.drawEllipse(zero, radius - 0.5, radius - 0.5);
    painter.restore();
    drawAxes(painter);
    drawScale(painter);
}

void SpectrumPlot::drawAxes(QPainter &painter) const {
    const QRectF square = this->square();
    const double pixel = square.width() / m_slice->side;
    const QPointF zero = square.topLeft() + (m_slice->side / 2 + 0.5) * QPointF(pixel, pixel);
    const double step = roundStep(m_slice->limitPerMm);
    QFont font = painter.font();
    font.setPixelSize(labelPixels);
    painter.setFont(font);
    painter.setPen(m_theme.color("muted"));
    const int maxTick = int(m_slice->limitPerMm / step + 1e-9);
    for (int n = -maxTick; n <= maxTick; ++n) {
        const double away = n * step / m_slice->stepPerMm * pixel;
        const double x = std::floor(zero.x() + away) + 0.5, y = std::floor(zero.y() - away) + 0.5;
        const QString text = n == 0 ? QString("0") : numberText(n * step, step);
        painter.drawLine(QPointF(x, square.bottom()), QPointF(x, square.bottom() + tick));
        painter.drawText(QRectF(x - 30.0, square.bottom() + tick, 60.0, labelHeight),
                         Qt::AlignHCenter | Qt::AlignTop, text);
        painter.drawLine(QPointF(square.left() - tick, y), QPointF(square.left(), y));
        painter.drawText(QRectF(square.left() - leftMargin, y - 0.5 * labelHeight,
                                leftMargin - tick - 2.0, labelHeight),
                         Qt::AlignRight | Qt::AlignVCenter, text);
    }
}

// Draws the unit and the grey scale below the axis.
void SpectrumPlot::drawScale(QPainter &painter) const {
    const QRectF square = this->square();
    const double unitTop = square.bottom() + tick + labelHeight;
    painter.drawText(QRectF(square.left(), unitTop, square.width(), labelHeight),
                     Qt::AlignHCenter | Qt::AlignVCenter, tr("cycles/mm"));
    const QRectF line(square.left(), unitTop + labelHeight + 6.0, square.width(), labelHeight);
    const QString white = tr("%1 dB").arg(0),
                  black = tr("%1 dB").arg(numberText(render::blackDecibels, 1.0));
    const QFontMetricsF metrics(painter.font());
    painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, white);
    painter.drawText(line, Qt::AlignRight | Qt::AlignVCenter, black);
    const QRectF bar(line.left() + metrics.horizontalAdvance(white) + 6.0,
                     line.center().y() - 0.5 * scaleHeight,
                     line.width() - metrics.horizontalAdvance(white + black) - 12.0, scaleHeight);
    QLinearGradient grey(bar.topLeft(), bar.topRight());
    grey.setColorAt(0.0, Qt::white);
    grey.setColorAt(1.0, Qt::black);
    painter.setPen(QPen(m_theme.color("line"), 1.0));
    painter.setBrush(grey);
    painter.drawRect(bar.adjusted(0.5, 0.5, -0.5, -0.5));
}

void SpectrumPlot::mouseMoveEvent(QMouseEvent *event) {
    const QRectF square = this->square();
    if (!m_slice || !square.contains(event->position())) {
        emit pointedAt({});
        return;
    }
    const int last = m_slice->side - 1;
    const QPointF share = (event->position() - square.topLeft()) / square.width();
    const int column = std::clamp(int(share.x() * m_slice->side), 0, last),
              row = std::clamp(int(share.y() * m_slice->side), 0, last);
    const double frequency =
        m_slice->stepPerMm * std::hypot(column - m_slice->side / 2, row - m_slice->side / 2);
    const float decibels =
        m_slice->decibels[std::size_t(row) * std::size_t(m_slice->side) + std::size_t(column)];
    const QString strength = tr("%1 dB").arg(numberText(std::round(decibels) + 0.0, 1.0));
    emit pointedAt(frequency > 0.0 ? tr("%1 cycles/mm (period %2 mm): %3")
                                         .arg(QString::number(frequency, 'f', 3),
                                              QString::number(1.0 / frequency, 'f', 1), strength)
                                   : tr("0 cycles/mm: %1").arg(strength));
}

void SpectrumPlot::leaveEvent(QEvent *) {
    emit pointedAt({});
}

} // namespace pellucid::ui
