// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/measurement_store.h"

#include <QCryptographicHash>
#include <QFile>

#include "core/files/atomic_file.h"
#include "core/files/user_folders.h"
#include "core/task/error.h"
#include "ui/document.h"

namespace pellucid::ui {

namespace {

namespace fs = std::filesystem;

void write(const fs::path &path, const std::string &text) {
    files::AtomicFile file(path);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
}

} // namespace

MeasurementStore::MeasurementStore(Document &document, QObject *parent)
    : QObject(parent), m_document(document) {
    connect(&document, &Document::volumeChanged, this, &MeasurementStore::load);
    connect(&document, &Document::measurementsChanged, this, &MeasurementStore::save);
}

std::optional<fs::path> MeasurementStore::file() const {
    const auto folder = files::userDataFolder();
    const int source = m_document.currentSource();
    if (!folder || source < 0)
        return std::nullopt;
    // No name of a patient in the name of a file.
    const QByteArray key = m_document.sources()[std::size_t(source)].key.toUtf8();
    return *folder / "measurements" /
           (QCryptographicHash::hash(key, QCryptographicHash::Sha256).toHex().toStdString() +
            ".json");
}

void MeasurementStore::load() {
    if (!m_document.volume() || m_document.isPreview())
        return;
    const auto path = file();
    QFile in(path ? QString::fromStdString(path->string()) : QString());
    if (!path || !in.open(QIODevice::ReadOnly))
        return;
    m_isLoading = true;
    try {
        m_document.setMeasurements(measure::measurementsFromJson(in.readAll().toStdString()));
    } catch (const task::Error &error) {
        // What cannot be read is kept under another name: the next save would write over it.
        std::error_code ignored;
        fs::rename(*path, path->string() + ".unreadable", ignored);
        emit failed(tr("The measurements of this study cannot be read: %1")
                        .arg(QString::fromStdString(error.reason())),
                    QString::fromStdString(path->string() + ".unreadable"));
    }
    m_isLoading = false;
}

void MeasurementStore::save() {
    const auto path = file();
    if (m_isLoading || !path)
        return;
    try {
        std::error_code ignored;
        if (m_document.measured().empty()) {
            fs::remove(*path, ignored);
            return;
        }
        fs::create_directories(path->parent_path(), ignored);
        write(*path, measure::toJson(m_document.measurements()));
    } catch (const task::Error &error) {
        emit failed(
            tr("The measurements cannot be kept: %1").arg(QString::fromStdString(error.reason())),
            QString::fromStdString(path->string()));
    }
}

void MeasurementStore::exportTable(const QString &path) const {
    write(path.toStdString(), measure::toCsv(m_document.measurements(), *m_document.volume()));
}

} // namespace pellucid::ui
