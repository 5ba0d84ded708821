// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shading/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/shading/reasons.h"
#include "core/system/text.h"
#include "core/task/error.h"

namespace pellucid::shading {

namespace {

namespace because = task::because;

constexpr double pi = std::numbers::pi;

void require(bool holds, const task::Reason &what) {
    if (!holds)
        throw task::Error(task::ErrorCode::usage, what);
}

// Parses numbers separated by commas.
std::vector<double> numbersOf(const std::string &text, const task::Reason &what) {
    std::vector<double> values;
    for (std::size_t first = 0;;) {
        const std::size_t comma = std::min(text.find(',', first), text.size());
        const std::string part = text.substr(first, comma - first);
        const auto value = system::typedNumberFrom(part);
        require(value && std::isfinite(*value), because::isNoNumber(what, part));
        values.push_back(*value);
        if (comma == text.size())
            return values;
        first = comma + 1;
    }
}

double numberOf(const std::string &text, const task::Reason &what) {
    const auto values = numbersOf(text, what);
    require(values.size() == 1, because::isNoNumber(what, text));
    return values.front();
}

} // namespace

bool DepthCue::isActive() const {
    return kind != CueKind::none && strength != 0.0 &&
           !(kind == CueKind::curve &&
             std::all_of(curve.begin(), curve.end(), [](double c) { return c == 1.0; }));
}

std::function<double(double)> cueFunction(const DepthCue &cue) {
    const double strength = cue.strength;
    switch (cue.kind) {
    case CueKind::none:
        break;
    case CueKind::linear:
        return [strength](double t) { return 1.0 + strength * t; };
    case CueKind::sine:
        return [strength](double t) { return 1.0 + strength * std::sin(0.5 * pi * t); };
    case CueKind::curve:
        return [strength, cosines = cosinesOf(cue.curve)](double t) {
            double sum = 0.0;
            for (std::size_t k = 0; k < cosines.size(); ++k)
                sum += cosines[k] * std::cos(double(k) * pi * 0.5 * (t + 1.0));
            return 1.0 + strength * (sum - 1.0);
        };
    }
    return [](double) { return 1.0; };
}

double DepthCue::at(double t) const {
    return cueFunction(*this)(t);
}

std::vector<double> cosinesOf(const std::vector<double> &values) {
    const int last = int(values.size()) - 1;
    std::vector<double> cosines(values.size());
    for (int k = 0; k <= last; ++k) {
        double sum = 0.0;
        for (int n = 0; n <= last; ++n)
            sum += (n == 0 || n == last ? 0.5 : 1.0) * values[std::size_t(n)] *
                   std::cos(pi * k * n / last);
        cosines[std::size_t(k)] = (k == 0 || k == last ? 1.0 : 2.0) / last * sum;
        // A rounding error is not worth two slices.
        if (std::abs(cosines[std::size_t(k)]) < 1e-12)
            cosines[std::size_t(k)] = 0.0;
    }
    return cosines;
}

bool Shading::isPlain() const {
    return !cue.isActive() && ambient == 1.0 && !isLit();
}

bool Shading::isLit() const {
    return std::any_of(lights.begin(), lights.end(), [](const Light &light) {
        return light.strength != 0.0 && light.color != classify::Color{0.0, 0.0, 0.0};
    });
}

bool Shading::isGrey() const {
    return std::all_of(lights.begin(), lights.end(), [](const Light &light) {
        const classify::Color &c = light.color;
        return light.strength == 0.0 || (c.red == c.green && c.green == c.blue);
    });
}

void validate(const DepthCue &cue) {
    require(cue.strength >= 0.0 && cue.strength <= 1.0, because::cueStrengthOutOfRange);
    require(cue.curve.size() >= minCurveValues && cue.curve.size() <= maxCurveValues,
            because::cueCurveHasOtherSize(minCurveValues, maxCurveValues));
    for (const double value : cue.curve)
        require(value >= 0.0 && value <= largestCurveValue,
                because::cueCurveOutOfRange(fmt::format("{}", largestCurveValue)));
}

void validate(const Light &light) {
    const double length = glm::length(light.direction);
    require(std::isfinite(length) && length > 1e-12, because::lightHasNoDirection);
    require(light.strength >= 0.0 && light.strength <= 1.0, because::lightStrengthOutOfRange);
    for (const double c : {light.color.red, light.color.green, light.color.blue})
        require(c >= 0.0 && c <= 1.0, because::lightColorOutOfRange);
}

void validate(const Shading &shading) {
    validate(shading.cue);
    require(shading.ambient >= 0.0 && shading.ambient <= largestAmbient,
            because::ambientOutOfRange(fmt::format("{}", largestAmbient)));
    require(shading.lights.size() <= maxLights, because::tooManyLights(maxLights));
    for (const Light &light : shading.lights)
        validate(light);
}

DepthCue cueFromText(const std::string &text) {
    DepthCue cue;
    if (text == "none")
        return cue;
    static constexpr std::array<std::pair<const char *, CueKind>, 3> words{
        {{"linear", CueKind::linear}, {"sine", CueKind::sine}, {"curve", CueKind::curve}}};
    const auto colon = text.find(':');
    const auto word = std::find_if(words.begin(), words.end(), [&](const auto &each) {
        return text.compare(0, colon, each.first) == 0;
    });
    require(colon != std::string::npos && word != words.end(), because::isNoCue(text));
    cue.kind = word->second;
    const std::string values = text.substr(colon + 1);
    if (cue.kind == CueKind::curve)
        cue.curve = numbersOf(values, because::theCue(text));
    else
        cue.strength = numberOf(values, because::theCue(text));
    validate(cue);
    return cue;
}

Light lightFromText(const std::string &text) {
    const task::Reason what = because::theLight(text);
    Light light;
    const auto color = text.find(':');
    const auto direction = numbersOf(text.substr(0, color), what);
    require(direction.size() == 3, because::isNoLight(text));
    light.direction = {direction[0], direction[1], direction[2]};
    if (color != std::string::npos) {
        const auto strength = text.find(':', color + 1);
        light.color = classify::colorFromText(text.substr(color + 1, strength - color - 1));
        if (strength != std::string::npos)
            light.strength = numberOf(text.substr(strength + 1), what);
    }
    validate(light);
    return light;
}

} // namespace pellucid::shading
