// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/tissue_class.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtx/color_space.hpp>

#include "core/classify/reasons.h"
#include "core/task/error.h"

namespace pellucid::classify {

namespace {

namespace because = task::because;

// 0 below -1/2, 1 above 1/2.
double raisedCosine(double x) {
    return x <= -0.5 ? 0.0 : x >= 0.5 ? 1.0 : 0.5 * (1.0 + std::sin(std::numbers::pi * x));
}

double component(const std::string &text, std::size_t at) {
    return std::stoi(text.substr(at, 2), nullptr, 16) / 255.0;
}

} // namespace

Color colorFromText(const std::string &text) {
    if (text.size() != 7 || text[0] != '#' ||
        text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
        throw task::Error(task::ErrorCode::usage, because::isNoColor(text));
    return {component(text, 1), component(text, 3), component(text, 5)};
}

std::string colorText(const Color &color) {
    const auto byte = [](double c) { return int(std::lround(255.0 * std::clamp(c, 0.0, 1.0))); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(color.red), byte(color.green), byte(color.blue));
}

// Hues a golden angle apart are far from each other.
Color distinctColor(std::size_t index) {
    constexpr double goldenAngle = 137.50776405003785, saturation = 0.6, brightness = 1.0;
    const glm::dvec3 rgb = glm::rgbColor(
        glm::dvec3(std::fmod(goldenAngle * double(index), 360.0), saturation, brightness));
    return {rgb.x, rgb.y, rgb.z};
}

double TissueClass::membership(double value) const {
    if (softness <= 0.0)
        return value >= low && value <= high ? 1.0 : 0.0;
    return raisedCosine((value - low) / softness) * raisedCosine((high - value) / softness);
}

bool Operand::operator==(const Operand &other) const {
    return name == other.name &&
           (own == other.own || (own != nullptr && other.own != nullptr && *own == *other.own));
}

bool TissueClass::hasRange() const {
    return low > lowestValue || high < highestValue;
}

void validate(const TissueClass &tissue) {
    const auto refuse = [&](const task::Reason &what) {
        throw task::Error(task::ErrorCode::usage, because::ofClass(tissue.name, what));
    };
    if (tissue.name.empty())
        throw task::Error(task::ErrorCode::usage, because::classHasNoName);
    if (!std::isfinite(tissue.low) || !std::isfinite(tissue.high) || tissue.low > tissue.high)
        refuse(because::rangeIsEmpty(fmt::format("{:g}", tissue.low),
                                     fmt::format("{:g}", tissue.high)));
    if (!(tissue.softness >= 0.0 && std::isfinite(tissue.softness)))
        refuse(because::softnessIsNegative);
    if (!(tissue.weight >= 0.0 && tissue.weight <= TransferFunction::largestWeight))
        refuse(
            because::classWeightOutOfRange(fmt::format("{:g}", tissue.weight),
                                           fmt::format("{:g}", TransferFunction::largestWeight)));
    if (!(tissue.edge >= 0.0 && tissue.edge <= softestEdge))
        refuse(because::edgeOutOfRange(fmt::format("{:g}", tissue.edge),
                                       fmt::format("{:g}", softestEdge)));
    for (const double c : {tissue.color.red, tissue.color.green, tissue.color.blue})
        if (!(c >= 0.0 && c <= 1.0))
            refuse(because::colorOutOfRange);
    if (tissue.isDrawn && !tissue.segment.empty())
        refuse(because::isDrawnAndASegment);
    if (tissue.steps.size() > maxSteps)
        refuse(because::hasTooManySteps(tissue.steps.size(), maxSteps));
    try {
        if (tissue.transferFunction)
            validate(*tissue.transferFunction);
        for (const Step &step : tissue.steps) {
            validate(step);
            if (step.operand.own)
                validate(*step.operand.own);
        }
    } catch (const task::Error &error) {
        refuse(error.reason());
    }
    const auto isRegion = [](const Step &step) {
        return describe(step.kind).effect == StepEffect::region;
    };
    const auto firstRegion = std::find_if(tissue.steps.begin(), tissue.steps.end(), isRegion);
    const auto late = std::find_if_not(firstRegion, tissue.steps.end(), isRegion);
    if (late != tissue.steps.end())
        refuse(because::stepMustComeBefore(describe(late->kind).name,
                                           describe(firstRegion->kind).name));
}

const std::vector<TissueClass> &standardClasses() {
    static const std::vector<TissueClass> classes{
        {"air", -1200, -950, 50, 1.0, {0.35, 0.45, 0.6}},
        {"lung", -950, -400, 100, 1.0, {0.45, 0.7, 1.0}},
        {"fat", -150, -40, 30, 1.0, {1.0, 0.8, 0.35}},
        {"fluid", -10, 25, 20, 1.0, {0.3, 0.6, 1.0}},
        {"muscle", 10, 90, 30, 1.0, {0.9, 0.3, 0.25}},
        {"organ", 20, 130, 30, 1.0, {0.8, 0.45, 0.4}},
        {"contrast", 150, 500, 60, 1.0, {1.0, 0.35, 0.3}},
        {"bone", 250, 2500, 150, 1.0, {1.0, 0.95, 0.85}},
        {"metal", 2500, 32767, 300, 1.0, {0.7, 0.9, 1.0}},
        {"body", -900, 32767, 50, 1.0, {0.85, 0.85, 0.85}, {}, {{StepKind::body, {}}}, {}, 0.0},
        {"edges", -600, 32767, 100, 1.0, {0.9, 0.95, 1.0}, {}, {{StepKind::edges, {}}}, {}, 0.0}};
    return classes;
}

const std::vector<TissueClass> &differenceClasses() {
    static const std::vector<TissueClass> classes{
        {"gain", 0.0, highestValue, 0.0, 1.0, {1.0, 0.55, 0.25}, {}, {}, {}, 0.0},
        {"loss",
         0.0,
         highestValue,
         0.0,
         1.0,
         {0.3, 0.6, 1.0},
         {},
         {{StepKind::negate, {}}},
         {},
         0.0}};
    return classes;
}

} // namespace pellucid::classify
