// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/region_point.h"

#include <algorithm>

#include <glm/common.hpp>

#include "core/classify/crop_box.h"
#include "core/mpr/highest_along.h"
#include "ui/document/document.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

namespace {

// The region of the selected class, if parts were removed from it: what is hidden is not meant. Of
// other looks, all samples may be meant.
const volume::Coverage *shownPart(const Document &document) {
    const RegionMarking &marking = document.marking();
    const int selected = document.selectedClass();
    if (!marking.tint() || marking.isSearching() || marking.candidate() || selected < 0)
        return nullptr;
    const classify::TissueClass &tissue = document.scene().look.classes[std::size_t(selected)];
    const bool hides = std::any_of(tissue.steps.begin(), tissue.steps.end(), [](const auto &step) {
        return step.kind == classify::StepKind::difference ||
               step.kind == classify::StepKind::scissors || step.kind == classify::StepKind::body;
    });
    return hides && tissue.weight > 0.0 ? marking.tint()->coverage.get() : nullptr;
}

} // namespace

std::optional<volume::PatientPoint> regionPoint(const Document &document, const ToolPane &pane,
                                                PaneView view, const QPointF &at) {
    const volume::Volume &volume = *document.volume();
    const volume::Lattice &lattice = volume.lattice();
    const PaneMapping mapping = pane.mapping();
    const volume::PatientPoint point = mapping.patientAt(at);
    if (view == PaneView::projection)
        return mpr::highestAlong(volume, classify::samplesIn(document.scene().crop, lattice.size()),
                                 point, mapping.plane.axes.toViewer(), shownPart(document));
    const glm::dvec3 v = glm::round(lattice.voxel(point).v);
    const volume::GridSize n = lattice.size();
    const bool isInside =
        v.x >= 0.0 && v.y >= 0.0 && v.z >= 0.0 && v.x < n.i && v.y < n.j && v.z < n.k;
    return isInside ? std::optional(point) : std::nullopt;
}

} // namespace pellucid::ui
