// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/decoding/client/instance.h"
#include "core/task/reason.h"
#include "core/volume/value_unit.h"

namespace pellucid::dicom {

/// How the stored values of a PET series become SUV.
struct UptakeScale {
    volume::ValueUnit unit = volume::ValueUnit::none;
    double factor = 1.0; ///< of the values after their rescale
    /// Why the values are not standardised uptake values; not set if they are.
    std::optional<task::Reason> notUptake;
};

/// The standardised uptake value by body weight: activity concentration times weight, divided by
/// the injected activity, which has decayed to the time that the concentrations refer to.
/// *Shape*: `files`: of the whole series, at least one. *Source*: PS3.3, C.8.9.1; for the time that
/// a decay correction to the start refers to, QIBA FDG-PET/CT, appendix G.
UptakeScale uptakeScale(const std::vector<const decoding::InstanceHeader *> &files);

/// Seconds from a fixed day to a date "YYYYMMDD" and a time "HHMMSS.FFF", of which the
/// end may be missing; none if they cannot be read. Only differences have a meaning.
std::optional<double> secondsAt(const std::string &date, const std::string &time);

} // namespace pellucid::dicom
