// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/studies/study_facts.h"

namespace pellucid::ui {

/// Whether two studies are of one patient. Identifiers are unique within a hospital only.
enum class SamePatient { yes, perhaps, no };

/// `yes`: the same identifier, and the same birth date or name. `perhaps`: only the identifier is
/// the same, or only name and birth date are. Case, accents and spaces make no difference.
SamePatient samePatient(const StudyFacts &a, const StudyFacts &b);

} // namespace pellucid::ui
