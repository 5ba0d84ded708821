// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include <QObject>

namespace pellucid::ui {

class Document;

/// Keeps the measurements of each study in a file of the user's data folder, named by a digest of
/// what identifies the volume: written when they change, read when the study opens again.
class MeasurementStore : public QObject {
    Q_OBJECT
public:
    explicit MeasurementStore(Document &document, QObject *parent = nullptr);

    /// Writes a table of the measurements. *Throws* Error{output}.
    void exportTable(const QString &path) const;

signals:
    void failed(const QString &reason, const QString &path);

private:
    std::optional<std::filesystem::path> file() const;
    void load();
    void save();

    Document &m_document;
    bool m_isLoading = false;
};

} // namespace pellucid::ui
