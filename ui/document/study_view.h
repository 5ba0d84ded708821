// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <QFlags>
#include <QStringList>

#include "core/mpr/reslice.h"
#include "core/picture/tone_subject.h"
#include "core/presets/study_traits.h"
#include "core/scene/scene.h"
#include "core/segment/segment_set.h"
#include "core/volume/volume.h"
#include "ui/document/pose.h"

namespace pellucid::ui {

/// How the planes cut the volume, the same for all three.
struct Cut {
    mpr::PlaneAxes axes;
    mpr::ResliceOptions options;
    bool operator==(const Cut &) const = default;
};

/// The exposure of a projection, and what it was measured of: it holds for that alone.
struct MeasuredExposure {
    scene::Exposure exposure;
    picture::ToneSubject of;
    bool operator==(const MeasuredExposure &) const = default;
};

/// How a study is looked at. Everything that shows a study in another place or at another time
/// copies this value: sessions, studies that were open before, phases.
struct StudyView {
    scene::Scene scene; ///< its camera is that of the pose in the projection's pane
    Pose pose;
    volume::ValueWindow displayWindow{40.0, 400.0, {}};
    volume::PatientPoint crosshair;
    Cut cut;
    /// Those that are loaded for the volume; null if there are none.
    std::shared_ptr<const segment::SegmentSet> segments;
    std::optional<MeasuredExposure> exposure;
    presets::StudyTraits traits; ///< what the volume shows, as far as known
};

/// The names of segments that the classes of a look need but that are not among these, which may
/// be null.
QStringList missingSegments(const classify::Look &look, const segment::SegmentSet *segments);
/// Removes the classes that need them.
void dropMissing(classify::Look &look, const segment::SegmentSet *segments);

/// What has changed in a document.
enum class Change {
    volume = 1 << 0, ///< another one, or more of it: all that follows up to `selection`, too
    scene = 1 << 1,
    pose = 1 << 2,
    displayWindow = 1 << 3,
    crosshair = 1 << 4,
    cut = 1 << 5,
    segments = 1 << 6, ///< or whether the planes tint them
    exposure = 1 << 7,
    measurements = 1 << 8,
    selection = 1 << 9, ///< of a class or a measurement
    paneSize = 1 << 10, ///< the camera of the scene has other pixels; the pose is the same
    tint = 1 << 11,
    sources = 1 << 12,
    currentSource = 1 << 13,
    problems = 1 << 14,
    moving = 1 << 15, ///< beside `pose`: more moves may follow, so a draft will do
};
Q_DECLARE_FLAGS(Changes, Change)
Q_DECLARE_OPERATORS_FOR_FLAGS(Changes)

/// What changes a `StudyView`.
inline constexpr Changes viewChanges =
    Changes(Change::volume) | Change::scene | Change::pose | Change::paneSize |
    Change::displayWindow | Change::crosshair | Change::cut | Change::segments | Change::exposure;

} // namespace pellucid::ui
