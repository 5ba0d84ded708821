// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string_view>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/files/json_value_nlohmann.h"
#include "core/measure/measurement.h"
#include "core/measure/reasons.h"

namespace pellucid::measure {

namespace {

namespace because = task::because;
using files::JsonValue;
using nlohmann::json;

constexpr const char *schema = "pellucid-measurements/1";

constexpr files::JsonWords<Kind, 8> kinds{{{"distance", Kind::distance},
                                           {"polyline", Kind::polyline},
                                           {"angle", Kind::angle},
                                           {"Cobb angle", Kind::cobbAngle},
                                           {"ellipse", Kind::ellipse},
                                           {"rectangle", Kind::rectangle},
                                           {"arrow", Kind::arrow},
                                           {"text", Kind::text}}};
// Written until version 1.3 for a distance that was drawn in a projection.
constexpr std::string_view oldProjectedDistance = "projected distance";

json toArray(const glm::dvec3 &v) {
    return {v.x, v.y, v.z};
}

glm::dvec3 vectorFrom(const JsonValue &in) {
    constexpr double largestMm = 1e7; // ten kilometres
    const auto [x, y, z] = in.threeNumbers(largestMm);
    return {x, y, z};
}

Measurement measurementFrom(const JsonValue &in) {
    Measurement m;
    const JsonValue kind = in.at("kind");
    if (kind.text() == oldProjectedDistance) {
        m.isProjected = true;
    } else {
        m.kind = kind.meaning(kinds);
        if (const JsonValue projected = in["projected"])
            m.isProjected = projected.boolean();
    }
    if (m.isProjected && isRegion(m.kind))
        in.refuse(because::regionsAreNotProjected);
    if (const JsonValue name = in["name"])
        m.name = name.text();
    const JsonValue points = in.at("points_mm");
    if (const PointCount count = pointCount(m.kind);
        points.size() < count.min || points.size() > count.max)
        in.refuse(count.min == count.max ? because::mustHavePoints(count.min)
                                         : because::mustHaveFromToPoints(count.min, count.max));
    for (const JsonValue &p : points.elements())
        m.pointsMm.push_back(vectorFrom(p));
    m.axes = {vectorFrom(in.at("right")), vectorFrom(in.at("up"))};
    // A tolerance for the rounding of numbers written with all digits.
    if (std::abs(glm::length(m.axes.right) - 1.0) > 1e-6 ||
        std::abs(glm::length(m.axes.up) - 1.0) > 1e-6 ||
        std::abs(glm::dot(m.axes.right, m.axes.up)) > 1e-6)
        in.refuse(because::directionsNotAtRightAngles);
    return m;
}

} // namespace

std::string kindName(const Measurement &m) {
    return (m.isProjected ? "projected " : "") + std::string(files::wordFor(m.kind, kinds));
}

std::vector<Measurement> measurementsFromJson(const std::string &text) {
    const json in = json::parse(text, nullptr, false);
    if (!in.is_object() || in.value("schema", json()) != schema ||
        !in.value("measurements", json()).is_array())
        throw task::Error(task::ErrorCode::unusable, because::isNoListOfMeasurements(schema));
    std::vector<Measurement> out;
    for (const json &m : in["measurements"])
        try {
            out.push_back(measurementFrom(JsonValue(m)));
        } catch (const task::Error &error) {
            throw task::Error(task::ErrorCode::unusable,
                              because::ofMeasurement(out.size() + 1, error.reason()));
        }
    return out;
}

std::string toJson(const std::vector<Measurement> &measurements) {
    json list = json::array();
    for (const Measurement &m : measurements) {
        json points = json::array();
        for (const glm::dvec3 &p : m.pointsMm)
            points.push_back(toArray(p));
        json one = {{"kind", files::wordFor(m.kind, kinds)},
                    {"name", m.name},
                    {"points_mm", points},
                    {"right", toArray(m.axes.right)},
                    {"up", toArray(m.axes.up)}};
        if (m.isProjected)
            one["projected"] = true;
        list.push_back(std::move(one));
    }
    return json{{"schema", schema}, {"measurements", list}}.dump(2, ' ', false,
                                                                 json::error_handler_t::replace);
}

} // namespace pellucid::measure
