// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

namespace pellucid::classify {

/// A number that a step takes.
struct StepParameter {
    std::string name, unit;
    double low = 0.0, high = 1.0; ///< its range
    double usual = 0.0;
    bool isWhole = false;
    std::string what;
};

/// Whether a step changes the values that a class looks at, or where the class may be.
enum class StepEffect { values, region };

/// A kind of image processing that comes before a class. *Source*: Cheng 2007, section 3.1.
struct StepKind {
    std::string name;
    StepEffect effect;
    std::string what;
    std::vector<StepParameter> parameters;
};

/// gaussian, median, diffusion, gradient; threshold, edges, binarise, opening, closing, largest,
/// body, skin.
const std::vector<StepKind> &stepKinds();
/// *Throws* Error{usage} with the names there are.
const StepKind &stepKind(const std::string &name);

/// One step of a class: what to do, and the parameters that are not the usual ones.
struct Step {
    std::string kind;
    std::map<std::string, double> parameters;
    bool operator==(const Step &) const = default;

    /// The value given, or the usual one.
    double at(const std::string &parameter) const;
};

/// *Throws* Error{usage} for a step or a parameter that is not known, and for one out of its range.
void validate(const Step &step);

/// A step as "edges(sigma_mm=1.5,low=20)", the usual values left out; and back. *Throws*
/// Error{usage}.
std::string stepText(const Step &step);
Step stepFromText(const std::string &text);

} // namespace pellucid::classify
