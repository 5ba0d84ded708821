// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <QHash>
#include <QObject>
#include <QStringList>
#include <QUndoStack>

#include "core/dicom/catalogue.h"
#include "core/measure/measurement.h"
#include "core/mpr/reslice.h"
#include "core/picture/compose.h"
#include "core/picture/tone_subject.h"
#include "core/presets/study_traits.h"
#include "core/scene/scene.h"
#include "core/segment/segment_set.h"
#include "core/task/reason.h"
#include "core/volume/volume.h"
#include "ui/document/pose.h"
#include "ui/document/region_marking.h"
#include "ui/studies/study_source.h"

namespace pellucid::ui {

/// How the planes cut the volume, the same for all three.
struct Cut {
    mpr::PlaneAxes axes;
    mpr::ResliceOptions options;
    bool operator==(const Cut &) const = default;
};

/// A measurement and its result on the open volume.
struct Measured {
    measure::Measurement measurement;
    measure::Result result;
};

/// The open studies and what the user asked to see: the volume, the Scene, the pose, the display
/// window, the crosshair, the measurements, and the undo stack. Views and panels read it, listen to
/// it, and change it by edits. Looking (pose, crosshair, cut) changes it directly and cannot be
/// undone.
class Document : public QObject {
    Q_OBJECT
public:
    explicit Document(QObject *parent = nullptr);

    const std::vector<StudySource> &sources() const { return m_sources; }
    /// Adds sources, or replaces those with the same key. *Shape*: their indices, in order.
    std::vector<int> addSources(std::vector<StudySource> sources);
    /// The index of the source with this key, or -1.
    int sourceWith(const QString &key) const { return m_sourceIndices.value(key, -1); }
    /// Takes a source off the list; indices stay valid.
    void closeSource(int index);
    int currentSource() const { return m_currentSource; }
    /// The path of the current source; empty if there is none.
    QString place() const;
    void setCurrentSource(int index);

    const std::vector<dicom::Skipped> &problems() const { return m_problems; }
    void addProblems(const std::vector<dicom::Skipped> &problems);
    void clearProblems();

    /// The open volume. A preview is the part that has been loaded so far.
    const std::optional<volume::Volume> &volume() const { return m_volume; }
    bool isPreview() const { return m_preview; }
    /// Opens a volume. Scene, pose, crosshair and window are reset and the edits are dropped,
    /// unless the volume completes a preview; `volumeChanged` alone announces all of it.
    /// `initialWindow`: the display window at first and after a reset. `fieldWindow`: the window of
    /// the field unless the scene has one.
    void setVolume(const volume::Volume &volume, const volume::ValueWindow &initialWindow,
                   const classify::FieldWindow &fieldWindow, bool preview);
    /// The scene's field window, or the volume's own.
    classify::FieldWindow fieldWindow() const {
        return m_scene.fieldWindow.value_or(m_fieldWindow);
    }
    const classify::FieldWindow &defaultFieldWindow() const { return m_fieldWindow; }
    const volume::ValueWindow &initialWindow() const { return m_initialWindow; }
    /// What the open volume shows, as far as known.
    const presets::StudyTraits &traits() const { return m_traits; }
    void setTraits(const presets::StudyTraits &traits);
    void closeVolume();

    /// Protects the open studies from being overwritten: *throws* Error{usage} if one of the paths
    /// leads to a file of a study.
    void requireOther(const std::vector<std::filesystem::path> &targets) const;

    /// Its camera is that of the pose in the projection's pane.
    const scene::Scene &scene() const { return m_scene; }
    /// The state behind the edits; call through `editScene`. The camera of `scene` is ignored.
    void setScene(const scene::Scene &scene);

    const Pose &pose() const { return m_pose; }
    /// Limits the zoom to `minZoom` .. `maxZoom`.
    void setPose(const Pose &pose);
    /// See ui::fittingPixelMm; 1 without a volume.
    double fittingPixelMm() const;
    /// The pose that looks the way a camera does, at its pixel size. The camera may belong to
    /// another pane.
    Pose poseOf(const scene::Camera &camera) const;
    /// Reports the size of the projection's pane; the pose stays. *Units*: device pixels, not
    /// rounded.
    void setProjectionSize(const QSizeF &size);

