// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/opening/session.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include "core/files/atomic_file.h"
#include "core/files/read_text.h"
#include "core/files/user_folders.h"
#include "core/phantom/phantom.h"
#include "core/system/log.h"
#include "core/task/error.h"
#include "ui/language/kept_reasons.h"
#include "ui/opening/reasons.h"

namespace pellucid::ui {

namespace {

QJsonArray curveOf(const volume::ValueWindow &window) {
    QJsonArray curve;
    if (window.curve)
        for (const float grey : *window.curve)
            curve.append(double(grey));
    return curve;
}

void setFunction(const QJsonObject &in, volume::ValueWindow &window) {
    using volume::WindowFunction;
    for (const WindowFunction known :
         {WindowFunction::linear, WindowFunction::sigmoid, WindowFunction::table})
        if (in["function"].toInt() == int(known))
            window.function = known;
    if (window.function != WindowFunction::table)
        return;
    constexpr qsizetype longest = 65536;
    const QJsonArray greys = in["curve"].toArray();
    std::vector<float> curve;
    for (qsizetype n = 0; n < std::min(longest, greys.size()); ++n)
        curve.push_back(std::clamp(float(greys[n].toDouble()), 0.0F, 1.0F));
    if (curve.size() < 2)
        window.function = WindowFunction::linearExact;
    else
        window.curve = std::make_shared<const std::vector<float>>(std::move(curve));
}

constexpr const char *schema = "pellucid-session/2";

constexpr int maxPrograms = 100;

std::filesystem::path fileOf(const std::filesystem::path &folder, int program,
                             const char *extension) {
    return folder /
           ("session" + (program == 0 ? "" : "-" + std::to_string(program + 1)) + extension);
}

// How many programs have, or had, a file.
int countPrograms(const std::filesystem::path &folder) {
    std::error_code unknown;
    int n = 0;
    while (n < maxPrograms && (std::filesystem::exists(fileOf(folder, n, ".json"), unknown) ||
                               std::filesystem::exists(fileOf(folder, n, ".lock"), unknown)))
        ++n;
    return n;
}

// None if there is no file.
std::optional<Session> readSession(const std::filesystem::path &path) {
    std::error_code unknown;
    if (!std::filesystem::exists(path, unknown))
        return std::nullopt;
    try {
        return sessionFromJson(files::readText(path, files::maxSceneBytes));
    } catch (const task::Error &error) {
        throw task::Error(error.code(), error.reason(), path);
    }
}

QJsonArray toJson(const glm::dvec3 &v) {
    return {v.x, v.y, v.z};
}

glm::dvec3 vectorFrom(const QJsonValue &value) {
    const QJsonArray in = value.toArray();
    return {in[0].toDouble(), in[1].toDouble(), in[2].toDouble()};
}

QJsonArray toJson(const mpr::PlaneAxes &axes) {
    QJsonArray out;
    for (const auto o : mpr::allOrientations)
        out << QJsonObject{{"right", toJson(axes.of(o).right)}, {"up", toJson(axes.of(o).up)}};
    return out;
}

mpr::PlaneAxes planesFrom(const QJsonArray &in) {
    if (in.size() != 3)
        return {};
    std::array<mpr::Axes, 3> axes;
    for (std::size_t n = 0; n < 3; ++n) {
        const QJsonObject a = in[qsizetype(n)].toObject();
        axes[n] = {vectorFrom(a["right"]), vectorFrom(a["up"])};
    }
    return mpr::PlaneAxes(axes);
}

QJsonObject objectOf(const Session &s) {
    const StudyView &view = s.view;
    const mpr::ResliceOptions &cut = view.cut.options;
    QJsonArray leftOut;
    for (const dicom::Skipped &skipped : s.leftOut)
        leftOut << QJsonObject{{"path", QString::fromStdString(skipped.path.string())},
                               {"reason", toLine(skipped.reason)}};
    scene::Scene scene = view.scene;
    scene.tone.exposure.reset();
    if (view.exposure)
        scene.tone.exposure = view.exposure->exposure;
    QJsonObject difference;
    if (s.difference)
        difference = {{"minuend", s.difference->minuend},
                      {"subtrahend", s.difference->subtrahend},
                      {"aligned", s.difference->isAligned}};
    return {{"schema", schema},
            {"difference", difference},
            {"ended", s.hasEnded},
            {"files", QJsonArray::fromStringList(s.files)},
            {"left_out", leftOut},
            {"segmentations", QJsonArray::fromStringList(s.segmentations)},
            {"phantom", s.phantom},
            {"key", s.key},
            {"scene",
             QJsonDocument::fromJson(QByteArray::fromStdString(scene::toJson(scene))).object()},
            {"window", QJsonObject{{"center", view.displayWindow.center},
                                   {"width", view.displayWindow.width},
                                   {"name", QString::fromStdString(view.displayWindow.name)},
                                   {"inverted", view.displayWindow.isInverted},
                                   {"function", int(view.displayWindow.function)},
                                   {"curve", curveOf(view.displayWindow)}}},
            {"pose", QJsonObject{{"zoom", view.pose.zoom}, {"fitted", view.pose.isFitted}}},
            {"crosshair", toJson(view.crosshair.mm)},
            {"planes", toJson(view.cut.axes)},
            {"slab", QJsonObject{{"mm", cut.slab.thicknessMm}, {"mode", int(cut.slab.mode)}}},
            {"nearest", cut.interpolation == mpr::Interpolation::nearest}};
}

Session fromJson(const QJsonObject &in) {
    if (in["schema"].toString() != schema)
        throw task::Error(task::ErrorCode::unusable, task::because::isNoSession);
    Session s;
    for (const QJsonValue file : in["files"].toArray())
        s.files << file.toString();
    for (const QJsonValue skipped : in["left_out"].toArray())
        s.leftOut.push_back({skipped["path"].toString().toStdString(),
                             reasonFromLine(skipped["reason"].toString())});
    for (const QJsonValue file : in["segmentations"].toArray())
        s.segmentations << file.toString();
    if (const QJsonObject of = in["difference"].toObject(); !of.isEmpty())
        s.difference = {of["minuend"].toString(), of["subtrahend"].toString(),
                        of["aligned"].toBool()};
    s.phantom = in["phantom"].toString();
    s.key = in["key"].toString();
    s.hasEnded = in["ended"].toBool();
    if (!s.phantom.isEmpty()) // throws for a phantom of a newer version
        phantom::kindFromName(s.phantom.toStdString());
    s.view.scene = scene::sceneFromJson(
        QJsonDocument(in["scene"].toObject()).toJson(QJsonDocument::Compact).toStdString());
    const QJsonObject window = in["window"].toObject();
    s.view.displayWindow = {window["center"].toDouble(),
                            std::max(1e-6, window["width"].toDouble(1.0)),
                            window["name"].toString().toStdString(), window["inverted"].toBool()};
    setFunction(window, s.view.displayWindow);
    if (const auto exposure = std::exchange(s.view.scene.tone.exposure, std::nullopt))
        s.view.exposure = {*exposure, picture::ToneSubject(s.view.scene)};
    const QJsonObject pose = in["pose"].toObject();
    s.view.pose = {s.view.scene.camera.orientation, s.view.scene.camera.panMm,
                   std::clamp(pose["zoom"].toDouble(1.0), minZoom, maxZoom),
                   pose["fitted"].toBool()};
    s.view.crosshair = {vectorFrom(in["crosshair"])};
    s.view.cut.axes = planesFrom(in["planes"].toArray());
    const QJsonObject slab = in["slab"].toObject();
    s.view.cut.options.slab = {std::clamp(slab["mm"].toDouble(), 0.0, 500.0),
                               mpr::SlabMode(std::clamp(slab["mode"].toInt(), 0, 2))};
    if (in["nearest"].toBool())
        s.view.cut.options.interpolation = mpr::Interpolation::nearest;
    return s;
}

} // namespace

std::string toJson(const Session &session) {
    return QJsonDocument(objectOf(session)).toJson(QJsonDocument::Compact).toStdString();
}

Session sessionFromJson(const std::string &text) {
    return fromJson(QJsonDocument::fromJson(QByteArray::fromStdString(text)).object());
}

SessionFile::SessionFile() {
    chooseFile();
    m_thread = std::jthread([this](const std::stop_token &stop) { write(stop); });
}

void SessionFile::chooseFile() {
    const auto folder = files::userDataFolder();
    if (!folder)
        return;
    const int all = countPrograms(*folder);
    // A killed program's session goes before one that ended, and that before an unused file name.
    std::tuple<int, std::filesystem::file_time_type> best;
    std::vector<std::filesystem::path> ended;
    for (int n = 0; n <= all; ++n) {
        if (n == all && m_lock)
            break;
        files::FileLock lock(fileOf(*folder, n, ".lock"), files::FileLock::Mode::attempt);
        if (!lock.isHeld())
            continue;
        const auto path = fileOf(*folder, n, ".json");
        int urgency = 0;
        try {
            if (const auto session = readSession(path)) {
                urgency = session->hasEnded ? 1 : 2;
                if (session->hasEnded)
                    ended.push_back(path);
            }
        } catch (const task::Error &) {
            urgency = 1; // fault() reports that it cannot be read
        }
        std::error_code none;
        const std::tuple rank{urgency, std::filesystem::last_write_time(path, none)};
        if (!m_lock || (urgency > 0 && rank > best)) {
            best = rank;
            m_path = path;
            m_lock = std::move(lock);
        }
    }
    // Only the last session that ended is of use.
    for (const auto &path : ended)
        if (std::error_code ignored; path != m_path)
            std::filesystem::remove(path, ignored);
}

SessionFile::~SessionFile() {
    m_thread.request_stop();
    m_thread.join();
}

void SessionFile::write(const std::stop_token &stop) {
    std::unique_lock lock(m_mutex);
    while (m_changed.wait(lock, stop, [this] { return m_next.has_value(); })) {
        const Session session = *std::exchange(m_next, std::nullopt);
        m_isWriting = true;
        lock.unlock();
        try {
            if (m_path) {
                files::AtomicFile file(*m_path);
                file.write(toJson(session));
                file.commit();
            }
        } catch (const std::exception &error) {
            // Without the path, which may name the patient.
            const auto *const known = dynamic_cast<const task::Error *>(&error);
            system::log("the session is not saved: " +
                        (known ? known->reason().english() : error.what()));
        }
        lock.lock();
        m_isWriting = false;
        m_changed.notify_all();
    }
}

std::unique_lock<std::mutex> SessionFile::lockWhileIdle() const {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, [this] { return !m_isWriting; });
    return lock;
}

