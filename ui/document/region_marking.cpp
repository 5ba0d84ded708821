// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/region_marking.h"

namespace pellucid::ui {

void RegionMarking::setTool(RegionTool tool) {
    if (tool == m_tool)
        return;
    m_tool = tool;
    m_candidate.reset();
    emit toolChanged();
}

void RegionMarking::setOptions(const RegionOptions &options) {
    if (options == m_options)
        return;
    m_options = options;
    emit optionsChanged();
}

void RegionMarking::setCandidate(const std::optional<classify::TissueClass> &candidate) {
    if (candidate == m_candidate)
        return;
    m_candidate = candidate;
    emit candidateChanged();
}

void RegionMarking::setTint(const std::optional<RegionTint> &tint) {
    if (tint == m_tint)
        return;
    m_tint = tint;
    emit tintChanged();
}

void RegionMarking::setSearching(bool isSearching) {
    if (isSearching == m_isSearching)
        return;
    m_isSearching = isSearching;
    emit tintChanged();
}

} // namespace pellucid::ui
