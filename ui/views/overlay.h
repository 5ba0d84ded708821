// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QColor>
#include <QRect>
#include <QRegion>
#include <QString>
#include <QStringList>

#include <glm/mat3x3.hpp>

#include "core/volume/volume.h"

class QPainter;

namespace pellucid::ui {

/// Colors of overlays; they depend on the picture, not on the theme.
struct OverlayColors {
    QColor plane, letters, text, muted, raised, accent, warning, curve;
};

/// The dark theme's colors, with the plane's own by its role in resources/styles/colors.json.
OverlayColors overlayColors(const QString &planeRole);

/// The light theme's, for pictures that are shown as film, dark on light.
OverlayColors filmColors(const QString &planeRole);

/// Whether texts may contain names: file names and names of looks can identify a patient.
enum class Names { shown, hidden };

/// Which annotations a pane shows over its picture.
struct Overlays {
    bool texts = true; ///< and letters, scale, measurements, warnings
    bool crosshair = true;
    bool operator==(const Overlays &) const = default;
};

/// Whether a volume is shown while it arrives. Its warning says how much of it is there, and is
/// always shown in words.
bool isPartial(const volume::VolumeNotes &notes);
/// The first `most` warnings of a volume, one per line. With hidden names, only a note that there
/// are warnings.
QStringList warningLines(const volume::VolumeNotes &notes, Names names, std::size_t most);

/// Draws the orientation letters at the middle of each side, for an image with these axes (LPS).
void drawOrientationLetters(QPainter &painter, const QRect &area, const glm::dvec3 &right,
                            const glm::dvec3 &up, const OverlayColors &colors);

/// The area of the upper and lower letters, which other drawing must not cross.
QRegion upperAndLowerLetters(const QRect &area);

/// Draws a bar of a round length with its left end at `bottomLeft`. *Units*: logical pixels per mm.
void drawScaleBar(QPainter &painter, QPoint bottomLeft, double pixelsPerMm, int longestPixels,
                  const OverlayColors &colors);

/// The side of the cube at a position: a face, an edge between two or a corner; none beside the
/// cube. Its direction has components -1, 0 and 1.
std::optional<glm::dvec3> cubeSideAt(const QPointF &at, QPointF center, double radius,
                                     const glm::dmat3 &axes);
/// Draws a cube with the patient's letters as the viewer sees it; `axes` are [U V W].
void drawOrientationCube(QPainter &painter, QPointF center, double radius, const glm::dmat3 &axes,
                         const OverlayColors &colors);

/// The place of the warning mark of a pane.
QRect warningMarkRect(const QRect &area);
/// Draws a small sign with the number of warnings about the volume. Their texts are in the list of
/// studies and in the tooltip of the mark.
void drawWarningMark(QPainter &painter, const QRect &area, std::size_t count,
                     const OverlayColors &colors);

/// Draws text with an outline, legible on any picture.
void drawText(QPainter &painter, const QRect &area, int flags, const QString &text,
              const QColor &color);

/// "1.2 ms", with two decimals below a millisecond.
QString millisecondsText(double ms);

} // namespace pellucid::ui
