// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session.h"

#include <algorithm>

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSaveFile>

#include "core/files/session_folder.h"
#include "core/files/user_folders.h"
#include "core/phantom/phantom.h"
#include "core/task/error.h"

namespace pellucid::ui {

namespace {

constexpr const char *schema = "pellucid-session/1";

std::optional<QString> sessionFile() {
    const auto folder = files::userDataFolder();
    if (!folder)
        return std::nullopt;
    return QString::fromStdString((*folder / "session.json").string());
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
    if (in.size() != 3) // an earlier program kept none
        return {};
    std::array<mpr::Axes, 3> axes;
    for (std::size_t n = 0; n < 3; ++n) {
        const QJsonObject a = in[qsizetype(n)].toObject();
        axes[n] = {vectorFrom(a["right"]), vectorFrom(a["up"])};
    }
    return mpr::PlaneAxes(axes);
}

QJsonObject toJson(const Session &s) {
    const mpr::ResliceOptions &cut = s.shown.cut.options;
    return {
        {"schema", schema},
        {"ended", s.hasEnded},
        {"files", QJsonArray::fromStringList(s.files)},
        {"phantom", s.phantom},
        {"key", s.key},
        {"scene", QJsonDocument::fromJson(QByteArray::fromStdString(render::toJson(s.shown.scene)))
                      .object()},
        {"window", QJsonObject{{"center", s.shown.displayWindow.center},
                               {"width", s.shown.displayWindow.width},
                               {"name", QString::fromStdString(s.shown.displayWindow.name)}}},
        {"crosshair", toJson(s.shown.crosshair.mm)},
        {"planes", toJson(s.shown.cut.axes)},
        {"slab", QJsonObject{{"mm", cut.slab.thicknessMm}, {"mode", int(cut.slab.mode)}}},
        {"nearest", cut.interpolation == mpr::Interpolation::nearest}};
}

Session fromJson(const QJsonObject &in) {
    Session s;
    for (const QJsonValue &file : in["files"].toArray())
        s.files << file.toString();
    s.phantom = in["phantom"].toString();
    s.key = in["key"].toString();
    s.hasEnded = in["ended"].toBool(true); // an earlier program wrote at its end only
    if (!s.phantom.isEmpty())              // of a newer program it may be unknown
        phantom::kindFromName(s.phantom.toStdString());
    s.shown.scene = render::sceneFromJson(
        QJsonDocument(in["scene"].toObject()).toJson(QJsonDocument::Compact).toStdString());
    const QJsonObject window = in["window"].toObject();
    s.shown.displayWindow = {window["center"].toDouble(),
                             std::max(1e-6, window["width"].toDouble(1.0)),
                             window["name"].toString().toStdString()};
    s.shown.crosshair = {vectorFrom(in["crosshair"])};
    s.shown.cut.axes = planesFrom(in["planes"].toArray());
    const QJsonObject slab = in["slab"].toObject();
    s.shown.cut.options.slab = {std::clamp(slab["mm"].toDouble(), 0.0, 500.0),
                                mpr::SlabMode(std::clamp(slab["mode"].toInt(), 0, 2))};
    if (in["nearest"].toBool())
        s.shown.cut.options.interpolation = mpr::Interpolation::nearest;
    return s;
}

} // namespace

std::optional<Session> currentSession(const Document &document) {
    const int open = document.currentSource();
    if (open < 0 || !document.volume() || document.isPreview())
        return std::nullopt;
    const StudySource &source = document.sources()[std::size_t(open)];
    Session session;
    session.files = source.files;
    session.phantom = source.phantom;
    session.key = source.digest();
    session.shown = {document.scene(), document.displayWindow(), document.crosshair(),
                     document.cut()};
    if (session.files.isEmpty() && session.phantom.isEmpty())
        return std::nullopt;
    if (!session.files.isEmpty() && files::isInSessionFolder(session.files.front().toStdString()))
        return std::nullopt;
    return session;
}

void keepSession(const std::optional<Session> &session) {
    const auto path = sessionFile();
    if (!path)
        return;
    if (!session) {
        QFile::remove(*path);
        return;
    }
    QSaveFile file(*path);
    if (file.open(QIODevice::WriteOnly)) {
        file.write(QJsonDocument(toJson(*session)).toJson(QJsonDocument::Compact));
        file.commit();
    }
}

std::optional<Session> keptSession() {
    const auto path = sessionFile();
    if (!path)
        return std::nullopt;
    QFile file(*path);
    if (!file.open(QIODevice::ReadOnly))
        return std::nullopt;
    const QJsonObject in = QJsonDocument::fromJson(file.readAll()).object();
    if (in["schema"].toString() != schema)
        return std::nullopt;
    try {
        return fromJson(in);
    } catch (const task::Error &) {
        return std::nullopt;
    }
}

void resume(const Session &session, StudyOpener &opener) {
    opener.resumeWith({session.key, session.shown});
    if (!session.phantom.isEmpty())
        opener.openPhantom(session.phantom);
    else
        opener.openPaths(session.files);
}

} // namespace pellucid::ui
