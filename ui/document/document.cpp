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
// What a new volume brings with it.
constexpr Changes ofVolume =
    (viewChanges ^ Change::paneSize) | Change::measurements | Change::selection;

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
    emit changed(Change::sources);
    return indices;
}

void Document::closeSource(int index) {
    m_sources.at(std::size_t(index)).isClosed = true;
    emit changed(Change::sources);
}

QString Document::place() const {
    return m_currentSource < 0 ? QString() : m_sources[std::size_t(m_currentSource)].place();
}

void Document::setCurrentSource(int index) {
    if (index == m_currentSource)
        return;
    m_currentSource = index;
    emit changed(Change::currentSource);
}

void Document::addProblems(const std::vector<dicom::Skipped> &problems) {
    if (problems.empty())
        return;
    // A folder that is opened again has the same problems.
    std::set<std::pair<std::string, std::string>> known;
    for (const dicom::Skipped &problem : m_problems)
        known.emplace(problem.path.string(), problem.reason.encoded());
    for (const dicom::Skipped &problem : problems)
        if (known.emplace(problem.path.string(), problem.reason.encoded()).second)
            m_problems.push_back(problem);
    emit changed(Change::problems);
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
    if (m_view.segments)
        for (const segment::Segmentation &segmentation : m_view.segments->segmentations())
            if (there.find(segmentation.path))
                throw task::Error(
                    task::ErrorCode::usage,
                    task::because::isOfAnOpenStudy(segmentation.path.filename().string()));
}

void Document::clearProblems() {
    m_problems.clear();
    emit changed(Change::problems);
}

void Document::show(const OpenVolume &opened, const std::function<void(StudyView &)> &adjust) {
    const volume::Volume &volume = opened.volume;
    m_initialWindow = opened.initialWindow;
    m_fieldWindow = opened.fieldWindow;
    const bool same = m_volume && m_preview;
    // Slices that were not there may lie elsewhere than expected.
    const bool isInPlace = same && m_volume->lattice().fillsSameBox(volume.lattice());
    const bool isInTheMiddle = same && m_view.crosshair == middleSample(m_volume->lattice());
    m_volume = volume;
    m_preview = opened.isPreview;
    m_view.exposure.reset(); // that of a preview, which lacks slices, is another one
    if (!same) {
        // Edits belong to their study.
        m_undo.clear();
        m_isWindowSet = false;
        m_measured.clear();
        m_selectedMeasurement = -1;
        m_selectedClass = -1;
        m_view = freshView(m_view);
        RegionOptions options = m_marking.options();
        options.addsPoints = false; // of a class that is gone
        m_marking.setOptions(options);
    }
    if (same && (!isInPlace || isInTheMiddle)) // through samples, as if it had come at once
        m_view.crosshair = middleSample(volume.lattice());
    // A preview's quantiles are those of the slices that came first; a window that the user has set
    // meanwhile stays.
    if (!same || (!m_preview && !m_isWindowSet))
        m_view.displayWindow = m_initialWindow;
    if (adjust)
        adjust(m_view);
    m_view.pose.zoom = std::clamp(m_view.pose.zoom, minZoom, maxZoom);
    updateCamera();
    emit changed(ofVolume);
}

StudyView Document::freshView(const StudyView &former) const {
    const volume::Lattice &lattice = m_volume->lattice();
    const volume::VolumeNotes &notes = m_volume->notes();
    StudyView view;
    // The quality of pictures and the slab are the user's choice and stay; what they show belongs
    // to the study.
    view.scene.tolerance = former.scene.tolerance;
    view.scene.interpolation = former.scene.interpolation;
    view.scene.tone.inverted = m_initialWindow.isInverted; // in the same sense as the planes
    view.traits = {presets::regionsNamed(notes.bodyPart, notes.title)};
    view.crosshair = middleSample(lattice);
    view.cut.options = former.cut.options;
    // Other planes would cut only a strip out of a few slices.
    if ((lattice.size().k < fewSlices || notes.isLocalizer) && notes.placed)
        view.cut.axes = mpr::PlaneAxes::along(lattice);
    return view;
}

