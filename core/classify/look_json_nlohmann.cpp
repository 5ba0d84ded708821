// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/look_json_nlohmann.h"

#include <memory>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/classify/reasons.h"
#include "core/files/json_value_nlohmann.h"
#include "core/files/reasons.h"

namespace pellucid::classify {

namespace {

namespace because = task::because;
using files::JsonValue;
using nlohmann::json;

TransferFunction functionFrom(const JsonValue &in) {
    TransferFunction function;
    in.requireOnly({"weights", "range"});
    function.weights = in.at("weights").numbers();
    const auto [low, high] = in.at("range").twoNumbers();
    function.low = low;
    function.high = high;
    in.checked([&] { validate(function); });
    return function;
}

TissueClass classFrom(const JsonValue &in, int depth);

volume::PatientPoint pointFrom(const JsonValue &in) {
    const auto mm = in.threeNumbers();
    return {{mm[0], mm[1], mm[2]}};
}

std::vector<volume::PatientPoint> pointsFrom(const JsonValue &in) {
    if (in.size() > maxPoints)
        in.refuse(because::pointsOutOfRange(in.size(), 0, maxPoints));
    std::vector<volume::PatientPoint> points;
    for (const JsonValue &point : in.elements())
        points.push_back(pointFrom(point));
    return points;
}

Stroke strokeFrom(const JsonValue &in) {
    in.requireOnly({"path", "radius_mm", "erase"});
    Stroke stroke{Path(pointsFrom(in.at("path"))), in.at("radius_mm").number(), false};
    if (const JsonValue erases = in["erase"])
        stroke.erases = erases.boolean();
    in.checked([&] { validate(stroke); });
    return stroke;
}

LassoCut cutFrom(const JsonValue &in) {
    in.requireOnly({"outline", "sight", "slab_mm", "keep"});
    LassoCut cut{Path(pointsFrom(in.at("outline"))), pointFrom(in.at("sight")).mm, std::nullopt,
                 false};
    if (const JsonValue slab = in["slab_mm"])
        cut.slabMm = slab.twoNumbers();
    if (const JsonValue keeps = in["keep"])
        cut.keeps = keeps.boolean();
    in.checked([&] { validate(cut); });
    return cut;
}

Operand operandFrom(const JsonValue &in, int depth) {
    if (!in.isObject())
        return {in.text(), nullptr};
    if (depth >= maxDepth)
        in.refuse(because::combinesTooDeep);
    return {"", std::make_shared<const TissueClass>(classFrom(in, depth + 1))};
}

// The member of a step that is its input, or nothing.
const char *inputName(StepInput input) {
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

void readInput(const JsonValue &in, Step &step, int depth) {
    switch (describe(step.kind).input) {
    case StepInput::points:
        step.points = pointsFrom(in);
        break;
    case StepInput::strokes:
        for (const JsonValue &stroke : in.elements())
            step.strokes.push_back(strokeFrom(stroke));
        break;
    case StepInput::cuts:
        for (const JsonValue &cut : in.elements())
            step.cuts.push_back(cutFrom(cut));
        break;
    case StepInput::otherClass:
        step.operand = operandFrom(in, depth);
        break;
    case StepInput::none:
        break;
    }
}

Step stepFrom(const JsonValue &in, int depth) {
    if (!in.isObject())
        in.refuse(because::mustHaveAKind);
    const std::string kind = in.at("kind").text();
    Step step{in.checked([&] { return stepKindNamed(kind); })};
    const std::string input = inputName(describe(step.kind).input);
    for (const auto &member : in.members()) {
        const std::string &name = member.first;
        if (name == "kind")
            continue;
        if (name == input) {
            readInput(member.second, step, depth);
            continue;
        }
        in.checked([&] { step.at(name); }); // before the value is read
        step.parameters[name] = member.second.number();
    }
    in.checked([&] { validate(step); });
    return step;
}

TissueClass classFrom(const JsonValue &in, int depth) {
    if (!in.isObject())
        in.refuse(because::mustHaveANameAndARange);
    const JsonValue name = in.at("name"), range = in.at("range");
    TissueClass tissue;
    tissue.name = name.text();
    const auto [low, high] = range.twoNumbers();
    tissue.low = low;
    tissue.high = high;
    if (const JsonValue softness = in["softness"])
        tissue.softness = softness.number();
    if (const JsonValue weight = in["weight"])
        tissue.weight = weight.number();
    if (const JsonValue color = in["color"]) {
        const std::string text = color.text();
        tissue.color = color.checked([&] { return colorFromText(text); });
    }
    if (const JsonValue function = in["transfer_function"])
        tissue.transferFunction = functionFrom(function);
    if (const JsonValue segment = in["segment"])
        tissue.segment = segment.text();
    if (const JsonValue drawn = in["drawn"])
        tissue.isDrawn = drawn.boolean();
    if (const JsonValue edge = in["edge"])
        tissue.edge = edge.number();
    if (const JsonValue steps = in["steps"])
        for (const JsonValue &step : steps.elements())
            tissue.steps.push_back(stepFrom(step, depth));
    in.checked([&] { validate(tissue); });
    return tissue;
}

template <class Points> json pointsJson(const Points &points) {
    json out = json::array();
    for (const volume::PatientPoint &point : points)
        out.push_back({point.mm.x, point.mm.y, point.mm.z});
    return out;
}

json functionJson(const TransferFunction &function) {
    return {{"weights", function.weights}, {"range", {function.low, function.high}}};
}

json classJson(const TissueClass &tissue);

// The input of a step; null if it has none.
json inputJson(const Step &step) {
    json out;
    switch (describe(step.kind).input) {
    case StepInput::points:
        return pointsJson(step.points);
    case StepInput::strokes:
        out = json::array();
        for (const Stroke &stroke : step.strokes) {
            json one = {{"path", pointsJson(stroke.path)}, {"radius_mm", stroke.radiusMm}};
            if (stroke.erases)
                one["erase"] = true;
            out.push_back(one);
        }
        return out;
    case StepInput::cuts:
        out = json::array();
        for (const LassoCut &cut : step.cuts) {
            json one = {{"outline", pointsJson(cut.outline)},
                        {"sight", {cut.sight.x, cut.sight.y, cut.sight.z}}};
            if (cut.slabMm)
                one["slab_mm"] = *cut.slabMm;
            if (cut.keeps)
                one["keep"] = true;
            out.push_back(one);
        }
        return out;
    case StepInput::otherClass:
        return step.operand.own ? classJson(*step.operand.own) : json(step.operand.name);
    case StepInput::none:
        break;
    }
    return out;
}

json classJson(const TissueClass &tissue) {
    json out = {{"name", tissue.name},
                {"range", {tissue.low, tissue.high}},
                {"softness", tissue.softness},
                {"weight", tissue.weight},
                {"color", colorText(tissue.color)}};
    if (tissue.transferFunction)
        out["transfer_function"] = functionJson(*tissue.transferFunction);
    if (!tissue.segment.empty())
        out["segment"] = tissue.segment;
    if (tissue.isDrawn)
        out["drawn"] = true;
    if (tissue.edge != 0.0)
        out["edge"] = tissue.edge;
    for (const Step &step : tissue.steps) {
        json one = {{"kind", describe(step.kind).name}};
        for (const auto &[name, value] : step.parameters)
            one[name] = value;
        if (json input = inputJson(step); !input.is_null())
            one[inputName(describe(step.kind).input)] = std::move(input);
        out["steps"].push_back(one);
    }
    return out;
}

} // namespace

json jsonOf(const Look &look) {
    json out = json::object();
    // The number of control points is part of the look, even if all weights are 1.
    if (look.transferFunction != TransferFunction())
        out["transfer_function"] = functionJson(look.transferFunction);
    for (const TissueClass &tissue : look.classes)
        out["classes"].push_back(classJson(tissue));
    return out;
}

Look lookFrom(const JsonValue &in) {
    if (!in.isObject())
        in.refuse(because::mustBeAnObject);
    Look look;
    if (const JsonValue function = in["transfer_function"])
        look.transferFunction = functionFrom(function);
    if (const JsonValue classes = in["classes"]) {
        if (classes.size() > maxClasses)
            classes.refuse(because::holdsTooManyClasses(maxClasses));
        for (const JsonValue &tissue : classes.elements())
            look.classes.push_back(classFrom(tissue, 0));
        classes.checked([&] { validate(look); });
    }
    return look;
}

} // namespace pellucid::classify
