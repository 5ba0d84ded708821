// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QPointF>

#include "core/volume/lattice.h"

namespace pellucid::ui {

class Document;
class ToolPane;

/// The kind of a pane: a plane of the volume, or its projection.
enum class PaneView { plane, projection };

/// The place in the patient that a click refers to: in a plane the point itself, in a
/// projection the highest value on the line of sight within the crop box. None outside the volume.
std::optional<volume::PatientPoint> regionPoint(const Document &document, const ToolPane &pane,
                                                PaneView view, const QPointF &at);

} // namespace pellucid::ui
