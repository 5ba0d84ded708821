// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace pellucid::volume {

/// The unit of a volume's values. `uptake`: standardised uptake value, normalised by body weight
/// (g/ml). `activity`: activity concentration.
enum class ValueUnit { none, hounsfield, uptake, activity };

/// Whether a value means the same in every study, so that fixed windows and thresholds apply.
inline bool isCalibrated(ValueUnit unit) {
    return unit == ValueUnit::hounsfield || unit == ValueUnit::uptake;
}

/// "HU", "SUV", "Bq/ml", or nothing; the same in all languages.
inline std::string_view unitName(ValueUnit unit) {
    switch (unit) {
    case ValueUnit::hounsfield:
        return "HU";
    case ValueUnit::uptake:
        return "SUV";
    case ValueUnit::activity:
        return "Bq/ml";
    case ValueUnit::none:
        break;
    }
    return {};
}

} // namespace pellucid::volume
