// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

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
    body,
    skin
};

/// Whether a step changes the values that classify samples, or the region of the class.
enum class StepEffect { values, region };

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
};

/// The descriptions of all kinds, in the order of the user interface.
const std::vector<StepDescription> &stepDescriptions();
/// The description of one kind.
const StepDescription &describe(StepKind kind);
/// *Throws* Error{usage} listing the valid names.
StepKind stepKindNamed(const std::string &name);

/// One step of a class: its kind, and the parameters that differ from their defaults.
struct Step {
    StepKind kind = StepKind::gaussian;
    std::map<std::string, double> parameters;
    bool operator==(const Step &) const = default;

    /// The parameter's value, or its default. *Throws* Error{usage} for a parameter that the step
    /// does not have.
    double at(const std::string &parameter) const;
};

/// *Throws* Error{usage} for an unknown parameter or one out of range.
void validate(const Step &step);

/// A step as "edges(sigma_mm=1.5,low=20)", without defaults; and the reverse. *Throws*
/// Error{usage}.
std::string stepText(const Step &step);
Step stepFromText(const std::string &text);

} // namespace pellucid::classify
