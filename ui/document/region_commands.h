// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QString>

#include "core/classify/region_edits.h"

namespace pellucid::ui {

class Document;

// Edits of the look by the regions that the user marks, as the options of the marking say. Each is
// one edit, and selects the class that shows the region.

/// The class that a region tool edits: the selected one, or every class.
classify::EditedClass editedClass(const Document &document);

/// Uses a region that was found.
void useRegion(Document &document, const classify::TissueClass &region);
/// Cuts along the line of sight; a new class or an addition is what the cut encloses.
void useCut(Document &document, const classify::LassoCut &cut);
/// *Requires*: at least one stroke; all erase or none.
void useStrokes(Document &document, const std::vector<classify::Stroke> &strokes);
/// Adds a point to the selected class, and selects the next one that waits for points.
void usePoint(Document &document, volume::PatientPoint point);
/// Adds a step to the selected class.
void useStep(Document &document, const classify::Step &step, const QString &text);

/// Leaves out the couch in every class of the volume, or shows it again.
void setWithoutCouch(Document &document, bool isWithout);

/// If a class of the look waits for points, selects it and asks for the tool that adds points.
void askForPoints(Document &document);

} // namespace pellucid::ui
