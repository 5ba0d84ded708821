// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/volume/value_unit.h"

namespace pellucid::ui {

/// A number with up to `digits` significant digits and without an exponent: "30000", not "3e+04".
/// Zeros at the end of a fraction are left out.
QString numberText(double value, int digits = 4);

/// "HU", "SUV", "Bq/ml", or nothing.
QString unitText(volume::ValueUnit unit);
/// The same behind a number: with a space before it, unless it is empty.
QString unitSuffix(volume::ValueUnit unit);

} // namespace pellucid::ui
