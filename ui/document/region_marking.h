// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <QObject>
#include <QString>

#include "core/classify/region_edits.h"
#include "core/volume/coverage.h"

namespace pellucid::ui {

/// The tools that mark regions.
enum class RegionTool { none, connected, paint, scissors };

/// How a region tool changes the classes.
struct RegionOptions {
    classify::RegionUse use = classify::RegionUse::newClass; ///< of connected regions
    classify::RegionUse cutUse = classify::RegionUse::remove;
    /// A click adds a point to the selected class, instead of finding a new region.
    bool addsPoints = false;
    bool ofEveryClass = false; ///< keeps and removes in every class, not only in the selected one
    bool isBone = false;       ///< the region is bone, with its marrow and its rim
    double leakMm = 0.0;       ///< as for the step `connected`
    double ballMm = 5.0;       ///< radius
    bool erases = false;
    double slabMm = 0.0; ///< thickness of the cut, about the crosshair; 0: all of the volume
    bool operator==(const RegionOptions &) const = default;
};

/// The use of the region that a tool marks.
inline const classify::RegionUse &useOf(const RegionOptions &options, RegionTool tool) {
    return tool == RegionTool::scissors ? options.cutUse : options.use;
}
inline classify::RegionUse &useOf(RegionOptions &options, RegionTool tool) {
    return tool == RegionTool::scissors ? options.cutUse : options.use;
}

/// A region that the planes tint.
struct RegionTint {
    std::shared_ptr<const volume::Coverage> coverage;
    classify::Color color;
    double volumeMl = 0.0;
    bool operator==(const RegionTint &) const = default;
};

/// The state of marking regions by hand: the tool, its options, the region that is being chosen,
/// and what the planes show of it.
class RegionMarking : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

    RegionTool tool() const { return m_tool; }
    void setTool(RegionTool tool);
    /// Asks the window to choose a tool.
    void requestTool(RegionTool tool) { emit toolRequested(tool); }

    const RegionOptions &options() const { return m_options; }
    void setOptions(const RegionOptions &options);

    /// The region that the user is choosing, with its operands; not set: none.
    const std::optional<classify::TissueClass> &candidate() const { return m_candidate; }
    void setCandidate(const std::optional<classify::TissueClass> &candidate);

    /// The region that was found last; not set: none is shown.
    const std::optional<RegionTint> &tint() const { return m_tint; }
    void setTint(const std::optional<RegionTint> &tint);
    /// Whether a region is being found.
    bool isSearching() const { return m_isSearching; }
    void setSearching(bool isSearching);

signals:
    void toolChanged();
    void toolRequested(pellucid::ui::RegionTool tool);
    void optionsChanged();
    void candidateChanged();
    /// Also if a search began or ended.
    void tintChanged();

private:
    RegionTool m_tool = RegionTool::none;
    RegionOptions m_options;
    std::optional<classify::TissueClass> m_candidate;
    std::optional<RegionTint> m_tint;
    bool m_isSearching = false;
};

} // namespace pellucid::ui
