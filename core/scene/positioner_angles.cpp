// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/positioner_angles.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include "core/scene/camera.h"
#include "core/scene/reasons.h"
#include "core/task/error.h"

namespace pellucid::scene {

namespace {

namespace because = task::because;

// Within this of the patient's long axis, the primary angle has no meaning.
constexpr double poleSine = 1.0 - 1e-9;

// Reads one angle after its letters. The text after it remains.
double angleAfter(std::string &text, const std::string &whole) {
    const std::size_t start = text.find_first_not_of(" =");
    text.erase(0, std::min(start, text.size()));
    double degrees = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), degrees);
    if (error != std::errc() || !std::isfinite(degrees) || degrees < 0.0)
        throw task::Error(task::ErrorCode::usage, because::isNoAngulation(whole));
    text.erase(0, std::size_t(end - text.data()));
    return degrees;
}

} // namespace

PositionerAngles positionerAngles(const glm::dquat &orientation) {
    const glm::dmat3 axes = glm::mat3_cast(orientation);
    glm::dvec3 toDetector = axes[2];
    const double sine = std::clamp(toDetector.z, -1.0, 1.0);
    if (std::abs(sine) > poleSine)
        toDetector = sine > 0.0 ? -axes[1] : axes[1];
    // Adding 0 turns -0 into 0.
    double primary = glm::degrees(std::atan2(toDetector.x, -toDetector.y)) + 0.0;
    if (primary <= -180.0)
        primary = 180.0;
    return {primary, glm::degrees(std::asin(sine)) + 0.0};
}

glm::dquat orientationOf(const PositionerAngles &angles) {
    return viewOrientation(StandardView::front, {angles.primaryDeg, angles.secondaryDeg, 0.0});
}

glm::dquat orientationFrom(const glm::dvec3 &toViewer) {
    const glm::dvec3 sight = glm::normalize(toViewer);
    if (std::abs(sight.z) > poleSine)
        return viewOrientation(sight.z > 0.0 ? StandardView::top : StandardView::bottom);
    return orientationOf(
        {glm::degrees(std::atan2(sight.x, -sight.y)), glm::degrees(std::asin(sight.z))});
}

PositionerAngles positionerAnglesFromText(const std::string &text) {
    std::string rest;
    for (const char c : text)
        rest += c == ',' || c == ';' ? ' ' : char(std::toupper(static_cast<unsigned char>(c)));
    std::optional<double> primary, secondary;
    const auto set = [&](std::optional<double> &angle, double degrees, double largest) {
        if (angle || std::abs(degrees) > largest)
            throw task::Error(task::ErrorCode::usage, because::isNoAngulation(text));
        angle = degrees;
    };
    while (rest.find_first_not_of(' ') != std::string::npos) {
        rest.erase(0, rest.find_first_not_of(' '));
        const std::string word = rest.substr(
            0, std::size_t(std::find_if(rest.begin(), rest.end(),
                                        [](unsigned char c) { return std::isalpha(c) == 0; }) -
                           rest.begin()));
        rest.erase(0, word.size());
        if (word == "AP")
            set(primary, 0.0, 0.0);
        else if (word == "PA")
            set(primary, 180.0, 180.0);
        else if (word == "LAO")
            set(primary, angleAfter(rest, text), 180.0);
        else if (word == "RAO")
            set(primary, -angleAfter(rest, text), 180.0);
        else if (word == "CRA" || word == "CRANIAL")
            set(secondary, angleAfter(rest, text), 90.0);
        else if (word == "CAU" || word == "CAUDAL")
            set(secondary, -angleAfter(rest, text), 90.0);
        else
            throw task::Error(task::ErrorCode::usage, because::isNoAngulation(text));
    }
    if (!primary && !secondary)
        throw task::Error(task::ErrorCode::usage, because::isNoAngulation(text));
    return {primary.value_or(0.0) <= -180.0 ? 180.0 : primary.value_or(0.0) + 0.0,
            secondary.value_or(0.0) + 0.0};
}

std::string positionerText(const PositionerAngles &angles) {
    const auto part = [](double degrees, const char *positive, const char *negative) {
        const long whole = std::lround(degrees);
        return whole == 0 ? std::string()
                          : std::string(whole > 0 ? positive : negative) + " " +
                                std::to_string(std::abs(whole));
    };
    const std::string primary = std::lround(std::abs(angles.primaryDeg)) == 180
                                    ? "PA"
                                    : part(angles.primaryDeg, "LAO", "RAO");
    const std::string secondary = part(angles.secondaryDeg, "CRA", "CAU");
    if (primary.empty() && secondary.empty())
        return "AP";
    return primary + (primary.empty() || secondary.empty() ? "" : " ") + secondary;
}

} // namespace pellucid::scene
