// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/plane_texts.h"

#include <algorithm>
#include <cmath>

#include <QCoreApplication>
#include <QPainter>

#include <glm/geometric.hpp>

#include "core/scene/camera.h"
#include "ui/document/document.h"
#include "ui/language/measurement_text.h"
#include "ui/language/number_text.h"
#include "ui/views/crosshair.h"
#include "ui/views/overlay.h"

namespace pellucid::ui {

namespace {

struct PlaneTextsTexts {
    Q_DECLARE_TR_FUNCTIONS(PlaneTextsTexts)
};

QString slabText(const mpr::Slab &slab) {
    const QString mode = slab.mode == mpr::SlabMode::mean      ? PlaneTextsTexts::tr("mean")
                         : slab.mode == mpr::SlabMode::maximum ? PlaneTextsTexts::tr("MIP")
                                                               : PlaneTextsTexts::tr("MinIP");
    return PlaneTextsTexts::tr("%1, %2 mm").arg(mode, QString::number(slab.thicknessMm));
}

// "S 142.5": the patient's direction of the coordinate, and its absolute value.
QString coordinateText(const glm::dvec3 &axis, double mm) {
    const std::string side = scene::patientLetters(mm < 0.0 ? -axis : axis);
    return QString::fromStdString(side) + " " + QString::number(std::abs(mm), 'f', 1);
}

// In planes across filled gaps, draws the edges of the gaps. Returns whether this plane lies within
// one.
bool paintGapEdges(QPainter &painter, const QRect &area, const PaneMapping &mapping,
                   const volume::Volume &volume, volume::PatientPoint at, const QColor &color) {
    const volume::Lattice &lattice = volume.lattice();
    // The slice number is an affine function of the position on the pane.
    const auto sliceAt = [&](const QPointF &position) {
        return lattice.voxel(mapping.patientAt(position)).v.z;
    };
    const QPointF middle = QRectF(area).center();
    const double here = sliceAt(middle);
    const QPointF slope(sliceAt(middle + QPointF(1.0, 0.0)) - here,
                        sliceAt(middle + QPointF(0.0, 1.0)) - here);
    const double square = QPointF::dotProduct(slope, slope);
    constexpr double noSlope = 1e-6; // slices per pixel
    const double slice = lattice.voxel(at).v.z;
    bool isInside = false;
    painter.save();
    painter.setClipRect(area);
    painter.setPen(QPen(color, 1.0, Qt::DashLine));
    for (const volume::SliceRange &range : volume.notes().filled) {
        if (square <= noSlope * noSlope) {
            isInside = isInside || (slice > range.first - 0.5 && slice < range.last + 0.5);
            continue;
        }
        for (const double edge : {range.first - 0.5, range.last + 0.5}) {
            const QPointF on = middle + slope * ((edge - here) / square);
            const double reach = area.width() + area.height();
            const QPointF along = QPointF(-slope.y(), slope.x()) * (reach / std::sqrt(square));
            painter.drawLine(on - along, on + along);
        }
    }
    painter.restore();
    return isInside;
}

// "45 / 124": which of the positions that the plane scrolls through; empty for a single one.
QString sliceText(const Document &document, const glm::dvec3 &axis) {
    const volume::Volume &volume = *document.volume();
    if (!volume.notes().placed) // the position is the number of the image
        return {};
    const mpr::ScrollRange range = mpr::scrollRange(volume.lattice(), axis);
    const auto numberAt = [&](double mm) {
        return 1 + int(std::lround((mm - range.lowMm) / range.stepMm));
    };
    const int count = numberAt(range.highMm);
    const int number =
        std::clamp(numberAt(glm::dot(document.crosshair().mm, axis)), 1, std::max(1, count));
    return count > 1 ? QString::number(number) + " / " + QString::number(count) : QString();
}

QString windowText(const Document &document) {
    const volume::ValueWindow &window = document.displayWindow();
    return PlaneTextsTexts::tr("W %1  C %2", "window width and center")
        .arg(numberText(window.width), numberText(window.center));
}

} // namespace

QString planeTitle(mpr::Orientation o) {
    switch (o) {
    case mpr::Orientation::axial:
        return PlaneTextsTexts::tr("Axial");
    case mpr::Orientation::coronal:
        return PlaneTextsTexts::tr("Coronal");
    case mpr::Orientation::sagittal:
        break;
    }
    return PlaneTextsTexts::tr("Sagittal");
}

QString valueText(const volume::Volume &volume, volume::PatientPoint at,
                  mpr::Interpolation interpolation) {
    const float value = mpr::valueAt(volume, at, interpolation);
    if (std::isnan(value))
        return {};
    QString text = volume.notes().placed ? QString("%1  %2  %3 mm   ")
                                               .arg(coordinateText({1, 0, 0}, at.mm.x),
                                                    coordinateText({0, 1, 0}, at.mm.y),
                                                    coordinateText({0, 0, 1}, at.mm.z))
                                         : QString();
    const bool isWhole = volume.unit() == volume::ValueUnit::hounsfield || !volume.isFloat();
    return text + (isWhole ? QString::number(double(value), 'f', 0) : numberText(double(value))) +
           unitSuffix(volume.unit());
}

void paintPlaneTexts(QPainter &painter, const QRect &area, const PaneMapping &mapping,
                     const Document &document, mpr::Orientation orientation, TextsFor reader,
                     Names names, const QString &patient) {
    // Over white, as PET and some radiographs are shown, light letters would vanish.
    const OverlayColors colors = document.volume() && document.displayWindow().isInverted
                                     ? filmColors(colorRole(orientation))
                                     : overlayColors(colorRole(orientation));
    const QRect inner = area.adjusted(8, 8, -8, -8);
    const Cut &cut = document.cut();
    painter.save();
    QFont bold = painter.font();
    bold.setBold(true);
    painter.setFont(bold);
    const QString title = planeTitle(orientation);
    drawText(painter, inner, Qt::AlignLeft | Qt::AlignTop,
             cut.axes.of(orientation) == mpr::standardAxes(orientation)
                 ? title
                 : PlaneTextsTexts::tr("%1, oblique").arg(title),
             colors.plane);
    painter.restore();
    if (!document.volume())
        return;
    const volume::VolumeNotes &notes = document.volume()->notes();
    const int line = painter.fontMetrics().height() + 3;
    const glm::dvec3 axis = cut.axes.scrollAxis(orientation);
    const QString position =
        notes.placed
            ? coordinateText(axis, glm::dot(document.crosshair().mm, axis)) + " mm"
            : PlaneTextsTexts::tr("image %1")
                  .arg(1 + int(std::lround(
                               document.volume()->lattice().voxel(document.crosshair()).v.z)));
    int left = 1, right = 0; // lines that are used at the top
    const auto drawAtLeft = [&](const QString &text, const QColor &color) {
        drawText(painter, inner.adjusted(0, line * left++, 0, 0), Qt::AlignLeft | Qt::AlignTop,
                 text, color);
    };
    const auto drawAtRight = [&](const QString &text, const QColor &color) {
        drawText(painter, inner.adjusted(0, line * right++, 0, 0), Qt::AlignRight | Qt::AlignTop,
                 text, color);
    };
    drawAtRight(position, colors.text);
    if (const QString slice = sliceText(document, axis); !slice.isEmpty())
        drawAtRight(slice, colors.text);
    // The text must not reach the letter in the middle.
    const auto fitsBesideLetter = [&](const QString &text) {
        return painter.fontMetrics().horizontalAdvance(text) < inner.width() / 2 - line;
    };
    if (const QString window = windowText(document); fitsBesideLetter(window))
        drawAtLeft(window, colors.muted);
    if (reader == TextsFor::picture)
        drawAtLeft(PlaneTextsTexts::tr("Not for diagnostic use"), colors.muted);
    if (cut.options.slab.thicknessMm > 0.0)
        drawAtRight(slabText(cut.options.slab), colors.text);
    if (paintGapEdges(painter, area, mapping, *document.volume(), document.crosshair(),
                      colors.warning)) {
        const QString whole = PlaneTextsTexts::tr("interpolated: no image acquired here");
        drawAtRight(fitsBesideLetter(whole) ? whole : PlaneTextsTexts::tr("interpolated"),
                    colors.warning);
    }
    if (!patient.isEmpty()) {
        if (!fitsBesideLetter(patient)) // below all that it could cross
            right = std::max({left, right, 2});
        drawAtRight(painter.fontMetrics().elidedText(patient, Qt::ElideRight, inner.width()),
                    colors.text);
    }
    if (notes.placed)
        drawOrientationLetters(painter, area, mapping.plane.axes.right, mapping.plane.axes.up,
                               colors);
    if (notes.hasSpacing)
        drawScaleBar(painter, QPoint(10, area.bottom() - 9), mapping.pixelsPerMm(),
                     std::min(110, area.width() / 2 - 74), colors);
    if (const QString place = spacingPlaceText(notes.spacingPlace); !place.isEmpty())
        drawText(painter, inner.adjusted(0, 0, 0, -16), Qt::AlignLeft | Qt::AlignBottom, place,
                 colors.muted);
    const bool areWords = reader == TextsFor::picture || isPartial(notes);
    if (!areWords && !notes.warnings.empty())
        drawWarningMark(painter, notes.lossy ? area.adjusted(0, 0, 0, -line) : area,
                        notes.warnings.size(), colors);
    if (const QStringList warnings = warningLines(notes, names, 1); areWords && !warnings.isEmpty())
        drawText(painter, inner.adjusted(0, 0, 0, -16), Qt::AlignRight | Qt::AlignBottom,
                 painter.fontMetrics().elidedText(warnings.front(), Qt::ElideRight,
                                                  area.width() / 2 - 16),
                 colors.warning);
    if (notes.lossy)
        drawText(painter, inner, Qt::AlignRight | Qt::AlignBottom, PlaneTextsTexts::tr("lossy"),
                 colors.warning);
}

} // namespace pellucid::ui
