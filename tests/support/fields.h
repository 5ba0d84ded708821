// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "core/classify/density_field.h"
#include "core/volume/volume.h"

namespace pellucid::test {

/// |a - b| / |b| over all samples.
template <class A, class B> double relativeL2(const A &a, const B &b) {
    double difference = 0.0, norm = 0.0;
    for (std::size_t n = 0; n < b.size(); ++n) {
        difference += (double(a[n]) - double(b[n])) * (double(a[n]) - double(b[n]));
        norm += double(b[n]) * double(b[n]);
    }
    return norm > 0.0 ? std::sqrt(difference / norm) : std::sqrt(difference);
}

/// A lattice with steps of the given lengths, sheared by a gantry tilt about x.
inline volume::Lattice tiltedLattice(volume::GridSize size, glm::dvec3 spacingMm, double tiltDeg) {
    const double tilt = glm::radians(tiltDeg);
    return volume::Lattice::make(size, {{-11.0, 7.0, 3.0}},
                                 {spacingMm.x * glm::dvec3(1, 0, 0),
                                  spacingMm.y * glm::dvec3(0, std::cos(tilt), -std::sin(tilt)),
                                  spacingMm.z / std::cos(tilt) * glm::dvec3(0, 0, 1)});
}

/// A volume whose samples are a function of their place in the patient.
template <class F>
volume::Volume volumeOf(const volume::Lattice &lattice, const F &value,
                        volume::ValueUnit unit = volume::ValueUnit::none) {
    std::vector<float> samples;
    const volume::GridSize n = lattice.size();
    for (int k = 0; k < n.k; ++k)
        for (int j = 0; j < n.j; ++j)
            for (int i = 0; i < n.i; ++i)
                samples.push_back(float(value(lattice.patient(volume::VoxelIndex{i, j, k}).mm)));
    return {lattice, std::move(samples), unit};
}

/// White noise in 0..1 over the whole lattice: a field that reaches its faces and corners.
inline classify::DensityField noiseField(const volume::Lattice &lattice, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<float> samples(lattice.size().count());
    for (float &f : samples)
        f = uniform(random);
    return {volume::Volume(lattice, std::move(samples), volume::ValueUnit::none), lattice.bounds()};
}

inline glm::dquat randomOrientation(std::mt19937 &random) {
    std::normal_distribution<double> normal;
    return glm::normalize(
        glm::dquat(normal(random), normal(random), normal(random), normal(random)));
}

} // namespace pellucid::test
