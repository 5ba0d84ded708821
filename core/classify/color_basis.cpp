// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/color_basis.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace pellucid::classify {

namespace {

constexpr double tolerance = 1e-7; // sine of an angle

glm::dvec3 vectorOf(const ColorBasis::Rgb &color) {
    return {color[0], color[1], color[2]};
}

// Black has no direction.
glm::dvec3 directionOf(const ColorBasis::Rgb &color) {
    const glm::dvec3 vector = vectorOf(color);
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : glm::dvec3(0.0);
}

ColorBasis ofOneHue(std::span<const ColorBasis::Rgb> colors) {
    const auto brighter = [](const ColorBasis::Rgb &a, const ColorBasis::Rgb &b) {
        return glm::length(vectorOf(a)) < glm::length(vectorOf(b));
    };
    const auto brightest = *std::max_element(colors.begin(), colors.end(), brighter);
    const glm::dvec3 basis = vectorOf(brightest);
    ColorBasis result{{brightest}, {}};
    for (const ColorBasis::Rgb &color : colors)
        result.amounts.push_back(
            {color == brightest ? 1.0 : glm::dot(vectorOf(color), basis) / glm::dot(basis, basis)});
    return result;
}

// Whether three of many colors are clearly in no plane, so that the search for the two that are
// farthest apart, whose time grows with the square of their number, is not needed.
bool spanSpace(std::span<const ColorBasis::Rgb> colors) {
    constexpr double clearly = 0.01;
    const glm::dvec3 first = directionOf(colors.front());
    glm::dvec3 normal(0.0);
    for (const ColorBasis::Rgb &color : colors)
        if (const glm::dvec3 across = glm::cross(first, directionOf(color));
            glm::length(across) > glm::length(normal))
            normal = across;
    return glm::length(normal) > clearly &&
           std::any_of(colors.begin(), colors.end(), [&](const ColorBasis::Rgb &color) {
               return std::abs(glm::dot(directionOf(color), glm::normalize(normal))) > clearly;
           });
}

} // namespace

ColorBasis colorBasis(std::span<const ColorBasis::Rgb> colors) {
    const ColorBasis::Rgb *first = nullptr, *second = nullptr;
    double farthest = tolerance;
    if (spanSpace(colors))
        return {{ColorBasis::primaries.begin(), ColorBasis::primaries.end()},
                {colors.begin(), colors.end()}};
    for (std::size_t a = 0; a < colors.size(); ++a)
        for (std::size_t b = a + 1; b < colors.size(); ++b) {
            const double sine =
                glm::length(glm::cross(directionOf(colors[a]), directionOf(colors[b])));
            if (sine > farthest) {
                farthest = sine;
                first = &colors[a];
                second = &colors[b];
            }
        }
    if (first == nullptr)
        return ofOneHue(colors);
    const glm::dvec3 a = vectorOf(*first), b = vectorOf(*second), normal = glm::cross(a, b);
    const bool isPlane = std::all_of(colors.begin(), colors.end(), [&](const auto &color) {
        return std::abs(glm::dot(directionOf(color), glm::normalize(normal))) <= tolerance;
    });
    if (!isPlane)
        return {{ColorBasis::primaries.begin(), ColorBasis::primaries.end()},
                {colors.begin(), colors.end()}};
    ColorBasis result{{*first, *second}, {}};
    for (const ColorBasis::Rgb &color : colors) {
        const glm::dvec3 c = vectorOf(color);
        if (color == *first)
            result.amounts.push_back({1.0, 0.0, 0.0});
        else if (color == *second)
            result.amounts.push_back({0.0, 1.0, 0.0});
        else
            result.amounts.push_back({glm::dot(glm::cross(c, b), normal) / glm::dot(normal, normal),
                                      glm::dot(glm::cross(a, c), normal) / glm::dot(normal, normal),
                                      0.0});
    }
    return result;
}

} // namespace pellucid::classify
