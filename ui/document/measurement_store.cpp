// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/measurement_store.h"

#include <utility>

#include <QScopedValueRollback>

#include "core/files/atomic_file.h"
#include "core/files/read_text.h"
#include "core/files/user_folders.h"
#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/document/reasons.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;

constexpr int restMs = 400;
constexpr std::size_t maxFileBytes = 64 << 20; // far more than anybody draws

void write(const fs::path &path, const std::string &text) {
    files::AtomicFile file(path);
    file.write(text);
    file.commit();
}

} // namespace

MeasurementStore::MeasurementStore(Document &document, QObject *parent)
    : QObject(parent), m_document(document) {
    document.whenever(Change::volume | Change::measurements, this, [this](Changes changes) {
        if (changes & Change::volume)
            load();
        else
            rememberToWrite();
    });
    m_rest.setSingleShot(true);
    m_rest.setInterval(restMs);
    connect(&m_rest, &QTimer::timeout, this, &MeasurementStore::writePending);
}

MeasurementStore::~MeasurementStore() {
    writePending();
}

std::optional<fs::path> MeasurementStore::file() const {
    const auto folder = files::userDataFolder();
    const int source = m_document.currentSource();
    if (!folder || source < 0)
        return std::nullopt;
    const QString digest = m_document.sources()[std::size_t(source)].digest();
    return *folder / "measurements" / (digest.toStdString() + ".json");
}

void MeasurementStore::load() {
    writePending(); // of the former study
    if (!m_document.volume() || m_document.isPreview())
        return;
    const auto path = file();
    std::error_code ignored;
    if (!path || !fs::exists(*path, ignored))
        return;
    const QScopedValueRollback loading(m_isLoading, true);
    try {
        m_document.setMeasurements(
            measure::measurementsFromJson(files::readText(*path, maxFileBytes)));
    } catch (const task::Error &error) {
        // An unreadable file is kept under another name: the next save would overwrite it.
        std::string kept = path->string() + ".unreadable";
        std::error_code notMoved;
        fs::rename(*path, kept, notMoved);
        if (notMoved) {
            m_untouched = *path;
            kept = path->string();
        }
        emit failed(because::measurementsCannotBeRead(error.reason()),
                    QString::fromStdString(kept));
    }
}

void MeasurementStore::rememberToWrite() {
    const auto path = file();
    if (m_isLoading || !m_document.volume())
        return;
    if (!path) {
        emit failed(because::noFolderForMeasurements, {});
        return;
    }
    m_pending =
        Pending{*path, m_document.measured().empty() ? std::string()
                                                     : measure::toJson(m_document.measurements())};
    m_rest.start();
}

void MeasurementStore::writePending() {
    m_rest.stop();
    if (!m_pending)
        return;
    const Pending pending = *std::exchange(m_pending, std::nullopt);
    try {
        if (pending.path == m_untouched)
            throw task::Error(task::ErrorCode::output, because::formerMeasurementsUnreadable);
        std::error_code problem;
        if (pending.text.empty())
            fs::remove(pending.path, problem);
        else
            fs::create_directories(pending.path.parent_path(), problem);
        if (problem)
            throw task::Error(task::ErrorCode::output, task::systemReason(problem));
        if (!pending.text.empty())
            write(pending.path, pending.text);
    } catch (const task::Error &error) {
        emit failed(because::measurementsCannotBeKept(error.reason()),
                    QString::fromStdString(pending.path.string()));
    }
}

void MeasurementStore::exportTable(const QString &path) const {
    if (!m_document.volume())
        throw task::Error(task::ErrorCode::usage, because::noStudyIsOpen);
    write(path.toStdString(), measure::toCsv(m_document.measurements(), *m_document.volume()));
}

} // namespace pellucid::ui
