// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/measure/measurement.h"
#include "core/task/error.h"

namespace pellucid::measure {

namespace {

namespace because = task::because;
using nlohmann::json;

constexpr const char *schema = "pellucid-measurements/1";

constexpr std::array<std::pair<Kind, const char *>, 5> kinds{
    {{Kind::distance, "distance"},
     {Kind::angle, "angle"},
     {Kind::ellipse, "ellipse"},
     {Kind::rectangle, "rectangle"},
     {Kind::projectedDistance, "projected distance"}}};

[[noreturn]] void refuse(std::size_t index, const task::Reason &what) {
    throw task::Error(task::ErrorCode::unusable, because::ofMeasurement(index + 1, what));
}

json toArray(const glm::dvec3 &v) {
    return {v.x, v.y, v.z};
}

glm::dvec3 vectorAt(const json &in, std::size_t index) {
    if (!in.is_array() || in.size() != 3)
        refuse(index, because::pointMustBeThreeNumbers);
    glm::dvec3 out;
    for (int d = 0; d < 3; ++d) {
        if (!in[std::size_t(d)].is_number())
            refuse(index, because::pointMustBeThreeNumbers);
        out[d] = in[std::size_t(d)].get<double>();
        if (!(std::abs(out[d]) < 1e7))
            refuse(index, because::aNumberIsOutOfRange);
    }
    return out;
}

Measurement parsed(const json &in, std::size_t index) {
    if (!in.is_object())
        refuse(index, because::mustBeAnObject);
    Measurement m;
    const json kind = in.value("kind", json());
    bool known = false;
    for (const auto &[of, name] : kinds)
        if (kind == name) {
            m.kind = of;
            known = true;
        }
    if (!known)
        refuse(index, because::kindIsUnknown);
    if (in.contains("name") && !in["name"].is_string())
        refuse(index, because::nameMustBeAText);
    m.name = in.value("name", "");
    const json points = in.value("points_mm", json());
    if (!points.is_array() || points.size() != pointCount(m.kind))
        refuse(index, because::mustHavePoints(pointCount(m.kind)));
    for (const json &p : points)
        m.pointsMm.push_back(vectorAt(p, index));
    m.axes = {vectorAt(in.value("right", json()), index), vectorAt(in.value("up", json()), index)};
    // As far as numbers written with all digits may be off.
    if (std::abs(glm::length(m.axes.right) - 1.0) > 1e-6 ||
        std::abs(glm::length(m.axes.up) - 1.0) > 1e-6 ||
        std::abs(glm::dot(m.axes.right, m.axes.up)) > 1e-6)
        refuse(index, because::directionsNotAtRightAngles);
    return m;
}

} // namespace

std::string kindName(Kind kind) {
    for (const auto &[of, name] : kinds)
        if (of == kind)
            return name;
    return {};
}

std::vector<Measurement> measurementsFromJson(const std::string &text) {
    const json in = json::parse(text, nullptr, false);
    if (!in.is_object() || in.value("schema", json()) != schema ||
        !in.value("measurements", json()).is_array())
        throw task::Error(task::ErrorCode::unusable, because::isNoListOfMeasurements(schema));
    std::vector<Measurement> out;
    for (const json &m : in["measurements"])
        out.push_back(parsed(m, out.size()));
    return out;
}

std::string toJson(const std::vector<Measurement> &measurements) {
    json list = json::array();
    for (const Measurement &m : measurements) {
        json points = json::array();
        for (const glm::dvec3 &p : m.pointsMm)
            points.push_back(toArray(p));
        list.push_back({{"kind", kindName(m.kind)},
                        {"name", m.name},
                        {"points_mm", points},
                        {"right", toArray(m.axes.right)},
                        {"up", toArray(m.axes.up)}});
    }
    return json{{"schema", schema}, {"measurements", list}}.dump(2, ' ', false,
                                                                 json::error_handler_t::replace);
}

} // namespace pellucid::measure