    const volume::ValueWindow &displayWindow() const { return m_window; }
    /// The state behind the edits; call through `EditDisplayWindow`.
    void setDisplayWindow(const volume::ValueWindow &window);

    /// The exposure of the projection for the present scene; none until its picture has
    /// been shown.
    std::optional<scene::Exposure> exposure() const;
    void setExposure(const scene::Exposure &exposure);

    volume::PatientPoint crosshair() const { return m_crosshair; }
    void setCrosshair(volume::PatientPoint point);
    /// Moves it to the sample in the middle of the volume: the planes then show slices of the scan
    /// and not a mixture of two.
    void centerCrosshair();

    const Cut &cut() const { return m_cut; }
    void setCut(const Cut &cut);

    const std::vector<Measured> &measured() const { return m_measured; }
    std::vector<measure::Measurement> measurements() const;
    /// The state behind the edits; call through `EditMeasurements`. A preview has no measurements.
    void setMeasurements(const std::vector<measure::Measurement> &measurements);
    /// -1: none.
    int selectedMeasurement() const { return m_selectedMeasurement; }
    void selectMeasurement(int index);

    /// The class whose curve and range the panels show; -1: the whole volume.
    int selectedClass() const;
    void selectClass(int index);
    /// A range of values that the planes tint while the user chooses it.
    const std::optional<classify::TissueClass> &tint() const { return m_tint; }
    void setTint(const std::optional<classify::TissueClass> &tint);

    /// The segments that are loaded for the volume; null if there are none. They stay loaded when
    /// an undo removes their classes.
    const std::shared_ptr<const segment::SegmentSet> &segments() const { return m_segments; }
    void setSegments(std::shared_ptr<const segment::SegmentSet> segments);
    /// Whether the planes tint the segments of shown classes.
    bool tintsSegments() const { return m_tintsSegments; }
    void setTintsSegments(bool tints);
    /// The marking of regions by hand.
    RegionMarking &marking() { return m_marking; }
    const RegionMarking &marking() const { return m_marking; }
    /// The names of segments that the classes of a look need but that are not loaded.
    QStringList missingSegments(const classify::Look &look) const;

    QUndoStack *undoStack() { return &m_undo; }

signals:
    void sourcesChanged();
    void currentSourceChanged();
    void problemsChanged();
    void volumeChanged();
    void sceneChanged();
    /// The camera of the scene has changed with it.
    void poseChanged();
    /// The camera of the scene has other pixels; the pose is the same.
    void projectionResized();
    void displayWindowChanged();
    void traitsChanged();
    void exposureChanged();
    void crosshairChanged();
    void cutChanged();
    void measurementsChanged();
    void selectedMeasurementChanged();
    void selectedClassChanged();
    void tintChanged();
    /// An edit would make an invalid look, and was not made.
    void editRefused(const pellucid::task::Reason &reason);
    /// Also after a new volume, which has none at first, and if the planes tint them or not.
    void segmentsChanged();

private:
    void updateCamera();

    std::vector<StudySource> m_sources;
    QHash<QString, int> m_sourceIndices; ///< by key: a disc may contain a thousand series
    int m_currentSource = -1;
    std::vector<dicom::Skipped> m_problems;
    std::optional<volume::Volume> m_volume;
    bool m_preview = false;
    classify::FieldWindow m_fieldWindow;
    int m_selectedClass = -1;
    std::optional<classify::TissueClass> m_tint;
    std::shared_ptr<const segment::SegmentSet> m_segments;
    bool m_tintsSegments = true;
    RegionMarking m_marking;
    scene::Scene m_scene;
    Pose m_pose;
    QSizeF m_projectionSize{2.0, 2.0};
    volume::ValueWindow m_window{40.0, 400.0, {}}, m_initialWindow{40.0, 400.0, {}};
    bool m_isWindowSet = false; ///< for this volume, after it was opened
    struct MeasuredExposure {
        scene::Exposure exposure;
        picture::ToneSubject of;
        bool operator==(const MeasuredExposure &) const = default;
    };
    presets::StudyTraits m_traits;
    std::optional<MeasuredExposure> m_exposure;
    volume::PatientPoint m_crosshair;
    Cut m_cut;
    std::vector<Measured> m_measured;
    int m_selectedMeasurement = -1;
    QUndoStack m_undo;
};

} // namespace pellucid::ui
