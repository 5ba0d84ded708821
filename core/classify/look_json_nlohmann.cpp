// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/look_json.h"

#include <nlohmann/json.hpp>

#include "core/classify/json_values_nlohmann.h"
#include "core/task/error.h"

namespace pellucid::classify {

namespace {

namespace because = task::because;
using nlohmann::json;
using task::Error;

// What checks a value says, said of where it stands.
template <class F> auto at(const std::string &where, const F &check) {
    try {
        return check();
    } catch (const Error &error) {
        refuseJson(where, error.reason());
    }
}

TransferFunction functionFromJson(const json &in, const std::string &where) {
    const TransferFunction function{jsonNumbers(in, where)};
    at(where, [&] { validate(function); });
    return function;
}

Step stepFromJson(const json &in, const std::string &where) {
    if (!in.is_object())
        refuseJson(where, because::mustHaveAKind);
    if (!in.contains("kind"))
        refuseJson(where, because::hasNo("kind"));
    Step step{jsonText(in["kind"], where + "/kind"), {}};
    for (const auto &[key, value] : in.items())
        if (key != "kind") {
            const std::string &name = key; // clang 14 captures no structured bindings
            at(where, [&] { static_cast<void>(step.at(name)); }); // before the value is looked at
            step.parameters[name] = jsonNumber(value, where + "/" + name);
        }
    at(where, [&] { validate(step); });
    return step;
}

TissueClass classFromJson(const json &in, const std::string &where) {
    if (!in.is_object())
        refuseJson(where, because::mustHaveANameAndARange);
    for (const char *key : {"name", "range"})
        if (!in.contains(key))
            refuseJson(where, because::hasNo(key));
    TissueClass tissue;
    tissue.name = jsonText(in["name"], where + "/name");
    const auto range = jsonNumbers(in["range"], where + "/range");
    if (range.size() != 2)
        refuseJson(where + "/range", because::mustBeTwoNumbers);
    tissue.low = range[0];
    tissue.high = range[1];
    if (in.contains("softness"))
        tissue.softness = jsonNumber(in["softness"], where + "/softness");
    if (in.contains("weight"))
        tissue.weight = jsonNumber(in["weight"], where + "/weight");
    if (in.contains("color"))
        tissue.color = at(where + "/color",
                          [&] { return colorFromText(jsonText(in["color"], where + "/color")); });
    if (in.contains("transfer_function"))
        tissue.transferFunction =
            functionFromJson(in["transfer_function"], where + "/transfer_function");
    if (in.contains("steps")) {
        if (!in["steps"].is_array())
            refuseJson(where + "/steps", because::mustBeAList);
        for (std::size_t n = 0; n < in["steps"].size(); ++n)
            tissue.steps.push_back(
                stepFromJson(in["steps"][n], where + "/steps/" + std::to_string(n)));
    }
    at(where, [&] { validate(tissue); });
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
    for (const Step &step : tissue.steps) {
        json one = {{"kind", step.kind}};
        for (const auto &[name, value] : step.parameters)
            one[name] = value;
        out["steps"].push_back(one);
    }
    return out;
}

} // namespace

std::string toJson(const Look &look) {
    json out = json::object();
    // The number of control points is part of the look even if they all are one.
    if (look.transferFunction != TransferFunction())
        out["transfer_function"] = look.transferFunction.weights;
    for (const TissueClass &tissue : look.classes)
        out["classes"].push_back(classJson(tissue));
    return out.dump();
}

Look lookFromJson(const std::string &source) {
    const json in = json::parse(source, nullptr, false);
    if (!in.is_object())
        refuseJson("", because::mustBeAnObject);
    Look look;
    if (in.contains("transfer_function"))
        look.transferFunction = functionFromJson(in["transfer_function"], "/transfer_function");
    if (in.contains("classes")) {
        if (!in["classes"].is_array())
            refuseJson("/classes", because::mustBeAList);
        if (in["classes"].size() > mostClasses)
            refuseJson("/classes", because::holdsTooManyClasses(mostClasses));
        for (std::size_t n = 0; n < in["classes"].size(); ++n)
            look.classes.push_back(
                classFromJson(in["classes"][n], "/classes/" + std::to_string(n)));
    }
    return look;
}

} // namespace pellucid::classify
