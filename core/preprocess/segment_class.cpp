// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/segment_class.h"

#include <cmath>

#include <glm/gtx/color_space.hpp>

#include "core/preprocess/class_region.h"

namespace pellucid::preprocess {

namespace {

// Hues a golden angle apart: any number of them in a row are far from each other.
glm::dvec3 distinctColor(std::size_t index) {
    constexpr double goldenAngle = 137.50776405003785, saturation = 0.6, brightness = 1.0;
    return glm::rgbColor(
        glm::dvec3(std::fmod(goldenAngle * double(index), 360.0), saturation, brightness));
}

} // namespace

classify::TissueClass classOf(const segment::Segment &segment, std::size_t index) {
    const glm::dvec3 color = segment.color.value_or(distinctColor(index));
    classify::TissueClass tissue;
    tissue.name = tissue.segment = segment.name;
    tissue.low = classify::lowestValue;
    tissue.high = classify::highestValue;
    tissue.edge = classify::defaultEdge;
    tissue.color = {color.x, color.y, color.z};
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
