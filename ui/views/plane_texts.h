// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/mpr/reslice.h"
#include "ui/views/overlay.h"
#include "ui/views/pane_mapping.h"

class QPainter;
class QRect;

namespace pellucid::ui {

class Document;

/// The name of a plane, in the user's language.
QString planeTitle(mpr::Orientation orientation);

/// Position and value for the status bar; empty outside the volume.
QString valueText(const volume::Volume &volume, volume::PatientPoint at,
                  mpr::Interpolation interpolation);

/// The place where the texts of a plane appear.
enum class TextsFor {
    pane,   ///< warnings are a mark
    picture ///< an exported one: with the words of its warnings, as far as names allow
};

/// Paints the texts over a plane: name, position, slice, window, slab, orientation letters, scale
/// and warnings; over a picture also its purpose and, unless empty, the patient.
void paintPlaneTexts(QPainter &painter, const QRect &area, const PaneMapping &mapping,
                     const Document &document, mpr::Orientation orientation, TextsFor reader,
                     Names names = Names::shown, const QString &patient = {});

} // namespace pellucid::ui
