// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

namespace pellucid::classify {

/// The kinds of image processing that come before a class. *Source*: Cheng 2007, section 3.1.
enum class StepKind {
    gaussian,
    median,
    diffusion,
    gradient,
    threshold,
    edges,
    binarise,
    opening,
    closing,
    largestComponent,
    body,
    skin
};

/// Whether a step changes the values that a class looks at, or where the class may be.
enum class StepEffect { values, region };

/// A number that a step takes.
struct StepParameter {
    std::string name, unit;
    double minimum = 0.0, maximum = 1.0;
    double defaultValue = 0.0;
    bool isInteger = false;
    std::string text; ///< what it says, for the user
};

/// A kind of step as files and people name it.
struct StepDescription {
    StepKind kind;
    std::string name;
    StepEffect effect;
    std::string text; ///< what it does, for the user
    std::vector<StepParameter> parameters;
};

/// Of every kind, in the order that they are offered in.
const std::vector<StepDescription> &stepDescriptions();
/// That of one kind.
const StepDescription &describe(StepKind kind);
/// *Throws* Error{usage} with the names there are.
StepKind stepKindNamed(const std::string &name);

/// One step of a class: what to do, and the parameters that differ from their defaults.
struct Step {
    StepKind kind = StepKind::gaussian;
    std::map<std::string, double> parameters;
    bool operator==(const Step &) const = default;

    /// The value given, or the default. *Throws* Error{usage} for a parameter that the step does
    /// not have.
    double at(const std::string &parameter) const;
};

/// *Throws* Error{usage} for a parameter that is not known, and for one out of its range.
void validate(const Step &step);

/// A step as "edges(sigma_mm=1.5,low=20)", defaults left out; and back. *Throws* Error{usage}.
std::string stepText(const Step &step);
Step stepFromText(const std::string &text);

} // namespace pellucid::classify
