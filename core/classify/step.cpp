// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/step.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/classify/reasons.h"
#include "core/task/error.h"

namespace pellucid::classify {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

// No limit: the largest value whose square fits single precision.
constexpr double open = 1e15;

const StepParameter *find(const StepDescription &step, const std::string &name) {
    const auto found = std::find_if(step.parameters.begin(), step.parameters.end(),
                                    [&](const StepParameter &p) { return p.name == name; });
    return found == step.parameters.end() ? nullptr : &*found;
}

const StepParameter &parameterOf(const StepDescription &step, const std::string &name) {
    if (const StepParameter *found = find(step, name))
        return *found;
    std::string names;
    for (const StepParameter &p : step.parameters)
        names += (names.empty() ? "" : ", ") + p.name;
    throw Error(ErrorCode::usage, names.empty()
                                      ? because::stepHasNoParameters(step.name)
                                      : because::stepHasOtherParameters(name, step.name, names));
}

bool isFinite(const volume::PatientPoint &point) {
    return std::isfinite(point.mm.x) && std::isfinite(point.mm.y) && std::isfinite(point.mm.z);
}

template <class Points> void requirePoints(const Points &points, std::size_t least) {
    if (points.size() < least || points.size() > maxPoints)
        throw Error(ErrorCode::usage, because::pointsOutOfRange(points.size(), least, maxPoints));
    if (!std::all_of(points.begin(), points.end(), isFinite))
        throw Error(ErrorCode::usage, because::pointIsNotFinite);
}

void validateInput(const Step &step, const StepDescription &description) {
    requirePoints(step.points, 0);
    const auto requireAtMost = [&](std::size_t count) {
        if (count > maxStrokes)
            throw Error(ErrorCode::usage,
                        because::hasTooManyStrokes(description.name, count, maxStrokes));
    };
    requireAtMost(step.strokes.size());
    requireAtMost(step.cuts.size());
    for (const Stroke &stroke : step.strokes)
        validate(stroke);
    for (const LassoCut &cut : step.cuts)
        validate(cut);
    if (description.input == StepInput::otherClass && step.operand.name.empty() &&
        step.operand.own == nullptr)
        throw Error(ErrorCode::usage, because::stepNeedsAClass(description.name));
}

} // namespace

void validate(const Stroke &stroke) {
    requirePoints(stroke.path, 1);
    if (!(stroke.radiusMm >= smallestBallMm && stroke.radiusMm <= largestBallMm))
        throw Error(ErrorCode::usage, because::ballOutOfRange(fmt::format("{:g}", stroke.radiusMm),
                                                              fmt::format("{:g}", smallestBallMm),
                                                              fmt::format("{:g}", largestBallMm)));
}

void validate(const LassoCut &cut) {
    requirePoints(cut.outline, 3);
    if (!(std::abs(glm::length(cut.sight) - 1.0) <= 1e-6))
        throw Error(ErrorCode::usage, because::sightIsNoUnitVector);
    if (cut.slabMm && !((*cut.slabMm)[0] <= (*cut.slabMm)[1]))
        throw Error(ErrorCode::usage, because::slabIsEmpty);
}