void SessionFile::keep(const Session &session) {
    const std::lock_guard lock(m_mutex);
    m_next = session; // replaces one that has not been written yet
    m_changed.notify_all();
}

void SessionFile::forget() {
    const auto lock = lockWhileIdle();
    m_next.reset();
    std::error_code ignored;
    if (m_path)
        std::filesystem::remove(*m_path, ignored);
}

void SessionFile::forgetAll() {
    forget();
    const auto folder = files::userDataFolder();
    for (int n = 0, all = folder ? countPrograms(*folder) : 0; n < all; ++n) {
        const files::FileLock lock(fileOf(*folder, n, ".lock"), files::FileLock::Mode::attempt);
        std::error_code ignored;
        if (lock.isHeld())
            std::filesystem::remove(fileOf(*folder, n, ".json"), ignored);
    }
}

std::optional<Session> SessionFile::kept() const {
    const auto lock = lockWhileIdle();
    if (m_next)
        return m_next;
    if (!m_path)
        return std::nullopt;
    try {
        return readSession(*m_path);
    } catch (const task::Error &) {
        return std::nullopt;
    }
}

std::optional<task::Error> SessionFile::fault() const {
    const auto lock = lockWhileIdle();
    try {
        if (m_path)
            readSession(*m_path);
    } catch (const task::Error &error) {
        return error;
    }
    return std::nullopt;
}

} // namespace pellucid::ui
