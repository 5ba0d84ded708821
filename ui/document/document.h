// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <QHash>
#include <QObject>
#include <QUndoStack>

#include "core/dicom/catalogue.h"
#include "core/measure/measurement.h"
#include "core/mpr/reslice.h"
#include "core/picture/compose.h"
#include "core/picture/tone_subject.h"
#include "core/scene/scene.h"
#include "core/volume/volume.h"
#include "ui/studies/study_source.h"

namespace pellucid::ui {

/// How the planes cut the volume; the same for all three.
struct Cut {
    mpr::PlaneAxes axes;
    mpr::ResliceOptions options;
    bool operator==(const Cut &) const = default;
};

/// A measurement and what it gives on the open volume.
struct Measured {
    measure::Measurement measurement;
    measure::Result result;
};

/// What is open and what is asked to be seen: the studies, the volume, the Scene, the display
/// window, the crosshair, the measurements, and the undo stack. Views and panels read it, listen to
/// it, and change it by commands; looking (camera, crosshair, cut) changes it directly and is not
/// undoable.
class Document : public QObject {
    Q_OBJECT
public:
    explicit Document(QObject *parent = nullptr);

    const std::vector<StudySource> &sources() const { return m_sources; }
    /// Adds sources, or replaces those that are there already. *Shape*: their indices, in order.
    std::vector<int> addSources(std::vector<StudySource> sources);
    /// The index of the source with a key; -1: none.
    int sourceWith(const QString &key) const { return m_sourceIndices.value(key, -1); }
    /// It is listed no more; indices stay.
    void closeSource(int index);
    int currentSource() const { return m_currentSource; }
    /// Of the current source, if there is one.
    QString place() const;
    void setCurrentSource(int index);

    const std::vector<dicom::Skipped> &problems() const { return m_problems; }
    void addProblems(const std::vector<dicom::Skipped> &problems);
    void clearProblems();

    /// The open volume. A preview is the part that has arrived; it keeps crosshair and window.
    const std::optional<volume::Volume> &volume() const { return m_volume; }
    bool isPreview() const { return m_preview; }
    /// `initialWindow`: what it is first shown with, and what resetting goes back to.
    /// `fieldWindow`: what the field is made with unless the scene says otherwise.
    void setVolume(const volume::Volume &volume, const volume::ValueWindow &initialWindow,
                   const classify::FieldWindow &fieldWindow, bool preview);
    /// The scene's field window, or the volume's own.
    classify::FieldWindow fieldWindow() const {
        return m_scene.fieldWindow.value_or(m_fieldWindow);
    }
    const classify::FieldWindow &defaultFieldWindow() const { return m_fieldWindow; }
    const volume::ValueWindow &initialWindow() const { return m_initialWindow; }
    void closeVolume();

    /// Nothing that is open is written over: *throws* Error{usage} if one of the paths leads to a
    /// file of a study.
    void requireOther(const std::vector<std::filesystem::path> &targets) const;

    const scene::Scene &scene() const { return m_scene; }
    /// Looking: not undoable.
    void setCamera(const scene::Camera &camera);
    /// The state behind the undo commands; call through `editScene`.
    void setScene(const scene::Scene &scene);

    const volume::ValueWindow &displayWindow() const { return m_window; }
    /// The state behind the undo commands; call through `EditDisplayWindow`.
    void setDisplayWindow(const volume::ValueWindow &window);

    /// What the automatic brightness of the projection came to be, for the scene as it is; none: it
    /// has not been seen yet.
    std::optional<picture::ToneRange> brightness() const;
    void setBrightness(const picture::ToneRange &range);

    volume::PatientPoint crosshair() const { return m_crosshair; }
    void setCrosshair(volume::PatientPoint point);
    /// To the middle of the volume, on a slice: what is seen first is a slice of the scan and not a
    /// mixture of two.
    void centerCrosshair();

    const Cut &cut() const { return m_cut; }
    void setCut(const Cut &cut);

    const std::vector<Measured> &measured() const { return m_measured; }
    std::vector<measure::Measurement> measurements() const;
    /// The state behind the undo commands; call through `EditMeasurements`. A preview has none.
    void setMeasurements(const std::vector<measure::Measurement> &measurements);
    /// -1: none.
    int selectedMeasurement() const { return m_selectedMeasurement; }
    void selectMeasurement(int index);

    /// The class whose curve and range are looked at; -1: the whole volume.
    int selectedClass() const;
    void selectClass(int index);
    /// A range of values that the planes tint while it is chosen.
    const std::optional<classify::TissueClass> &tint() const { return m_tint; }
    void setTint(const std::optional<classify::TissueClass> &tint);

    QUndoStack *undoStack() { return &m_undo; }

    /// Tells everything anew, to a window that has just been made.
    void announce();

signals:
    void sourcesChanged();
    void currentSourceChanged();
    void problemsChanged();
    void volumeChanged();
    void cameraChanged();
    void sceneChanged();
    void displayWindowChanged();
    void brightnessChanged();
    void crosshairChanged();
    void cutChanged();
    void measurementsChanged();
    void selectedMeasurementChanged();
    void selectedClassChanged();
    void tintChanged();

private:
    std::vector<StudySource> m_sources;
    QHash<QString, int> m_sourceIndices; ///< by key: a disc may hold a thousand series
    int m_currentSource = -1;
    std::vector<dicom::Skipped> m_problems;
    std::optional<volume::Volume> m_volume;
    bool m_preview = false;
    classify::FieldWindow m_fieldWindow;
    int m_selectedClass = -1;
    std::optional<classify::TissueClass> m_tint;
    scene::Scene m_scene;
    volume::ValueWindow m_window{40.0, 400.0, {}}, m_initialWindow{40.0, 400.0, {}};
    struct Brightness {
        picture::ToneRange range;
        picture::ToneSubject of;
        bool operator==(const Brightness &) const = default;
    };
    std::optional<Brightness> m_brightness;
    volume::PatientPoint m_crosshair;
    Cut m_cut;
    std::vector<Measured> m_measured;
    int m_selectedMeasurement = -1;
    QUndoStack m_undo;
};

} // namespace pellucid::ui
