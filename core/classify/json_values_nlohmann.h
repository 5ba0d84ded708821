// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/task/reason.h"

namespace pellucid::classify {

/// For the *_nlohmann.cpp of this folder and of those that build on it; the only header that names
/// the library, so that it is not written twice.
///
/// Values read from JSON that somebody may have written by hand. `where` is the JSON pointer of the
/// value; the reason of the Error{usage} that they throw is `because::at` with it.
[[noreturn]] void refuseJson(const std::string &where, const task::Reason &what);
/// What refuseJson was told; for any other reason `where` is empty, the pointer of the whole text.
struct JsonRefusal {
    std::string where;
    task::Reason what;
};
JsonRefusal jsonRefusal(const task::Reason &reason);
/// Finite, and so that differences of two are finite in single precision.
double jsonNumber(const nlohmann::json &in, const std::string &where);
std::vector<double> jsonNumbers(const nlohmann::json &in, const std::string &where);
std::string jsonText(const nlohmann::json &in, const std::string &where);

} // namespace pellucid::classify
