// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/segment_class.h"

#include "core/preprocess/class_region.h"

namespace pellucid::preprocess {

classify::TissueClass classOf(const segment::Segment &segment, std::size_t index) {
    classify::TissueClass tissue;
    tissue.name = tissue.segment = segment.name;
    tissue.low = classify::lowestValue;
    tissue.high = classify::highestValue;
    tissue.edge = classify::defaultEdge;
    tissue.color = segment.color
                       ? classify::Color{segment.color->x, segment.color->y, segment.color->z}
                       : classify::distinctColor(index);
    return tissue;
}

segment::Segment segmentOf(const volume::Volume &volume, const classify::TissueClass &tissue,
                           const segment::SegmentSet *loaded, classify::StepRunner &runner,
                           const task::Progress &progress) {
    segment::Segment segment;
    if (const segment::Segment *const own =
            loaded != nullptr ? loaded->find(tissue.segment) : nullptr) {
        segment.category = own->category;
        segment.type = own->type;
    }
    segment.name = tissue.name;
    segment.color = glm::dvec3(tissue.color.red, tissue.color.green, tissue.color.blue);
    segment.coverage =
        std::make_shared<const volume::Coverage>(regionOf(volume, tissue, runner, progress));
    segment.volumeMm3 = segment.coverage->total() * volume.lattice().cellVolumeMm3();
    return segment;
}

} // namespace pellucid::preprocess
