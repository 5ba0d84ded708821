// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <QObject>
#include <QTimer>

#include "core/task/reason.h"

namespace pellucid::ui {

class Document;

/// Keeps the measurements of each study in a file of the user's data folder, named by a digest of
/// what identifies the volume: written when they change, read when the study opens again.
class MeasurementStore : public QObject {
    Q_OBJECT
public:
    explicit MeasurementStore(Document &document, QObject *parent = nullptr);
    ~MeasurementStore() override;

    /// What waits for the hand to rest is written now.
    void writePending();
    /// Writes a table of the measurements. *Throws* Error{output}.
    void exportTable(const QString &path) const;

signals:
    void failed(const pellucid::task::Reason &reason, const QString &path);

private:
    std::optional<std::filesystem::path> file() const;
    void load();
    void rememberToWrite();

    Document &m_document;
    bool m_isLoading = false;
    /// What is to be written when the hand rests: a drag changes it with every move. No text: the
    /// file goes.
    struct Pending {
        std::filesystem::path path;
        std::string text;
    };
    std::optional<Pending> m_pending;
    QTimer m_rest;
    /// A file that is there and cannot be read or moved away is not written over.
    std::filesystem::path m_untouched;
};

} // namespace pellucid::ui
