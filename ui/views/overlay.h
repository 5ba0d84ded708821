// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QRect>
#include <QRegion>
#include <QString>
#include <QStringList>

#include <glm/mat3x3.hpp>

#include "core/volume/volume.h"

class QPainter;

namespace pellucid::ui {

/// Colors of what is drawn over pictures; the same in both themes: they follow the picture.
struct OverlayColors {
    QColor plane, letters, text, muted, raised, accent, warning, curve;
};

/// The dark theme's colors, with the plane's own by its role in resources/styles/colors.json.
OverlayColors overlayColors(const QString &planeRole);

/// The light theme's, for pictures that are shown as film, dark on light.
OverlayColors filmColors(const QString &planeRole);

/// Whether texts may name somebody: files and looks carry names that people gave them.
enum class Names { shown, hidden };

/// The first warnings of a volume, one for each line: hidden names leave that there are some.
QStringList warningLines(const volume::VolumeNotes &notes, Names names, std::size_t most);

/// Letters at the middle of the four sides for an image with these axes (LPS).
void drawOrientationLetters(QPainter &painter, const QRect &area, const glm::dvec3 &right,
                            const glm::dvec3 &up, const OverlayColors &colors);

/// Where the upper and the lower of them stand, for what must not run through them.
QRegion upperAndLowerLetters(const QRect &area);

/// A bar of a round length, its left end at the given corner. *Units*: logical pixels per mm.
void drawScaleBar(QPainter &painter, QPoint bottomLeft, double pixelsPerMm, int longestPixels,
                  const OverlayColors &colors);

/// A cube with the patient's letters as the viewer sees it; `axes` are [U V W].
void drawOrientationCube(QPainter &painter, QPointF center, double radius, const glm::dmat3 &axes,
                         const OverlayColors &colors);

/// Text with a dark outline, legible on any picture.
void drawText(QPainter &painter, const QRect &area, int flags, const QString &text,
              const QColor &color);

/// "1.2 ms", with two decimals below a millisecond.
QString millisecondsText(double ms);

} // namespace pellucid::ui
