// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/classify/tissue_class.h"

namespace pellucid::ui {

/// The name of a kind of step, as menus show it: "Without another class".
QString stepName(classify::StepKind kind);

/// Describes a step and its numbers in a few words: "without Bone", "grown by 2 mm".
QString stepWords(const classify::Step &step);

/// Where a class starts: its segment, the range of its values, or nothing.
QString sourceWords(const classify::TissueClass &tissue);

/// The meaning of a parameter of a step, with its unit.
QString parameterText(const classify::StepParameter &parameter);

} // namespace pellucid::ui
