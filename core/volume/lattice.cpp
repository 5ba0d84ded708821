// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/volume/lattice.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/task/error.h"
#include "core/volume/reasons.h"

namespace pellucid::volume {

VoxelBox united(const VoxelBox &a, const VoxelBox &b) {
    if (a.hi.i <= a.lo.i)
        return b;
    if (b.hi.i <= b.lo.i)
        return a;
    return {{std::min(a.lo.i, b.lo.i), std::min(a.lo.j, b.lo.j), std::min(a.lo.k, b.lo.k)},
            {std::max(a.hi.i, b.hi.i), std::max(a.hi.j, b.hi.j), std::max(a.hi.k, b.hi.k)}};
}

namespace {

// Keeps products of sizes far below 2^64.

bool finite(const glm::dvec3 &v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

Lattice Lattice::make(GridSize size, PatientPoint origin, const std::array<glm::dvec3, 3> &steps) {
    using task::Error;
    using task::ErrorCode;
    if (size.i < 1 || size.j < 1 || size.k < 1)
        throw Error(ErrorCode::unusable, task::because::axisWithoutSamples);
    if (double(size.i) * size.j * size.k > double(maxSamples))
        throw Error(ErrorCode::unusable, task::because::moreSamplesThanAnyMachineHolds);
    if (!finite(origin.mm) || !finite(steps[0]) || !finite(steps[1]) || !finite(steps[2]))
        throw Error(ErrorCode::unusable, task::because::geometryNotFinite);
    const double lengths = glm::length(steps[0]) * glm::length(steps[1]) * glm::length(steps[2]);
    Lattice lattice;
    lattice.m_size = size;
    lattice.m_origin = origin.mm;
    lattice.m_steps = glm::dmat3(steps[0], steps[1], steps[2]);
    // Steps within 1e-6 of a common plane cannot be distinguished from a flat volume.
    if (!(lengths > 0.0) || std::abs(glm::determinant(lattice.m_steps)) < 1e-6 * lengths)
        throw Error(ErrorCode::unusable, task::because::stepsSpanNoVolume);
    lattice.m_inverse = glm::inverse(lattice.m_steps);
    return lattice;
}

Lattice Lattice::centred(GridSize size, glm::dvec3 s) {
    const glm::dvec3 last(size.i - 1, size.j - 1, size.k - 1);
    return make(size, {-0.5 * last * s},
                {glm::dvec3(s.x, 0, 0), glm::dvec3(0, s.y, 0), glm::dvec3(0, 0, s.z)});
}

double Lattice::spacingMm(int axis) const {
    return glm::length(m_steps[axis]);
}

double Lattice::shortestStepMm() const {
    return std::min({spacingMm(0), spacingMm(1), spacingMm(2)});
}

double Lattice::longestStepMm() const {
    return std::max({spacingMm(0), spacingMm(1), spacingMm(2)});
}

double Lattice::cellVolumeMm3() const {
    return std::abs(glm::determinant(m_steps));
}

glm::dvec3 Lattice::sliceNormal() const {
    return glm::normalize(glm::cross(m_steps[0], m_steps[1]));
}

double Lattice::sliceDistanceMm() const {
    return std::abs(glm::dot(sliceNormal(), m_steps[2]));
}

double Lattice::shearRad() const {
    return std::acos(std::clamp(sliceDistanceMm() / spacingMm(2), 0.0, 1.0));
}

double Lattice::radiusMm() const {
    const glm::dvec3 a = double(m_size.i) * m_steps[0];
    const glm::dvec3 b = double(m_size.j) * m_steps[1];
    const glm::dvec3 c = double(m_size.k) * m_steps[2];
    return 0.5 * std::max({glm::length(a + b + c), glm::length(a + b - c), glm::length(a - b + c),
                           glm::length(a - b - c)});
}

PatientPoint Lattice::center() const {
    return patient(VoxelPoint{0.5 * glm::dvec3(m_size.i - 1, m_size.j - 1, m_size.k - 1)});
}

bool Lattice::contains(VoxelIndex n) const {
    return n.i >= 0 && n.j >= 0 && n.k >= 0 && n.i < m_size.i && n.j < m_size.j && n.k < m_size.k;
}

bool Lattice::fillsSameBox(const Lattice &other) const {
    const double limit = 0.1 * std::min(shortestStepMm(), other.shortestStepMm());
    const auto cornerOf = [](const Lattice &lattice, int number) {
        VoxelPoint corner;
        for (int axis = 0; axis < 3; ++axis)
            corner.v[axis] = ((number >> axis) & 1) != 0 ? lattice.size()[axis] - 0.5 : -0.5;
        return lattice.patient(corner).mm;
    };
    for (int number = 0; number < 8; ++number)
        if (glm::distance(cornerOf(*this, number), cornerOf(other, number)) > limit)
            return false;
    return true;
}

Lattice Lattice::cropped(const VoxelBox &box) const {
    assert(contains(box.lo) && contains({box.hi.i - 1, box.hi.j - 1, box.hi.k - 1}));
    Lattice part = *this;
    part.m_size = box.size();
    part.m_origin = patient(box.lo).mm;
    return part;
}

} // namespace pellucid::volume
