// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/classify/density_field.h"
#include "core/phantom/phantom.h"

namespace pellucid::bench {

/// A field under test.
struct Subject {
    std::string name;
    classify::DensityField field;
};

/// White noise without a mean in the inscribed sphere: a flat spectrum, so that no frequency is
/// favoured. *Units*: field values -1..1.
Subject noiseSphere(int n);
/// The same over the whole lattice, to its corners.
Subject noiseCube(int n);
/// A phantom through the default window.
Subject phantomSubject(const std::string &name, phantom::Kind kind,
                       const phantom::Sampling &sampling);
/// Values as they are, NaN and infinities dropped or clamped as ever.
Subject fieldSubject(const std::string &name, const volume::Volume &values,
                     const classify::FieldWindow &window = {0.0, 1.0});

} // namespace pellucid::bench
