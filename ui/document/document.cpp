// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/document.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <QFileInfo>

#include "core/files/file_ids.h"
#include "core/task/error.h"
#include "ui/document/reasons.h"

namespace pellucid::ui {

namespace {

constexpr int fewSlices = 6;

QStringList filesOf(const StudySource &source) {
    QStringList files = source.files + source.lasting;
    for (const auto &segmentation : source.segmentations)
        files << segmentation.first;
    return files;
}

volume::PatientPoint middleSample(const volume::Lattice &lattice) {
    const volume::GridSize n = lattice.size();
    return lattice.patient(volume::VoxelIndex{n.i / 2, n.j / 2, n.k / 2});
}

} // namespace

Document::Document(QObject *parent) : QObject(parent) {
    updateCamera();
}

std::vector<int> Document::addSources(std::vector<StudySource> sources) {
    std::vector<int> indices;
    for (StudySource &source : sources) {
        const QString key = source.key();
        const int index = m_sourceIndices.value(key, int(m_sources.size()));
        indices.push_back(index);
        if (index == int(m_sources.size())) {
            m_sourceIndices.insert(key, index);
            m_sources.push_back(std::move(source));
        } else {
            m_sources[std::size_t(index)] = std::move(source);
        }
    }
    emit sourcesChanged();
    return indices;
}

void Document::closeSource(int index) {
    m_sources.at(std::size_t(index)).isClosed = true;
    emit sourcesChanged();
}

QString Document::place() const {
    return m_currentSource < 0 ? QString() : m_sources[std::size_t(m_currentSource)].place();
}

void Document::setCurrentSource(int index) {
    if (index == m_currentSource)
        return;
    m_currentSource = index;
    emit currentSourceChanged();
}

void Document::addProblems(const std::vector<dicom::Skipped> &problems) {
    if (problems.empty())
        return;
    // A folder that is opened again has the same problems.
    std::set<std::pair<std::string, std::string>> known;
    for (const dicom::Skipped &problem : m_problems)
        known.emplace(problem.path.native(), problem.reason.encoded());
    for (const dicom::Skipped &problem : problems)
        if (known.emplace(problem.path.native(), problem.reason.encoded()).second)
            m_problems.push_back(problem);
    emit problemsChanged();
}

void Document::requireOther(const std::vector<std::filesystem::path> &targets) const {
    const files::FileIds there(targets);
    if (there.isEmpty())
        return;
    for (const StudySource &source : m_sources)
        for (const QString &file : filesOf(source))
            if (there.find(file.toStdString()))
                throw task::Error(
                    task::ErrorCode::usage,
                    task::because::isOfAnOpenStudy(QFileInfo(file).fileName().toStdString()));
    if (m_segments)
        for (const segment::Segmentation &segmentation : m_segments->segmentations())
            if (there.find(segmentation.path))
                throw task::Error(
                    task::ErrorCode::usage,
                    task::because::isOfAnOpenStudy(segmentation.path.filename().string()));
}

void Document::clearProblems() {
    m_problems.clear();
    emit problemsChanged();
}

void Document::setVolume(const volume::Volume &volume, const volume::ValueWindow &initialWindow,
                         const classify::FieldWindow &fieldWindow, bool preview) {
    m_initialWindow = initialWindow;
    m_fieldWindow = fieldWindow;
    const bool same = m_volume && m_preview;
    // Slices that were not there may lie elsewhere than expected.
    const bool isInPlace = same && m_volume->lattice().fillsSameBox(volume.lattice());
    const bool isInTheMiddle = same && m_crosshair == middleSample(m_volume->lattice());
    m_volume = volume;
    m_preview = preview;
    m_exposure.reset(); // that of a preview, which lacks slices, is another one
    if (!same) {
        // Edits belong to their study.
        m_undo.clear();
        m_isWindowSet = false;
        m_traits = {presets::regionsNamed(volume.notes().bodyPart, volume.notes().title)};
        m_crosshair = middleSample(volume.lattice());
        // Other planes would cut only a strip out of a few slices.
        m_cut.axes = (volume.lattice().size().k < fewSlices || volume.notes().isLocalizer) &&
                             volume.notes().placed
                         ? mpr::PlaneAxes::along(volume.lattice())
                         : mpr::PlaneAxes();
        m_measured.clear();
        m_selectedMeasurement = -1;
        // The quality of pictures is the user's choice and stays; what they show belongs to the
        // study.
        scene::Scene fresh;
        fresh.tolerance = m_scene.tolerance;
        fresh.interpolation = m_scene.interpolation;
        fresh.tone.inverted = initialWindow.isInverted; // in the same sense as the planes
        m_scene = fresh;
        m_selectedClass = -1;
        RegionOptions options = m_marking.options();
        options.addsPoints = false; // of a class that is gone
        m_marking.setOptions(options);
        m_pose = {};
        setSegments(nullptr);
    }
    if (same && (!isInPlace || isInTheMiddle)) // through samples, as if it had come at once
        m_crosshair = middleSample(volume.lattice());
    // A preview's quantiles are those of the slices that came first; a window that the user has set
    // meanwhile stays.
    if (!same || (!preview && !m_isWindowSet))
        m_window = initialWindow;
    updateCamera();
    emit volumeChanged();
}

void Document::setTraits(const presets::StudyTraits &traits) {
    if (traits == m_traits)
        return;
    m_traits = traits;
    emit traitsChanged();
}

void Document::closeVolume() {
    m_volume.reset();
    m_exposure.reset();
    m_traits = {};
    m_measured.clear();
    m_selectedMeasurement = -1;
    m_preview = false;
    m_undo.clear();
    setSegments(nullptr);
    updateCamera();
    emit volumeChanged();
}

double Document::fittingPixelMm() const {
    return m_volume ? ui::fittingPixelMm(m_volume->lattice().radiusMm(), m_projectionSize) : 1.0;
}

void Document::updateCamera() {
    m_scene.camera = cameraOf(m_pose, fittingPixelMm(), m_projectionSize);
}

void Document::setScene(const scene::Scene &scene) {
    m_scene = scene;
    updateCamera();
    emit sceneChanged();
}

void Document::setPose(const Pose &pose) {
    Pose limited = pose;
    limited.zoom = std::clamp(pose.zoom, minZoom, maxZoom);
    if (m_pose == limited)
        return;
    m_pose = limited;
    updateCamera();
    emit poseChanged();
}

Pose Document::poseOf(const scene::Camera &camera) const {
    return {camera.orientation, camera.panMm, fittingPixelMm() / camera.pixelMm, false};
}

void Document::setProjectionSize(const QSizeF &size) {
    if (m_projectionSize == size)
        return;
    m_projectionSize = size;
    updateCamera();
    emit projectionResized();
}

int Document::selectedClass() const {
    const int count = int(m_scene.look.classes.size());
    return count == 0 ? -1 : std::clamp(m_selectedClass, 0, count - 1);
}

void Document::selectClass(int index) {
    if (index == m_selectedClass)
        return;
    m_selectedClass = index;
    emit selectedClassChanged();
}

void Document::setTint(const std::optional<classify::TissueClass> &tint) {
    if (tint == m_tint)
        return;
    m_tint = tint;
    emit tintChanged();
}

void Document::setSegments(std::shared_ptr<const segment::SegmentSet> segments) {
    if (segments == m_segments)
        return;
    m_segments = std::move(segments);
    emit segmentsChanged();
}

void Document::setTintsSegments(bool tints) {
    if (tints == m_tintsSegments)
        return;
    m_tintsSegments = tints;
    emit segmentsChanged();
}

QStringList Document::missingSegments(const classify::Look &look) const {
    QStringList missing;
    for (const std::set<std::string> &segments : classify::segmentsOf(look))
        for (const std::string &name : segments)
            if (!m_segments || m_segments->find(name) == nullptr)
                missing << QString::fromStdString(name);
    missing.removeDuplicates();
    return missing;
}

void Document::setDisplayWindow(const volume::ValueWindow &window) {
    m_window = window;
    m_isWindowSet = true;
    emit displayWindowChanged();
}

void Document::centerCrosshair() {
    if (m_volume)
        setCrosshair(middleSample(m_volume->lattice()));
}

void Document::setCut(const Cut &cut) {
    if (cut == m_cut)
        return;
    m_cut = cut;
    emit cutChanged();
}

std::vector<measure::Measurement> Document::measurements() const {
    std::vector<measure::Measurement> all;
    for (const Measured &m : m_measured)
        all.push_back(m.measurement);
    return all;
}

void Document::setMeasurements(const std::vector<measure::Measurement> &measurements) {
    if (!m_volume || m_preview) // a part of a volume is not measured
        return;
    std::vector<Measured> measured;
    for (const measure::Measurement &m : measurements) {
        const std::size_t n = measured.size();
        // A drag changes one measurement many times: the others keep their results.
        measured.push_back({m, n < m_measured.size() && m_measured[n].measurement == m
                                   ? m_measured[n].result
                                   : measure::measure(m, *m_volume)});
    }
    m_measured = std::move(measured);
    emit measurementsChanged();
    if (m_selectedMeasurement >= int(m_measured.size()))
        selectMeasurement(-1);
}

void Document::selectMeasurement(int index) {
    if (index == m_selectedMeasurement)
        return;
    m_selectedMeasurement = index;
    emit selectedMeasurementChanged();
}

std::optional<scene::Exposure> Document::exposure() const {
    return m_exposure && m_exposure->of == picture::ToneSubject(m_scene)
               ? std::optional(m_exposure->exposure)
               : std::nullopt;
}

void Document::setExposure(const scene::Exposure &exposure) {
    const MeasuredExposure measured{exposure, picture::ToneSubject(m_scene)};
    if (measured == m_exposure)
        return;
    m_exposure = measured;
    emit exposureChanged();
}

void Document::setCrosshair(volume::PatientPoint point) {
    if (m_crosshair.mm == point.mm)
        return;
    m_crosshair = point;
    emit crosshairChanged();
}

} // namespace pellucid::ui
