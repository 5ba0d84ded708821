// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

#include "core/measure/measurement.h"

namespace pellucid::ui {

/// "at the detector", in the user's language; empty for lengths in the patient.
QString spacingPlaceText(volume::SpacingPlace place);

/// "Distance", in the user's language.
QString kindText(const measure::Measurement &measurement);

/// The main figure with its unit: "12.3 mm", "45.2°", "36.1 HU".
QString mainFigure(const measure::Result &result, const volume::Volume &volume);

/// All figures, one per line, as shown beside the drawing.
QStringList allFigures(const measure::Measurement &measurement, const measure::Result &result,
                       const volume::Volume &volume);

} // namespace pellucid::ui
