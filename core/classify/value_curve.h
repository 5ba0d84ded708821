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

/// What a value is shown as: f(value) m(value) B(f), the density, the membership of a class if
/// there is one, and a transfer function's weight.
class ValueCurve {
public:
    /// `shape`: B(f); none for 1.
    ValueCurve(const FieldWindow &window, DensityKind density, std::optional<TissueClass> tissue,
               const std::function<double(double)> &shape);

    /// NaN is 0.
    float at(float value, Region region = Region::inside) const;

private:
    float m_low, m_scale;
    DensityKind m_density;
    std::optional<TissueClass> m_tissue;
    std::vector<float> m_table; ///< f B(f) in equal steps; empty: f
};

/// A curve and its share of each channel.
struct WeightedCurve {
    ValueCurve curve;
    std::array<double, 3> weights{1.0, 1.0, 1.0};
};

/// sums[c] += weight_c curve(value) of every sample for each curve. *Shape*: a region of each
/// sample, or none for inside; one or three sums, each of the volume's count. *Throws* Cancelled.
void addCurves(const volume::Volume &volume, const std::vector<Region> *region,
               std::span<const WeightedCurve> curves, std::span<std::vector<float>> sums,
               const task::Progress &progress = {});

} // namespace pellucid::classify
