// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/reason_lines.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "app/cli/terminal.h"
#include "core/dicom/reasons.h"

namespace pellucid::cli {

namespace {

constexpr std::size_t mostNames = 3;

struct Group {
    const Named *first;
    std::vector<std::string> names; // at most mostNames
    std::size_t count = 0;
};

} // namespace

std::vector<std::string> linesByReason(const std::vector<Named> &all, const std::string &what) {
    std::vector<Group> groups;
    std::map<std::string, std::size_t> indices; // by encoded reason
    for (const Named &one : all) {
        // Each copy is of another file.
        const bool isCopy = one.reason.is(task::because::hasInstanceUidOf);
        const auto [known, isNew] =
            indices.emplace(isCopy ? std::string() : one.reason.encoded(), groups.size());
        if (isNew)
            groups.push_back({&one});
        Group &group = groups[known->second];
        if (++group.count <= mostNames && !one.name.empty())
            group.names.push_back(one.name);
    }
    std::vector<std::string> lines;
    for (const Group &group : groups) {
        std::string reason = group.first->reason.english();
        if (group.names.empty()) {
            lines.push_back(fmt::format("{} {}: {}", group.count, what, reason));
            continue;
        }
        if (group.count == 1) {
            lines.push_back(fmt::format("{}: {}: {}", group.first->name, what, reason));
            continue;
        }
        if (group.first->reason.is(task::because::hasInstanceUidOf))
            reason = "have the same instance UIDs as others";
        std::string names;
        for (const std::string &name : group.names)
            names += (names.empty() ? "" : ", ") + name;
        if (group.count > mostNames)
            names += " and " + counted(group.count - mostNames, "other");
        lines.push_back(fmt::format("{} {}: {}: {}", group.count, what, reason, names));
    }
    return lines;
}

} // namespace pellucid::cli
