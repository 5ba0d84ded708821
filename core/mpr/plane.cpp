// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpr/plane.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace pellucid::mpr {

volume::PatientPoint Plane::at(double column, double row) const {
    const double u = (column - 0.5 * (width - 1)) * pixelMm,
                 v = (0.5 * (height - 1) - row) * pixelMm;
    return {center.mm + u * right + v * up};
}

glm::dvec2 Plane::pixel(volume::PatientPoint point) const {
    const glm::dvec3 d = point.mm - center.mm;
    return {glm::dot(d, right) / pixelMm + 0.5 * (width - 1),
            0.5 * (height - 1) - glm::dot(d, up) / pixelMm};
}

glm::dvec3 Plane::toViewer() const {
    return glm::cross(right, up);
}

bool Plane::operator==(const Plane &o) const {
    return center.mm == o.center.mm && right == o.right && up == o.up && pixelMm == o.pixelMm &&
           width == o.width && height == o.height;
}

void setAxes(Plane &plane, Orientation orientation) {
    switch (orientation) {
    case Orientation::axial:
        plane.right = {1, 0, 0};
        plane.up = {0, -1, 0};
        break;
    case Orientation::coronal:
        plane.right = {1, 0, 0};
        plane.up = {0, 0, 1};
        break;
    case Orientation::sagittal:
        plane.right = {0, 1, 0};
        plane.up = {0, 0, 1};
        break;
    }
}

glm::dvec3 scrollAxis(Orientation orientation) {
    switch (orientation) {
    case Orientation::axial:
        return {0, 0, 1};
    case Orientation::coronal:
        return {0, 1, 0};
    case Orientation::sagittal:
        break;
    }
    return {1, 0, 0};
}

ScrollRange scrollRange(const volume::Lattice &lattice, Orientation orientation) {
    const glm::dvec3 axis = scrollAxis(orientation);
    const volume::GridSize n = lattice.size();
    ScrollRange range{glm::dot(lattice.origin().mm, axis), glm::dot(lattice.origin().mm, axis),
                      0.0};
    for (int d = 0; d < 3; ++d) {
        const double reach = (n[d] - 1) * glm::dot(lattice.step(d), axis);
        (reach < 0.0 ? range.lowMm : range.highMm) += reach;
        // The step most nearly along the axis decides; the others move within the slice.
        if (std::abs(glm::dot(lattice.step(d), axis)) >= 0.7 * lattice.spacingMm(d))
            range.stepMm = std::max(range.stepMm, std::abs(glm::dot(lattice.step(d), axis)));
    }
    if (range.stepMm == 0.0)
        range.stepMm = lattice.shortestStepMm();
    return range;
}

} // namespace pellucid::mpr
