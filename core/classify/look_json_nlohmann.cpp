// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/look_json_nlohmann.h"

#include <memory>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/classify/reasons.h"
#include "core/files/json_fields_nlohmann.h"
#include "core/files/reasons.h"

namespace pellucid::classify {

namespace because = task::because;
using files::JsonFields;
using files::JsonValue;
using nlohmann::json;

json jsonOf(const Color &color) {
    return colorText(color);
}

void readFrom(const JsonValue &in, Color &color) {
    const std::string text = in.text();
    color = in.checked([&] { return colorFromText(text); });
}

json jsonOf(const FieldWindow &window) {
    return {window.low, window.high};
}

void readFrom(const JsonValue &in, FieldWindow &window) {
    const auto [low, high] = in.twoNumbers();
    window = {low, high};
}

static void fields(JsonFields &io, TransferFunction &function) {
    io.required("weights", function.weights);
    io.required("range", function.low, function.high);
    io.nothingElse();
}

static void readFrom(const JsonValue &in, Path &path) {
    if (in.size() > maxPoints)
        in.refuse(because::pointsOutOfRange(in.size(), 0, maxPoints));
    std::vector<glm::dvec3> places;
    JsonFields::read(in, places);
    for (const glm::dvec3 &mm : places)
        path.push_back({mm});
}

static json jsonOf(const Path &path) {
    json out = json::array();
    for (const volume::PatientPoint &point : path)
        out.push_back(JsonFields::written(point.mm));
    return out;
}

static void fields(JsonFields &io, Stroke &stroke) {
    io.required("path", stroke.path);
    io.required("radius_mm", stroke.radiusMm);
    io.unusual("erase", stroke.erases);
    io.nothingElse();
}

static void fields(JsonFields &io, LassoCut &cut) {
    io.required("outline", cut.outline);
    io.required("sight", cut.sight);
    io.unusual("slab_mm", cut.slabMm);
    io.unusual("keep", cut.keeps);
    io.nothingElse();
}

static void readFrom(const JsonValue &in, Operand &operand);
static json jsonOf(const Operand &operand);

// The member of a step that is its input, or nothing.
static const char *inputName(StepInput input) {
    switch (input) {
    case StepInput::points:
        return "points";
    case StepInput::strokes:
        return "strokes";
    case StepInput::cuts:
        return "cuts";
    case StepInput::otherClass:
        return "class";
    case StepInput::none:
        break;
    }
    return "";
}

static void readInput(const JsonValue &in, Step &step) {
    Path path;
    switch (describe(step.kind).input) {
    case StepInput::points:
        readFrom(in, path);
        step.points.assign(path.begin(), path.end());
        break;
    case StepInput::strokes:
        JsonFields::read(in, step.strokes);
        break;
    case StepInput::cuts:
        JsonFields::read(in, step.cuts);
        break;
    case StepInput::otherClass:
        readFrom(in, step.operand);
        break;
    case StepInput::none:
        break;
    }
}

// Null if it has none.
static json inputJson(const Step &step) {
    switch (describe(step.kind).input) {
    case StepInput::points:
        return jsonOf(Path(step.points));
    case StepInput::strokes:
        return JsonFields::written(step.strokes);
    case StepInput::cuts:
        return JsonFields::written(step.cuts);
    case StepInput::otherClass:
        return jsonOf(step.operand);
    case StepInput::none:
        break;
    }
    return {};
}

static void readFrom(const JsonValue &in, Step &step) {
    const std::string kind = in.at("kind").text();
    step = {in.checked([&] { return stepKindNamed(kind); })};
    const std::string input = inputName(describe(step.kind).input);
    for (const auto &member : in.members()) {
        const std::string &name = member.first;
        if (name == "kind")
            continue;
        if (name == input) {
            readInput(member.second, step);
            continue;
        }
        in.checked([&] { step.at(name); }); // before the value is read
        step.parameters[name] = member.second.number();
    }
    in.checked([&] { validate(step); });
}

static json jsonOf(const Step &step) {
    json out = {{"kind", describe(step.kind).name}};
    for (const auto &[name, value] : step.parameters)
        out[name] = value;
    if (json input = inputJson(step); !input.is_null())
        out[inputName(describe(step.kind).input)] = std::move(input);
    return out;
}

static void fields(JsonFields &io, TissueClass &tissue) {
    io.required("name", tissue.name);
    io.required("range", tissue.low, tissue.high);
    io.known("softness", tissue.softness);
    io.known("weight", tissue.weight);
    io.known("color", tissue.color);
    io.unusual("transfer_function", tissue.transferFunction);
    io.unusual("segment", tissue.segment);
    io.unusual("drawn", tissue.isDrawn);
    io.unusual("edge", tissue.edge);
    io.unusual("steps", tissue.steps);
}

static void readFrom(const JsonValue &in, Operand &operand) {
    if (!in.isObject()) {
        operand = {in.text(), nullptr};
        return;
    }
    // `validate` refuses much less; this protects the stack.
    constexpr int deepest = 100;
    if (in.depth() > deepest)
        in.refuse(because::combinesTooDeep);
    TissueClass own;
    JsonFields::read(in, own);
    operand = {"", std::make_shared<const TissueClass>(std::move(own))};
}

static json jsonOf(const Operand &operand) {
    return operand.own ? JsonFields::written(*operand.own) : json(operand.name);
}

void fields(JsonFields &io, Look &look) {
    // The number of control points is part of the look, even if all weights are 1.
    io.unusual("transfer_function", look.transferFunction);
    io.unusual("classes", look.classes);
    io.checked("classes", [&] { validate(look); });
}

} // namespace pellucid::classify
