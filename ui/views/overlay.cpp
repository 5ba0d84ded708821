// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <QCoreApplication>
#include <QPainter>
#include <QPainterPath>

#include <glm/geometric.hpp>

#include "core/dicom/reasons.h"
#include "core/scene/camera.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/theme/theme.h"

namespace pellucid::ui {

namespace {

struct OverlayTexts {
    Q_DECLARE_TR_FUNCTIONS(OverlayTexts)
};

// Separates a color from the picture.
QColor outlineOf(const QColor &color) {
    constexpr int light = 110;
    return color.lightness() > light ? QColor(0, 0, 0, 190) : QColor(255, 255, 255, 210);
}

} // namespace

bool isPartial(const volume::VolumeNotes &notes) {
    return !notes.warnings.empty() && notes.warnings.front().is(task::because::slicesOfSeries);
}

QStringList warningLines(const volume::VolumeNotes &notes, Names names, std::size_t most) {
    if (names == Names::hidden && !notes.warnings.empty())
        return {OverlayTexts::tr("Warnings omitted")};
    QStringList lines;
    for (std::size_t n = 0; n < std::min(most, notes.warnings.size()); ++n)
        lines << translated(notes.warnings[n]);
    return lines;
}

OverlayColors filmColors(const QString &planeRole) {
    static const Theme light = Theme::named("light");
    return {light.color(planeRole), light.color("warning"), light.color("text"),
            light.color("text"),    light.color("raised"),  light.color("accent"),
            light.color("warning"), light.color("accent")};
}

OverlayColors overlayColors(const QString &planeRole) {
    static const Theme dark = Theme::named("dark");
    return {dark.color(planeRole), dark.color("letters"), dark.color("text"),
            dark.color("muted"),   dark.color("raised"),  dark.color("accent"),
            dark.color("warning"), dark.color("curve")};
}

QRect warningMarkRect(const QRect &area) {
    return {area.right() - 41, area.bottom() - 25, 34, 18};
}

void drawWarningMark(QPainter &painter, const QRect &area, std::size_t count,
                     const OverlayColors &colors) {
    const QRect place = warningMarkRect(area);
    const QPointF top(place.right() - 8.0, place.top() + 2.5);
    QPainterPath sign(top);
    sign.lineTo(top + QPointF(7.5, 13.0));
    sign.lineTo(top + QPointF(-7.5, 13.0));
    sign.closeSubpath();
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    QColor outline = outlineOf(colors.warning);
    painter.setPen(QPen(outline, 3.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(sign);
    painter.setPen(QPen(colors.warning, 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    outline.setAlpha(110);
    painter.setBrush(outline);
    painter.drawPath(sign);
    painter.drawLine(top + QPointF(0.0, 4.5), top + QPointF(0.0, 8.2));
    painter.drawPoint(top + QPointF(0.0, 10.6));
    painter.restore();
    if (count > 1)
        drawText(painter, place.adjusted(0, 0, -20, 0), Qt::AlignRight | Qt::AlignVCenter,
                 QString::number(count), colors.warning);
}

void drawText(QPainter &painter, const QRect &area, int flags, const QString &text,
              const QColor &color) {
    const QString shown = shownLines(text);
    // On bone, a thin outline is not enough: a faint one around it separates text and picture.
    QColor outline = outlineOf(color);
    const int alpha = outline.alpha();
    outline.setAlpha(70);
    painter.setPen(outline);
    for (const QPoint &offset : {QPoint(-2, 0), QPoint(2, 0), QPoint(0, -2), QPoint(0, 2),
                                 QPoint(-1, -1), QPoint(1, -1), QPoint(-1, 1), QPoint(1, 1)})
        painter.drawText(area.translated(offset), flags, shown);
    outline.setAlpha(alpha);
    painter.setPen(outline);
    for (const QPoint &offset : {QPoint(-1, 0), QPoint(1, 0), QPoint(0, -1), QPoint(0, 1)})
        painter.drawText(area.translated(offset), flags, shown);
    painter.setPen(color);
    painter.drawText(area, flags, shown);
}

void drawOrientationLetters(QPainter &painter, const QRect &area, const glm::dvec3 &right,
                            const glm::dvec3 &up, const OverlayColors &colors) {
    painter.save();
    QFont font = painter.font();
    font.setBold(true);
    font.setPointSizeF(font.pointSizeF() + 1.0);
    painter.setFont(font);
    const QRect inner = area.adjusted(8, 18, -8, -8);
    const auto letters = [](const glm::dvec3 &d) {
        return QString::fromStdString(scene::patientLetters(d));
    };
    drawText(painter, area.adjusted(8, 8, -8, -8), Qt::AlignLeft | Qt::AlignVCenter,
             letters(-right), colors.letters);
    drawText(painter, area.adjusted(8, 8, -8, -8), Qt::AlignRight | Qt::AlignVCenter,
             letters(right), colors.letters);
    drawText(painter, inner, Qt::AlignHCenter | Qt::AlignTop, letters(up), colors.letters);
    drawText(painter, inner, Qt::AlignHCenter | Qt::AlignBottom, letters(-up), colors.letters);
    painter.restore();
}

QRegion upperAndLowerLetters(const QRect &area) {
    constexpr int half = 14;
    return QRegion(area.center().x() - half, area.top() + 20, 2 * half, 2 * half) +
           QRegion(area.center().x() - half, area.bottom() - 2 * half - 2, 2 * half, 2 * half);
}

void drawScaleBar(QPainter &painter, QPoint bottomLeft, double pixelsPerMm, int longestPixels,
                  const OverlayColors &colors) {
    if (!(pixelsPerMm > 0.0) || longestPixels < 10)
        return;
    // The longest of 1, 2, 5 times a power of ten that fits.
    const double longest = longestPixels / pixelsPerMm;
    const double power = std::pow(10.0, std::floor(std::log10(longest)));
    const double mm = longest >= 5.0 * power   ? 5.0 * power
                      : longest >= 2.0 * power ? 2.0 * power
                                               : power;
    const int length = int(std::lround(mm * pixelsPerMm));
    const QString text = mm >= 10.0 ? QString("%1 cm").arg(mm / 10.0) : QString("%1 mm").arg(mm);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.fillRect(QRect(bottomLeft.x() - 1, bottomLeft.y() - 3, length + 2, 4),
                     outlineOf(colors.text));
    painter.fillRect(QRect(bottomLeft.x(), bottomLeft.y() - 2, length, 2), colors.text);
    drawText(painter, QRect(bottomLeft.x() + length + 6, bottomLeft.y() - 10, 80, 18),
             Qt::AlignLeft | Qt::AlignVCenter, text, colors.text);
    painter.restore();
}

namespace {

struct CubeFace {
    glm::dvec3 normal, a, b;
    char letter;
};
constexpr std::array<CubeFace, 6> cubeFaces{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 'L'},
                                             {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 'R'},
                                             {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 'P'},
                                             {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, 'A'},
                                             {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 'S'},
                                             {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 'I'}}};
// Half an edge of a cube whose corners are within a radius.
constexpr double edgeOfRadius = 1.0 / 1.75;

} // namespace

std::optional<glm::dvec3> cubeSideAt(const QPointF &at, QPointF center, double radius,
                                     const glm::dmat3 &axes) {
    // The rest of a face belongs to its edges and corners.
    constexpr double middleOfFace = 0.6, edgeOn = 0.02;
    const double half = radius * edgeOfRadius;
    const glm::dvec3 onPicture =
        ((at.x() - center.x()) * axes[0] - (at.y() - center.y()) * axes[1]) / half;
    for (const CubeFace &face : cubeFaces) {
        const double facing = glm::dot(face.normal, axes[2]);
        if (facing <= edgeOn)
            continue;
        // Where the line of sight meets the face.
        const glm::dvec3 met =
            onPicture + (1.0 - glm::dot(face.normal, onPicture)) / facing * axes[2];
        const double a = glm::dot(met, face.a), b = glm::dot(met, face.b);
        if (std::max(std::abs(a), std::abs(b)) > 1.0)
            continue;
        const auto beyond = [&](double x) {
            return std::abs(x) > middleOfFace ? std::copysign(1.0, x) : 0.0;
        };
        return face.normal + beyond(a) * face.a + beyond(b) * face.b;
    }
    return std::nullopt;
}

void drawOrientationCube(QPainter &painter, QPointF center, double radius, const glm::dmat3 &axes,
                         const OverlayColors &colors) {
    const double half = radius * edgeOfRadius;
    const auto project = [&](const glm::dvec3 &p) {
        return QPointF(center.x() + half * glm::dot(p, axes[0]),
                       center.y() - half * glm::dot(p, axes[1]));
    };
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    QFont font = painter.font();
    font.setBold(true);
    painter.setFont(font);
    for (const CubeFace &face : cubeFaces) {
        const double facing = glm::dot(face.normal, axes[2]);
        if (facing <= 0.02)
            continue;
        const QPolygonF outline{
            project(face.normal + face.a + face.b), project(face.normal - face.a + face.b),
            project(face.normal - face.a - face.b), project(face.normal + face.a - face.b)};
        // Faces that face the viewer are lighter.
        const QColor base = colors.raised;
        painter.setBrush(base.lighter(int(100 + 90 * facing)));
        painter.setPen(QPen(colors.muted, 1.0));
        painter.drawPolygon(outline);
        if (facing < 0.25)
            continue;
        const QPointF at = project(face.normal);
        painter.setPen(colors.letters);
        painter.drawText(QRectF(at.x() - 10, at.y() - 10, 20, 20), Qt::AlignCenter,
                         QString(QChar(face.letter)));
    }
    painter.restore();
}

QString millisecondsText(double ms) {
    return QCoreApplication::translate("overlay", "%1 ms").arg(ms, 0, 'f', ms < 1.0 ? 2 : 1);
}

} // namespace pellucid::ui
