// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/look_json.h"

#include <nlohmann/json.hpp>

#include "core/files/json_value_nlohmann.h"

namespace pellucid::classify {

namespace {

namespace because = task::because;
using files::JsonValue;
using nlohmann::json;

TransferFunction functionFrom(const JsonValue &in) {
    const TransferFunction function{in.numbers()};
    in.checked([&] { validate(function); });
    return function;
}

Step stepFrom(const JsonValue &in) {
    if (!in.isObject())
        in.refuse(because::mustHaveAKind);
    const std::string kind = in.at("kind").text();
    Step step{in.checked([&] { return stepKindNamed(kind); }), {}};
    for (const auto &member : in.members()) {
        const std::string &name = member.first;
        if (name == "kind")
            continue;
        in.checked([&] { step.at(name); }); // before the value is read
        step.parameters[name] = member.second.number();
    }
    in.checked([&] { validate(step); });
    return step;
}

TissueClass classFrom(const JsonValue &in) {
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
    if (const JsonValue edge = in["edge"])
        tissue.edge = edge.number();
    if (const JsonValue steps = in["steps"])
        for (const JsonValue &step : steps.elements())
            tissue.steps.push_back(stepFrom(step));
    in.checked([&] { validate(tissue); });
    return tissue;
}

json classJson(const TissueClass &tissue) {
    json out = {{"name", tissue.name},
                {"range", {tissue.low, tissue.high}},
                {"softness", tissue.softness},
                {"weight", tissue.weight},
                {"color", colorText(tissue.color)}};
    if (tissue.transferFunction)
        out["transfer_function"] = tissue.transferFunction->weights;
    if (!tissue.segment.empty())
        out["segment"] = tissue.segment;
    if (tissue.edge != 0.0)
        out["edge"] = tissue.edge;
    for (const Step &step : tissue.steps) {
        json one = {{"kind", describe(step.kind).name}};
        for (const auto &[name, value] : step.parameters)
            one[name] = value;
        out["steps"].push_back(one);
    }
    return out;
}

} // namespace

std::string toJson(const Look &look) {
    json out = json::object();
    // The number of control points is part of the look, even if all weights are 1.
    if (look.transferFunction != TransferFunction())
        out["transfer_function"] = look.transferFunction.weights;
    for (const TissueClass &tissue : look.classes)
        out["classes"].push_back(classJson(tissue));
    return out.dump();
}

Look lookFromJson(const std::string &source) {
    const json parsed = json::parse(source, nullptr, false);
    const JsonValue in(parsed);
    if (!in.isObject())
        in.refuse(because::mustBeAnObject);
    Look look;
    if (const JsonValue function = in["transfer_function"])
        look.transferFunction = functionFrom(function);
    if (const JsonValue classes = in["classes"]) {
        if (classes.size() > maxClasses)
            classes.refuse(because::holdsTooManyClasses(maxClasses));
        for (const JsonValue &tissue : classes.elements())
            look.classes.push_back(classFrom(tissue));
    }
    return look;
}

} // namespace pellucid::classify
