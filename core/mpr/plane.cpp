// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpr/plane.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>

#include "core/task/error.h"
#include "core/volume/reasons.h"

namespace pellucid::mpr {

glm::dvec3 Axes::toViewer() const {
    return glm::cross(right, up);
}

Axes standardAxes(Orientation orientation) {
    switch (orientation) {
    case Orientation::axial:
        return {{1, 0, 0}, {0, -1, 0}};
    case Orientation::coronal:
        return {{1, 0, 0}, {0, 0, 1}};
    case Orientation::sagittal:
        break;
    }
    return {{0, 1, 0}, {0, 0, 1}};
}

glm::dvec3 scrollAxis(const Axes &axes, Orientation orientation) {
    return orientation == Orientation::sagittal ? axes.toViewer() : -axes.toViewer();
}

PlaneAxes::PlaneAxes() {
    for (const Orientation o : allOrientations)
        m_axes[std::size_t(o)] = standardAxes(o);
}

PlaneAxes::PlaneAxes(const std::array<Axes, 3> &axes) : m_axes(axes) {
    // A tolerance for many small rotations, written with all digits.
    constexpr double rounding = 1e-6;
    double worst = 0.0;
    for (std::size_t n = 0; n < 3; ++n) {
        const Axes &a = axes[n], &next = axes[(n + 1) % 3];
        for (const double off : {glm::dot(a.right, a.right) - 1.0, glm::dot(a.up, a.up) - 1.0,
                                 glm::dot(a.right, a.up), glm::dot(a.toViewer(), next.toViewer())})
            worst = std::isfinite(off) ? std::max(worst, std::abs(off)) : 1.0;
    }
    if (worst > rounding)
        throw task::Error(task::ErrorCode::usage, task::because::planesNotAtRightAngles);
}

glm::dvec3 PlaneAxes::scrollAxis(Orientation orientation) const {
    return mpr::scrollAxis(of(orientation), orientation);
}

PlaneAxes PlaneAxes::turned(Orientation about, double angleRad) const {
    const glm::dquat turn = glm::angleAxis(angleRad, of(about).toViewer());
    PlaneAxes out = *this;
    for (const Orientation o : allOrientations) {
        if (o == about)
            continue;
        // Makes the axes orthonormal again, because the errors of many small rotations add up.
        Axes &axes = out.m_axes[std::size_t(o)];
        axes.right = glm::normalize(turn * axes.right);
        const glm::dvec3 up = turn * axes.up;
        axes.up = glm::normalize(up - glm::dot(up, axes.right) * axes.right);
    }
    return out;
}

PlaneAxes PlaneAxes::facing(const Axes &wanted) const {
    glm::dvec3 normal = wanted.toViewer();
    Orientation nearest = Orientation::axial;
    for (const Orientation o : allOrientations)
        if (std::abs(glm::dot(of(o).toViewer(), normal)) >
            std::abs(glm::dot(of(nearest).toViewer(), normal)))
            nearest = o;
    const glm::dvec3 from = of(nearest).toViewer();
    if (glm::dot(from, normal) < 0.0)
        normal = -normal;
    const glm::dquat turn = glm::rotation(from, normal);
    PlaneAxes out = *this;
    for (Axes &axes : out.m_axes)
        axes = {glm::normalize(turn * axes.right), glm::normalize(turn * axes.up)};
    return out;
}

PlaneAxes PlaneAxes::along(const volume::Lattice &lattice) {
    const glm::dvec3 row = glm::normalize(lattice.step(0));
    const glm::dvec3 across = lattice.step(1) - glm::dot(lattice.step(1), row) * row;
    const glm::dvec3 column = glm::normalize(across);
    PlaneAxes out = PlaneAxes().facing({row, column});
    // Rotates the plane parallel to the slices about its normal, so that its rows follow an axis
    // of the scan.
    for (const Axes &axes : out.m_axes) {
        const glm::dvec3 normal = axes.toViewer();
        if (std::abs(glm::dot(normal, glm::cross(row, column))) < 0.9)
            continue;
        glm::dvec3 right = row;
        for (const glm::dvec3 &side : {-row, column, -column})
            if (glm::dot(side, axes.right) > glm::dot(right, axes.right))
                right = side;
        const double angle = std::atan2(glm::dot(glm::cross(axes.right, right), normal),
                                        glm::dot(axes.right, right));
        const glm::dquat turn = glm::angleAxis(angle, normal);
        for (Axes &a : out.m_axes)
            a = {glm::normalize(turn * a.right), glm::normalize(turn * a.up)};
        break;
    }
    return out;
}

volume::PatientPoint Plane::at(double column, double row) const {
    const double u = (column - 0.5 * (width - 1)) * pixelMm,
                 v = (0.5 * (height - 1) - row) * pixelMm;
    return {center.mm + u * axes.right + v * axes.up};
}

glm::dvec2 Plane::pixel(volume::PatientPoint point) const {
    const glm::dvec3 d = point.mm - center.mm;
    return {glm::dot(d, axes.right) / pixelMm + 0.5 * (width - 1),
            0.5 * (height - 1) - glm::dot(d, axes.up) / pixelMm};
}

double ScrollRange::moved(double positionMm, int steps) const {
    double wanted = positionMm + steps * stepMm;
    if (hasSlices)
        wanted = lowMm + std::round((wanted - lowMm) / stepMm) * stepMm;
    return std::clamp(wanted, lowMm, highMm);
}

ScrollRange scrollRange(const volume::Lattice &lattice, const glm::dvec3 &normal) {
    const volume::GridSize n = lattice.size();
    const double origin = glm::dot(lattice.origin().mm, normal);
    ScrollRange range{origin, origin, 0.0};
    int within = 0, across = 0;
    for (int d = 0; d < 3; ++d) {
        const double along = glm::dot(lattice.step(d), normal);
        const double reach = (n[d] - 1) * along;
        (reach < 0.0 ? range.lowMm : range.highMm) += reach;
        // A step within the plane, up to the rounding of directions in files.
        if (std::abs(along) < 1e-5 * lattice.spacingMm(d))
            ++within;
        else
            across = d;
        // The step closest to the normal counts; the others are within the slice.
        if (std::abs(along) >= 0.7 * lattice.spacingMm(d))
            range.stepMm = std::max(range.stepMm, std::abs(along));
    }
    range.hasSlices = within == 2;
    if (range.hasSlices)
        range.stepMm = std::abs(glm::dot(lattice.step(across), normal));
    else if (range.stepMm == 0.0)
        range.stepMm = lattice.shortestStepMm();
    return range;
}

} // namespace pellucid::mpr
