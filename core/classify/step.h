// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/classify/hand_marks.h"
#include "core/classify/operand.h"

namespace pellucid::classify {

/// The kinds of image processing before classification. *Source*: Cheng 2007, section 3.1.
enum class StepKind {
    gaussian,
    median,
    diffusion,
    gradient,
    negate,
    threshold,
    edges,
    binarise,
    opening,
    closing,
    largestComponent,
    connected,
    grow,
    shrink,
    fill,
    body,
    skin,
    intersection,
    join,
    difference,
    paint,
    scissors
};

/// Whether a step changes the values that classify samples, or the region of the class.
enum class StepEffect { values, region };

/// The input of a step besides numbers: points, strokes or cuts from the user, or another class.
enum class StepInput { none, points, strokes, cuts, otherClass };

/// A numeric parameter of a step.
struct StepParameter {
    std::string name, unit;
    double minimum = 0.0, maximum = 1.0;
    double defaultValue = 0.0;
    bool isInteger = false;
    std::string text; ///< its meaning, for the user
};

/// A kind of step, with the names used in files and by the user.
struct StepDescription {
    StepKind kind;
    std::string name;
    StepEffect effect;
    std::string text; ///< its effect, for the user
    std::vector<StepParameter> parameters;
    StepInput input = StepInput::none;
};

/// The descriptions of all kinds, in the order of the user interface.
const std::vector<StepDescription> &stepDescriptions();
/// The description of one kind.
const StepDescription &describe(StepKind kind);
/// *Throws* Error{usage} listing the valid names.
StepKind stepKindNamed(const std::string &name);

/// One step of a class: its kind, the parameters that differ from their defaults, and the input of
/// its kind.
struct Step {
    StepKind kind = StepKind::gaussian;
    std::map<std::string, double> parameters{};
    /// Places in the patient. None: the step waits for the user's click and changes nothing.
    std::vector<volume::PatientPoint> points{};
    std::vector<Stroke> strokes{};
    std::vector<LassoCut> cuts{};
    Operand operand{};
    bool operator==(const Step &) const = default;

    /// The parameter's value, or its default. *Throws* Error{usage} for a parameter that the step
    /// does not have.
    double at(const std::string &parameter) const;
};

/// *Throws* Error{usage} for an unknown parameter or one out of range.
void validate(const Step &step);

/// A step's name and numbers as "edges(sigma_mm=1.5,low=20)", without defaults.
std::string stepText(const Step &step);

/// Whether the step waits for the user's click.
bool awaitsPoints(const Step &step);

} // namespace pellucid::classify
