// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_overlay.h"

#include <algorithm>

#include <QCoreApplication>
#include <QPainter>

#include "ui/document/document.h"
#include "ui/views/overlay.h"
#include "ui/views/projection_texts.h"
#include "ui/views/tools/pane_tools.h"

namespace pellucid::ui {

namespace {

constexpr double cubeRadius = 40.0;

QString anglesOf(const glm::dmat3 &axes) {
    return anglesText(scene::positionerAngles(glm::quat_cast(axes)));
}

} // namespace

ProjectionOverlay::ProjectionOverlay(const Document &document, const PaneTools &tools,
                                     QWidget *parent)
    : QWidget(parent), m_document(document), m_tools(tools) {
    setObjectName("projectionOverlay");
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
}

void ProjectionOverlay::setTexts(const Texts &texts) {
    m_texts = texts;
    update();
}

void ProjectionOverlay::setMapping(const PaneMapping &mapping) {
    m_mapping = mapping;
    update();
}

void ProjectionOverlay::setShowsCrosshair(bool isShown) {
    m_showsCrosshair = isShown;
    update();
}

void ProjectionOverlay::setOverlays(const Overlays &overlays) {
    m_overlays = overlays;
    update();
}

void ProjectionOverlay::setComparison(const QImage &picture, const QString &name) {
    m_comparison = picture;
    m_comparedName = name;
    update();
}

OverlayColors ProjectionOverlay::colors() const {
    return m_document.scene().tone.inverted && m_document.volume() ? filmColors("accent")
                                                                   : overlayColors("accent");
}

void ProjectionOverlay::paintEvent(QPaintEvent *) {
    QPainter painter(this);
    paint(painter, m_mapping, Marks::shown, Names::shown);
}

void ProjectionOverlay::paint(QPainter &painter, const PaneMapping &mapping, Marks marks,
                              Names names) const {
    const OverlayColors colors = this->colors();
    if (!m_comparison.isNull()) {
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        painter.drawImage(rect(), m_comparison);
        painter.setPen(QPen(colors.muted, 1));
        painter.drawLine(width() / 2, 0, width() / 2, height());
        const QRect below = rect().adjusted(10, 0, -10, -90);
        drawText(
            painter, below.adjusted(0, 0, -width() / 2, 0), Qt::AlignHCenter | Qt::AlignBottom,
            m_comparedName.isEmpty()
                ? QCoreApplication::translate("ProjectionView", "Before")
                : QCoreApplication::translate("ProjectionView", "Before: %1").arg(m_comparedName),
            colors.text);
        drawText(painter, below.adjusted(width() / 2, 0, 0, 0), Qt::AlignHCenter | Qt::AlignBottom,
                 QCoreApplication::translate("ProjectionView", "Now"), colors.text);
    }
    painter.fillRect(QRect(0, 0, width(), 3), colors.plane);
    const QRect inner = rect().adjusted(10, 8, -10, -8);
    const int line = painter.fontMetrics().height() + 3;
    const auto paintMessage = [&] {
        painter.setPen(colors.muted);
        painter.drawText(inner.adjusted(40, 40, -40, -40), Qt::AlignCenter | Qt::TextWordWrap,
                         m_texts.message);
    };
    if (marks > Marks::plain && !m_overlays.texts) {
        paintMessage();
        return;
    }
    painter.save();
    QFont bold = painter.font();
    bold.setBold(true);
    painter.setFont(bold);
    drawText(painter, inner, Qt::AlignLeft | Qt::AlignTop,
             QCoreApplication::translate("ProjectionView", "Projection"), colors.plane);
    painter.restore();
    drawText(painter, inner, Qt::AlignRight | Qt::AlignBottom,
             QCoreApplication::translate("ProjectionView", "Parallel projection"), colors.muted);
    const QRect second = inner.adjusted(0, line, 0, 0);
    drawText(painter, second, Qt::AlignRight | Qt::AlignTop,
             QCoreApplication::translate("ProjectionView", "Not for diagnostic use"), colors.muted);
    if (!m_document.volume())
        return;
    if (names == Names::shown)
        drawText(painter, second, Qt::AlignLeft | Qt::AlignTop, m_texts.lookName, colors.text);
    // Warnings about the geometry belong on every picture; in the window, a mark does.
    QRect warning = second.adjusted(0, line, -width() / 2 - 24, 0);
    const volume::VolumeNotes &notes = m_document.volume()->notes();
    const bool areWords = marks <= Marks::plain || isPartial(notes);
    if (!areWords && !notes.warnings.empty())
        drawWarningMark(painter, markArea(), notes.warnings.size(), colors);
    for (const QString &w : warningLines(notes, names, areWords ? notes.warnings.size() : 0)) {
        drawText(painter, warning, Qt::AlignLeft | Qt::AlignTop,
                 painter.fontMetrics().elidedText(w, Qt::ElideRight, warning.width()),
                 colors.warning);
        warning.translate(0, line);
    }
    if (!m_document.scene().crop.isWhole()) // nobody may take a part for the whole
        drawText(painter, warning, Qt::AlignLeft | Qt::AlignTop,
                 QCoreApplication::translate("ProjectionView", "Cropped"), colors.warning);
    paintMessage();
    if (!m_texts.figures.isEmpty())
        paintPicture(painter, mapping, marks);
}

// Above the line at the bottom.
QRect ProjectionOverlay::markArea() const {
    return rect().adjusted(0, 0, 0, -fontMetrics().height() - 28);
}

bool ProjectionOverlay::isOnWarnings(const QPoint &at) const {
    return m_overlays.texts && warningMarkRect(markArea()).contains(at);
}

QPointF ProjectionOverlay::cubeCenter() const {
    return {58.0, height() - 72.0};
}

QRect ProjectionOverlay::anglesRect(const QFontMetrics &metrics, const QString &text) const {
    const int line = metrics.height() + 4;
    return {12, height() - 14 - line, metrics.horizontalAdvance(text) + 8, line};
}

std::optional<glm::dvec3> ProjectionOverlay::cubeSideAt(const QPointF &at) const {
    const mpr::Axes &seen = m_mapping.plane.axes;
    if (m_texts.figures.isEmpty() || !m_overlays.texts)
        return std::nullopt;
    return ui::cubeSideAt(at, cubeCenter(), cubeRadius, {seen.right, seen.up, seen.toViewer()});
}

bool ProjectionOverlay::isOnAngles(const QPointF &at) const {
    const mpr::Axes &seen = m_mapping.plane.axes;
    const QString text = anglesOf({seen.right, seen.up, seen.toViewer()});
    return !m_texts.figures.isEmpty() && m_overlays.texts &&
           anglesRect(fontMetrics(), text).contains(at.toPoint());
}

bool ProjectionOverlay::isOnFigures(const QPointF &at) const {
    const int width = fontMetrics().horizontalAdvance(m_texts.figures),
              height = fontMetrics().height();
    return !m_texts.figures.isEmpty() && m_overlays.texts &&
           QRect(this->width() - 10 - width, 8, width, height).contains(at.toPoint());
}

// The pivot of turning.
void ProjectionOverlay::paintCrosshair(QPainter &painter, const PaneMapping &mapping) const {
    constexpr double gap = 4.0, arm = 12.0;
    const QPointF at = mapping.positionOf(m_document.crosshair());
    painter.setPen(QPen(colors().accent, 1.5));
    for (const QPointF &way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
        painter.drawLine(at + gap * way, at + arm * way);
}

void ProjectionOverlay::paintPicture(QPainter &painter, const PaneMapping &mapping,
                                     Marks marks) const {
    const OverlayColors colors = this->colors();
    const int line = painter.fontMetrics().height() + 3;
    // A printed picture needs no times, and a narrow pane has no room for them.
    const QFontMetrics metrics = painter.fontMetrics();
    const bool fits = metrics.horizontalAdvance(m_texts.figures) <
                      width() - 40 -
                          2 * metrics.horizontalAdvance(
                                  QCoreApplication::translate("ProjectionView", "Projection"));
    if (marks > Marks::plain && fits)
        drawText(painter, rect().adjusted(10, 8, -10, -8), Qt::AlignRight | Qt::AlignTop,
                 m_texts.figures, colors.text);
    const mpr::Axes &seen = mapping.plane.axes;
    const glm::dmat3 axes(seen.right, seen.up, seen.toViewer());
    drawOrientationLetters(painter, rect().adjusted(0, line, 0, -line), axes[0], axes[1], colors);
    drawOrientationCube(painter, cubeCenter(), cubeRadius, axes, colors);
    const QString angles = anglesOf(axes);
    drawText(painter, anglesRect(painter.fontMetrics(), angles), Qt::AlignLeft | Qt::AlignVCenter,
             angles, colors.text);
    // Bar and text fit beside the lower letter even in the smallest pane.
    const int barLeft = std::max(width() - 180, width() / 2 + 14);
    drawScaleBar(painter, QPoint(barLeft, height() - 34), mapping.pixelsPerMm(),
                 width() - barLeft - 60, colors);
    if (!m_comparison.isNull())
        return; // two pictures have no common positions
    if (m_showsCrosshair && m_overlays.crosshair && marks > Marks::plain)
        paintCrosshair(painter, mapping);
    m_tools.paint(painter, {mapping, rect(), colors}, marks, m_overlays);
}

} // namespace pellucid::ui
