// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/step.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/task/error.h"

namespace pellucid::classify {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

// No end: as large as single precision bears squares of.
constexpr double open = 1e15;

const StepParameter *find(const StepKind &kind, const std::string &name) {
    const auto found = std::find_if(kind.parameters.begin(), kind.parameters.end(),
                                    [&](const StepParameter &p) { return p.name == name; });
    return found == kind.parameters.end() ? nullptr : &*found;
}

const StepParameter &parameterOf(const StepKind &kind, const std::string &name) {
    if (const StepParameter *found = find(kind, name))
        return *found;
    std::string names;
    for (const StepParameter &p : kind.parameters)
        names += (names.empty() ? "" : ", ") + p.name;
    throw Error(ErrorCode::usage, names.empty()
                                      ? because::stepHasNoParameters(kind.name)
                                      : because::stepHasOtherParameters(name, kind.name, names));
}

} // namespace

const std::vector<StepKind> &stepKinds() {
    static const StepParameter byItk{"itk", "", 0.0, 1.0, 0.0, true, "1: by ITK's filters, slower"};
    static const std::vector<StepKind> kinds{
        {"gaussian",
         StepEffect::values,
         "Smooths with a Gaussian",
         {{"sigma_mm", "mm", 0.1, 20.0, 1.0, false, "Standard deviation"}}},
        {"median",
         StepEffect::values,
         "Median of the neighbourhood: removes specks, keeps edges",
         {{"radius_mm", "mm", 0.1, 10.0, 1.0, false, "Half the side of the neighbourhood"}}},
        {"diffusion",
         StepEffect::values,
         "Curvature anisotropic diffusion: smooths along edges, not across them",
         {{"iterations", "", 1.0, 50.0, 5.0, true, "Number of iterations"},
          {"conductance", "", 0.5, 10.0, 3.0, false, "The lower, the more edges are kept"}}},
        {"gradient",
         StepEffect::values,
         "Magnitude of the gradient, value units per mm",
         {{"sigma_mm", "mm", 0.0, 20.0, 1.0, false, "Smoothing beforehand"}}},
        {"threshold",
         StepEffect::region,
         "Only where the value is within a hard range",
         {{"low", "value units", -open, open, -open, false, "Least value"},
          {"high", "value units", -open, open, open, false, "Greatest value"}}},
        {"edges",
         StepEffect::region,
         "Canny edges, shown with a density of one",
         {{"sigma_mm", "mm", 0.0, 20.0, 1.0, false, "Smoothing beforehand"},
          {"low", "value units per mm", 0.0, open, 20.0, false, "An edge goes on above this"},
          {"high", "value units per mm", 0.0, open, 60.0, false, "An edge starts above this"},
          byItk}},
        {"binarise",
         StepEffect::region,
         "A density of one from a value on, and none below",
         {{"from", "value units", -open, open, 0.0, false, "Least value"}}},
        {"opening",
         StepEffect::region,
         "Removes what is thinner than a ball",
         {{"radius_mm", "mm", 0.1, 30.0, 2.0, false, "Radius of the ball"}, byItk}},
        {"closing",
         StepEffect::region,
         "Fills what a ball does not fit into",
         {{"radius_mm", "mm", 0.1, 30.0, 2.0, false, "Radius of the ball"}, byItk}},
        {"largest",
         StepEffect::region,
         "Only the largest connected part, or all that are not much smaller",
         {{"share", "", 0.001, 1.0, 1.0, false, "Least size of a part, of the largest"}}},
        {"body",
         StepEffect::region,
         "Only the patient: without the couch and the air around",
         {{"margin_mm", "mm", 0.0, 30.0, 2.0, false, "What is left around the skin"}}},
        {"skin",
         StepEffect::region,
         "Only the surface of the patient",
         {{"depth_mm", "mm", 0.5, 30.0, 4.0, false, "How far it reaches in"},
          {"margin_mm", "mm", 0.0, 30.0, 2.0, false, "And out"}}}};
    return kinds;
}

const StepKind &stepKind(const std::string &name) {
    std::string names;
    for (const StepKind &kind : stepKinds()) {
        if (kind.name == name)
            return kind;
        names += (names.empty() ? "" : ", ") + kind.name;
    }
    throw Error(ErrorCode::usage, because::stepIsUnknown(name, names));
}

double Step::at(const std::string &parameter) const {
    const auto given = parameters.find(parameter);
    return given != parameters.end() ? given->second : parameterOf(stepKind(kind), parameter).usual;
}

void validate(const Step &step) {
    const StepKind &kind = stepKind(step.kind);
    const auto number = [](double n) { return fmt::format("{:g}", n); };
    for (const auto &[name, value] : step.parameters) {
        const StepParameter &p = parameterOf(kind, name);
        if (!(value >= p.low && value <= p.high))
            throw Error(ErrorCode::usage,
                        because::stepParameterOutOfRange(name, kind.name, number(value),
                                                         number(p.low), number(p.high)));
        if (p.isWhole && value != std::round(value))
            throw Error(ErrorCode::usage,
                        because::stepParameterNotWhole(name, kind.name, number(value)));
    }
    if (find(kind, "low") != nullptr && step.at("low") > step.at("high"))
        throw Error(ErrorCode::usage, because::stepLowAboveHigh(kind.name));
}

std::string stepText(const Step &step) {
    std::string inside;
    for (const auto &[name, value] : step.parameters)
        if (value != parameterOf(stepKind(step.kind), name).usual)
            inside += fmt::format("{}{}={}", inside.empty() ? "" : ",", name, value);
    return inside.empty() ? step.kind : step.kind + "(" + inside + ")";
}

Step stepFromText(const std::string &text) {
    const auto open = text.find('(');
    Step step{text.substr(0, open), {}};
    if (open != std::string::npos) {
        if (text.back() != ')')
            throw Error(ErrorCode::usage, because::stepHasNoBracket(text));
        std::string rest = text.substr(open + 1, text.size() - open - 2);
        while (!rest.empty()) {
            const auto comma = rest.find(',');
            const std::string item = rest.substr(0, comma);
            rest = comma == std::string::npos ? std::string() : rest.substr(comma + 1);
            const auto equals = item.find('=');
            const std::string number =
                equals == std::string::npos ? std::string() : item.substr(equals + 1);
            // Not strtod: the machine's language does not change a file's decimal sign.
            double value = 0.0;
            const char *const end = number.data() + number.size();
            const auto read = std::from_chars(number.data(), end, value);
            if (number.empty() || read.ec != std::errc() || read.ptr != end)
                throw Error(ErrorCode::usage, because::stepHasNoNumber(item, text));
            step.parameters[item.substr(0, equals)] = value;
        }
    }
    validate(step);
    return step;
}

} // namespace pellucid::classify
