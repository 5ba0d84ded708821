// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/cli/terminal.h"
#include "core/task/reason.h"
#include "core/volume/lattice.h"

namespace pellucid::cli {

/// Indented JSON. Bytes that are not UTF-8, which headers may contain, are replaced.
inline std::string jsonText(const nlohmann::json &value) {
    return escapedControls(value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

inline std::vector<std::string> englishTexts(const std::vector<task::Reason> &reasons) {
    std::vector<std::string> texts;
    for (const task::Reason &reason : reasons)
        texts.push_back(reason.english());
    return texts;
}

inline nlohmann::json sizeJson(const volume::GridSize &size) {
    return {size.i, size.j, size.k};
}

} // namespace pellucid::cli