const std::vector<StepDescription> &stepDescriptions() {
    static const StepParameter byItk{
        "itk", "", 0.0, 1.0, 0.0, true, "1: use ITK's filters, slower"};
    static const std::vector<StepDescription> all{
        {StepKind::gaussian,
         "gaussian",
         StepEffect::values,
         "Smooths with a Gaussian",
         {{"sigma_mm", "mm", 0.1, 20.0, 1.0, false, "Standard deviation"}}},
        {StepKind::median,
         "median",
         StepEffect::values,
         "Median of the neighborhood: removes specks, keeps edges",
         {{"radius_mm", "mm", 0.1, 10.0, 1.0, false, "Half the side of the neighborhood"}}},
        {StepKind::diffusion,
         "diffusion",
         StepEffect::values,
         "Curvature anisotropic diffusion: smooths along edges, not across them",
         {{"iterations", "", 1.0, 50.0, 5.0, true, "Number of iterations"},
          {"conductance", "", 0.5, 10.0, 3.0, false, "Lower values preserve more edges"}}},
        {StepKind::gradient,
         "gradient",
         StepEffect::values,
         "Magnitude of the gradient, in value units per mm",
         {{"sigma_mm", "mm", 0.0, 20.0, 1.0, false, "Standard deviation of prior smoothing"}}},
        {StepKind::negate,
         "negate",
         StepEffect::values,
         "Changes the sign of the values: shows what is less in a difference",
         {}},
        {StepKind::threshold,
         "threshold",
         StepEffect::region,
         "Only samples within a hard range of values",
         {{"low", "value units", -open, open, -open, false, "Minimum"},
          {"high", "value units", -open, open, open, false, "Maximum"}}},
        {StepKind::edges,
         "edges",
         StepEffect::region,
         "Canny edges, shown with a density of one",
         {{"sigma_mm", "mm", 0.0, 20.0, 1.0, false, "Standard deviation of prior smoothing"},
          {"low", "value units per mm", 0.0, open, 20.0, false, "An edge continues above this"},
          {"high", "value units per mm", 0.0, open, 60.0, false, "An edge starts above this"},
          byItk}},
        {StepKind::binarise,
         "binarise",
         StepEffect::region,
         "A density of one at or above a value, zero below",
         {{"from", "value units", -open, open, 0.0, false, "Minimum"}}},
        {StepKind::opening,
         "opening",
         StepEffect::region,
         "Removes structures thinner than a ball",
         {{"radius_mm", "mm", 0.1, 30.0, 2.0, false, "Radius of the ball"}, byItk}},
        {StepKind::closing,
         "closing",
         StepEffect::region,
         "Fills gaps narrower than a ball",
         {{"radius_mm", "mm", 0.1, 30.0, 2.0, false, "Radius of the ball"}, byItk}},
        {StepKind::largestComponent,
         "largest",
         StepEffect::region,
         "Only the largest connected part, and parts of similar size",
         {{"share", "", 0.001, 1.0, 1.0, false, "Minimum size of a part relative to the largest"}}},
        {StepKind::connected,
         "connected",
         StepEffect::region,
         "Only the part connected to the points",
         {{"leak_mm", "mm", 0.0, 100.0, 0.0, false, "Not through openings narrower than this"}},
         StepInput::points},
        {StepKind::grow,
         "grow",
         StepEffect::region,
         "Expands the region by a distance",
         {{"mm", "mm", 0.1, 50.0, 2.0, false, "Distance"}}},
        {StepKind::shrink,
         "shrink",
         StepEffect::region,
         "Shrinks the region by a distance",
         {{"mm", "mm", 0.1, 50.0, 2.0, false, "Depth"}}},
        {StepKind::fill,
         "fill",
         StepEffect::region,
         "Fills holes: parts that the class encloses on all sides",
         {}},
        {StepKind::body,
         "body",
         StepEffect::region,
         "Only the patient, without the couch and the surrounding air",
         {{"margin_mm", "mm", 0.0, 30.0, 2.0, false, "Margin around the skin"}}},
        {StepKind::skin,
         "skin",
         StepEffect::region,
         "Only the surface of the patient",
         {{"depth_mm", "mm", 0.5, 30.0, 4.0, false, "Depth below the skin"},
          {"margin_mm", "mm", 0.0, 30.0, 2.0, false, "Margin outside the skin"}}},
        {StepKind::intersection,
         "and",
         StepEffect::region,
         "Only what belongs to another class, too",
         {},
         StepInput::otherClass},
        {StepKind::join, "or", StepEffect::region, "Adds another class", {}, StepInput::otherClass},
        {StepKind::difference,
         "without",
         StepEffect::region,
         "Removes another class",
         {},
         StepInput::otherClass},
        {StepKind::paint,
         "paint",
         StepEffect::region,
         "Adds and erases the strokes of a ball-shaped brush",
         {},
         StepInput::strokes},
        {StepKind::scissors,
         "scissors",
         StepEffect::region,
         "Cuts along the line of sight",
         {},
         StepInput::cuts}};
    return all;
}

const StepDescription &describe(StepKind kind) {
    for (const StepDescription &step : stepDescriptions())
        if (step.kind == kind)
            return step;
    assert(false && "a kind of step has no description");
    return stepDescriptions().front();
}

StepKind stepKindNamed(const std::string &name) {
    std::string names;
    for (const StepDescription &step : stepDescriptions()) {
        if (step.name == name)
            return step.kind;
        names += (names.empty() ? "" : ", ") + step.name;
    }
    throw Error(ErrorCode::usage, because::stepIsUnknown(name, names));
}

double Step::at(const std::string &parameter) const {
    const auto given = parameters.find(parameter);
    return given != parameters.end() ? given->second
                                     : parameterOf(describe(kind), parameter).defaultValue;
}

void validate(const Step &step) {
    const StepDescription &description = describe(step.kind);
    validateInput(step, description);
    const auto text = [](double n) { return fmt::format("{:g}", n); };
    for (const auto &[name, value] : step.parameters) {
        const StepParameter &p = parameterOf(description, name);
        if (!(value >= p.minimum && value <= p.maximum))
            throw Error(ErrorCode::usage,
                        because::stepParameterOutOfRange(name, description.name, text(value),
                                                         text(p.minimum), text(p.maximum)));
        if (p.isInteger && value != std::round(value))
            throw Error(ErrorCode::usage,
                        because::stepParameterNotWhole(name, description.name, text(value)));
    }
    if (find(description, "low") != nullptr && step.at("low") > step.at("high"))
        throw Error(ErrorCode::usage, because::stepLowAboveHigh(description.name));
}

std::string stepText(const Step &step) {
    const StepDescription &description = describe(step.kind);
    std::string inside;
    for (const auto &[name, value] : step.parameters)
        if (value != parameterOf(description, name).defaultValue)
            inside += fmt::format("{}{}={}", inside.empty() ? "" : ",", name, value);
    return inside.empty() ? description.name : description.name + "(" + inside + ")";
}

bool awaitsPoints(const Step &step) {
    return describe(step.kind).input == StepInput::points && step.points.empty();
}

} // namespace pellucid::classify
