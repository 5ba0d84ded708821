// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/classify/density_field.h"
#include "core/phantom/phantom.h"

namespace pellucid::bench {

/// A field under test.
struct Subject {
    std::string name;
    classify::DensityField field;
};

/// White noise with zero mean in the inscribed sphere: its spectrum is flat, so that no frequency
/// is favoured. *Units*: field values -1..1.
Subject noiseSphere(int n);
/// A phantom through the default window.
Subject phantomSubject(const std::string &name, phantom::Kind kind,
                       const phantom::Sampling &sampling);
/// Fields that break projectors (metal, faces and corners, odd sizes, tilt, thick slices, a single
/// voxel, empty, NaN, a range of 2^16, cancelling weights, extreme spacings), small enough for the
/// exact reference.
struct HardSubject {
    std::string name;
    std::function<classify::DensityField()> make;
};
const std::vector<HardSubject> &hardSubjects();

} // namespace pellucid::bench