void Document::closeVolume() {
    m_volume.reset();
    m_view.exposure.reset();
    m_view.traits = {};
    m_view.segments = nullptr;
    m_measured.clear();
    m_selectedMeasurement = -1;
    m_preview = false;
    m_undo.clear();
    updateCamera();
    emit changed(ofVolume);
}

double Document::fittingPixelMm() const {
    return m_volume ? ui::fittingPixelMm(m_volume->lattice().radiusMm(), m_projectionSize) : 1.0;
}

void Document::updateCamera() {
    m_view.scene.camera = cameraOf(m_view.pose, fittingPixelMm(), m_projectionSize);
}

void Document::setScene(const scene::Scene &scene) {
    m_view.scene = scene;
    updateCamera();
    emit changed(Change::scene);
}

void Document::setPose(const Pose &pose, bool isMoving) {
    Pose limited = pose;
    limited.zoom = std::clamp(pose.zoom, minZoom, maxZoom);
    if (m_view.pose == limited)
        return;
    m_view.pose = limited;
    updateCamera();
    emit changed(isMoving ? Change::pose | Change::moving : Changes(Change::pose));
}

Pose Document::poseOf(const scene::Camera &camera) const {
    return {camera.orientation, camera.panMm, fittingPixelMm() / camera.pixelMm, false};
}

void Document::setProjectionSize(const QSizeF &size) {
    if (m_projectionSize == size)
        return;
    m_projectionSize = size;
    updateCamera();
    emit changed(Change::paneSize);
}

int Document::selectedClass() const {
    const int count = int(m_view.scene.look.classes.size());
    return count == 0 ? -1 : std::clamp(m_selectedClass, 0, count - 1);
}

void Document::selectClass(int index) {
    if (index == m_selectedClass)
        return;
    m_selectedClass = index;
    emit changed(Change::selection);
}

void Document::setTint(const std::optional<classify::TissueClass> &tint) {
    if (tint == m_tint)
        return;
    m_tint = tint;
    emit changed(Change::tint);
}

void Document::setSegments(std::shared_ptr<const segment::SegmentSet> segments) {
    if (segments == m_view.segments)
        return;
    m_view.segments = std::move(segments);
    emit changed(Change::segments);
}

void Document::setTintsSegments(bool tints) {
    if (tints == m_tintsSegments)
        return;
    m_tintsSegments = tints;
    emit changed(Change::segments);
}

void Document::setDisplayWindow(const volume::ValueWindow &window) {
    m_view.displayWindow = window;
    m_isWindowSet = true;
    emit changed(Change::displayWindow);
}

void Document::centerCrosshair() {
    if (m_volume)
        setCrosshair(middleSample(m_volume->lattice()));
}

void Document::setCut(const Cut &cut) {
    if (cut == m_view.cut)
        return;
    m_view.cut = cut;
    emit changed(Change::cut);
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
    emit changed(Change::measurements);
    if (m_selectedMeasurement >= int(m_measured.size()))
        selectMeasurement(-1);
}

void Document::selectMeasurement(int index) {
    if (index == m_selectedMeasurement)
        return;
    m_selectedMeasurement = index;
    emit changed(Change::selection);
}

std::optional<scene::Exposure> Document::exposure() const {
    return m_view.exposure && m_view.exposure->of == picture::ToneSubject(m_view.scene)
               ? std::optional(m_view.exposure->exposure)
               : std::nullopt;
}

void Document::setExposure(const scene::Exposure &exposure) {
    const MeasuredExposure measured{exposure, picture::ToneSubject(m_view.scene)};
    if (measured == m_view.exposure)
        return;
    m_view.exposure = measured;
    emit changed(Change::exposure);
}

void Document::setCrosshair(volume::PatientPoint point) {
    if (m_view.crosshair.mm == point.mm)
        return;
    m_view.crosshair = point;
    emit changed(Change::crosshair);
}

} // namespace pellucid::ui
