// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/classify/class_samples.h"
#include "core/classify/density_field.h"

namespace pellucid::classify {

/// Maps a value to what is shown: f(value) m(value) B(f), that is the density, times the membership
/// if there is a class, times the transfer function's weight.
class ValueCurve {
public:
    /// `shape`: B(f); null for 1. `range`: the width of the densities over which it changes.
    ValueCurve(const FieldWindow &window, DensityKind density, std::optional<TissueClass> tissue,
               const std::function<double(double)> &shape, double range = 1.0);

    /// NaN becomes 0.
    float at(float value, Region region = Region::inside) const;

private:
    float m_low, m_scale;
    DensityKind m_density;
    std::optional<TissueClass> m_tissue;
    std::vector<float> m_table; ///< f B(f) in equal steps; empty: f
};

/// A curve and its channel weights.
struct WeightedCurve {
    ValueCurve curve;
    std::array<double, 3> weights{1.0, 1.0, 1.0};
};

/// Adds for each curve and sample of a class: sums[c] += weight_c share curve(value). *Shape*: one
/// to three sums, each with the volume's number of samples. *Throws* Cancelled.
void addCurves(const ClassSamples &samples, std::span<const WeightedCurve> curves,
               std::span<std::vector<float>> sums, const task::Progress &progress = {});

} // namespace pellucid::classify
