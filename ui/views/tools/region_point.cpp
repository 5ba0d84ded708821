// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/region_point.h"

#include <glm/common.hpp>

#include "core/classify/crop_box.h"
#include "core/mpr/highest_along.h"
#include "ui/document/document.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

std::optional<volume::PatientPoint> regionPoint(const Document &document, const ToolPane &pane,
                                                PaneView view, const QPointF &at) {
    const volume::Volume &volume = *document.volume();
    const volume::Lattice &lattice = volume.lattice();
    const PaneMapping mapping = pane.mapping();
    const volume::PatientPoint point = mapping.patientAt(at);
    if (view == PaneView::projection)
        return mpr::highestAlong(volume, classify::samplesIn(document.scene().crop, lattice.size()), point,
                                 mapping.plane.axes.toViewer());
    const glm::dvec3 v = glm::round(lattice.voxel(point).v);
    const volume::GridSize n = lattice.size();
    const bool isInside =
        v.x >= 0.0 && v.y >= 0.0 && v.z >= 0.0 && v.x < n.i && v.y < n.j && v.z < n.k;
    return isInside ? std::optional(point) : std::nullopt;
}

} // namespace pellucid::ui
