// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/files/json_fields_nlohmann.h"
#include "core/measure/measurement.h"
#include "core/measure/reasons.h"

namespace pellucid::measure {

namespace because = task::because;
using files::JsonFields;
using files::JsonValue;
using files::JsonWords;
using nlohmann::json;

static constexpr const char *schema = "pellucid-measurements/1";

static constexpr JsonWords<Kind, 8> kinds{{{"distance", Kind::distance},
                                           {"polyline", Kind::polyline},
                                           {"angle", Kind::angle},
                                           {"Cobb angle", Kind::cobbAngle},
                                           {"ellipse", Kind::ellipse},
                                           {"rectangle", Kind::rectangle},
                                           {"arrow", Kind::arrow},
                                           {"text", Kind::text}}};
static const JsonWords<Kind, 8> &jsonWords(Kind) {
    return kinds;
}

static void require(bool holds, const task::Reason &otherwise) {
    if (!holds)
        throw task::Error(task::ErrorCode::usage, otherwise);
}

static void validate(const Measurement &m) {
    require(!m.isProjected || !isRegion(m.kind), because::regionsAreNotProjected);
    const PointCount count = pointCount(m.kind);
    require(m.pointsMm.size() >= count.min && m.pointsMm.size() <= count.max,
            count.min == count.max ? because::mustHavePoints(count.min)
                                   : because::mustHaveFromToPoints(count.min, count.max));
    // A tolerance for the rounding of numbers written with all digits.
    const auto &[right, up] = m.axes;
    require(std::abs(glm::length(right) - 1.0) <= 1e-6 && std::abs(glm::length(up) - 1.0) <= 1e-6 &&
                std::abs(glm::dot(right, up)) <= 1e-6,
            because::directionsNotAtRightAngles);
}

static void fields(JsonFields &io, Measurement &m) {
    io.required("kind", m.kind);
    io.known("name", m.name);
    io.required("points_mm", m.pointsMm);
    io.checked("points_mm", [&] {
        constexpr double largestMm = 1e7; // ten kilometres
        for (const glm::dvec3 &p : m.pointsMm)
            require(glm::length(p) <= largestMm, because::isOutOfRange);
    });
    io.required("right", m.axes.right);
    io.required("up", m.axes.up);
    io.unusual("projected", m.isProjected);
}

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
            JsonFields::read(JsonValue(m), out.emplace_back());
        } catch (const task::Error &error) {
            throw task::Error(task::ErrorCode::unusable,
                              because::ofMeasurement(out.size(), error.reason()));
        }
    return out;
}

std::string toJson(const std::vector<Measurement> &measurements) {
    return json{{"schema", schema}, {"measurements", JsonFields::written(measurements)}}.dump(
        2, ' ', false, json::error_handler_t::replace);
}

} // namespace pellucid::measure
