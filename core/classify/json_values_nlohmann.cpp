// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/json_values_nlohmann.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/task/error.h"

namespace pellucid::classify {

namespace because = task::because;
using nlohmann::json;

void refuseJson(const std::string &where, const task::Reason &what) {
    throw task::Error(task::ErrorCode::usage, because::at(where, what));
}

JsonRefusal jsonRefusal(const task::Reason &reason) {
    if (!reason.is(because::at))
        return {"", reason};
    return {reason.arguments()[0].text, reason.arguments()[1].reasons.front()};
}

double jsonNumber(const json &in, const std::string &where) {
    constexpr double largest = 1e30;
    if (!in.is_number())
        refuseJson(where, because::mustBeANumber);
    const double value = in.get<double>();
    if (!(std::abs(value) <= largest))
        refuseJson(where, because::isOutOfRange);
    return value;
}

std::vector<double> jsonNumbers(const json &in, const std::string &where) {
    if (!in.is_array())
        refuseJson(where, because::mustBeNumbers);
    std::vector<double> values;
    for (std::size_t n = 0; n < in.size(); ++n)
        values.push_back(jsonNumber(in[n], where + "/" + std::to_string(n)));
    return values;
}

std::string jsonText(const json &in, const std::string &where) {
    if (!in.is_string())
        refuseJson(where, because::mustBeAText);
    return in.get<std::string>();
}

} // namespace pellucid::classify
