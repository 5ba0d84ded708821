// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include <QHash>
#include <QObject>
#include <QStringList>
#include <QUndoStack>

#include "core/dicom/catalogue.h"
#include "core/measure/measurement.h"
#include "core/task/reason.h"
#include "ui/document/region_marking.h"
#include "ui/document/study_view.h"
#include "ui/studies/study_source.h"

namespace pellucid::ui {

/// A volume to show. A preview is the part that has been loaded so far.
struct OpenVolume {
    volume::Volume volume;
    volume::ValueWindow initialWindow;   ///< the display window at first and after a reset
    classify::FieldWindow fieldWindow{}; ///< of the field, unless the scene has one
    bool isPreview = false;
};

/// A measurement and its result on the open volume.
struct Measured {
    measure::Measurement measurement;
    measure::Result result;
};

/// The open studies and what the user asked to see: the volume, the view of it, the measurements,
/// and the undo stack. Views and panels read it, listen to it, and change it by edits. Looking
/// (pose, crosshair, cut) changes it directly and cannot be undone.
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
    /// Opens a volume, as one change. The view is reset and the edits are dropped, unless the
    /// volume completes a preview. `adjust` changes the view before anybody sees it.
    void show(const OpenVolume &opened, const std::function<void(StudyView &)> &adjust = {});
    /// The scene's field window, or the volume's own.
    classify::FieldWindow fieldWindow() const {
        return m_view.scene.fieldWindow.value_or(m_fieldWindow);
    }
    const classify::FieldWindow &defaultFieldWindow() const { return m_fieldWindow; }
    const volume::ValueWindow &initialWindow() const { return m_initialWindow; }
    /// What the open volume shows, as far as known.
    const presets::StudyTraits &traits() const { return m_view.traits; }
    void closeVolume();

    /// Protects the open studies from being overwritten: *throws* Error{usage} if one of the paths
    /// leads to a file of a study.
    void requireOther(const std::vector<std::filesystem::path> &targets) const;

    /// How the volume is looked at. Its parts have names of their own, below.
    const StudyView &view() const { return m_view; }
    /// Its camera is that of the pose in the projection's pane.
    const scene::Scene &scene() const { return m_view.scene; }
    /// The state behind the edits; call through `editScene`. The camera of `scene` is ignored.
    void setScene(const scene::Scene &scene);

    const Pose &pose() const { return m_view.pose; }
    /// Limits the zoom to `minZoom` .. `maxZoom`. `isMoving`: more moves may follow.
    void setPose(const Pose &pose, bool isMoving = false);
    /// See ui::fittingPixelMm; 1 without a volume.
    double fittingPixelMm() const;
    /// The pose that looks the way a camera does, at its pixel size. The camera may belong to
    /// another pane.
    Pose poseOf(const scene::Camera &camera) const;
    /// Reports the size of the projection's pane; the pose stays. *Units*: device pixels, not
    /// rounded.
    void setProjectionSize(const QSizeF &size);

    const volume::ValueWindow &displayWindow() const { return m_view.displayWindow; }
    /// The state behind the edits; call through `EditDisplayWindow`.
    void setDisplayWindow(const volume::ValueWindow &window);

    /// The exposure of the projection for the present scene; none until its picture has
    /// been shown.
    std::optional<scene::Exposure> exposure() const;
    void setExposure(const scene::Exposure &exposure);

    volume::PatientPoint crosshair() const { return m_view.crosshair; }
    void setCrosshair(volume::PatientPoint point);
    /// Moves it to the sample in the middle of the volume: the planes then show slices of the scan
    /// and not a mixture of two.
    void centerCrosshair();

    const Cut &cut() const { return m_view.cut; }
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
    const std::shared_ptr<const segment::SegmentSet> &segments() const { return m_view.segments; }
    void setSegments(std::shared_ptr<const segment::SegmentSet> segments);
    /// Whether the planes tint the segments of shown classes.
    bool tintsSegments() const { return m_tintsSegments; }
    void setTintsSegments(bool tints);
    /// The marking of regions by hand.
    RegionMarking &marking() { return m_marking; }
    const RegionMarking &marking() const { return m_marking; }

    QUndoStack *undoStack() { return &m_undo; }

    /// Calls `react`, a method of the listener or a function, with or without the changes, after
    /// each change of one of these kinds.
    template <class Listener, class React>
    void whenever(Changes what, Listener *listener, React react) const {
        connect(this, &Document::changed, listener, [what, listener, react](Changes changes) {
            if (!(changes & what))
                return;
            if constexpr (std::is_invocable_v<React, Changes>)
                react(changes);
            else if constexpr (std::is_invocable_v<React, Listener *>)
                std::invoke(react, listener);
            else
                react();
        });
    }

signals:
    void changed(pellucid::ui::Changes what);
    /// An edit would make an invalid look, and was not made.
    void editRefused(const pellucid::task::Reason &reason);

private:
    void updateCamera();
    /// How the open volume is looked at first, after a former view.
    StudyView freshView(const StudyView &former) const;

    std::vector<StudySource> m_sources;
    QHash<QString, int> m_sourceIndices; ///< by key: a disc may contain a thousand series
    int m_currentSource = -1;
    std::vector<dicom::Skipped> m_problems;
    std::optional<volume::Volume> m_volume;
    bool m_preview = false;
    classify::FieldWindow m_fieldWindow;
    int m_selectedClass = -1;
    std::optional<classify::TissueClass> m_tint;
    bool m_tintsSegments = true;
    RegionMarking m_marking;
    StudyView m_view;
    QSizeF m_projectionSize{2.0, 2.0};
    volume::ValueWindow m_initialWindow{40.0, 400.0, {}};
    bool m_isWindowSet = false; ///< for this volume, after it was opened
    std::vector<Measured> m_measured;
    int m_selectedMeasurement = -1;
    QUndoStack m_undo;
};

} // namespace pellucid::ui
