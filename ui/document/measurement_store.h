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

/// Keeps the measurements of each study in a file of the user's data folder, whose name is the
/// digest of the study's source. Writes the file when they change, and reads it when the study is
/// opened again.
class MeasurementStore : public QObject {
    Q_OBJECT
public:
    explicit MeasurementStore(Document &document, QObject *parent = nullptr);
    ~MeasurementStore() override;

    /// Writes now what waits for the end of a drag.
    void writePending();
    /// Writes a table of the measurements. *Throws* Error{output}, Error{usage} if no study is
    /// open.
    void exportTable(const QString &path) const;

signals:
    void failed(const pellucid::task::Reason &reason, const QString &path);

private:
    std::optional<std::filesystem::path> file() const;
    void load();
    void rememberToWrite();

    Document &m_document;
    bool m_isLoading = false;
    /// A drag changes measurements with every move: they are written when it pauses. An empty text
    /// removes the file.
    struct Pending {
        std::filesystem::path path;
        std::string text;
    };
    std::optional<Pending> m_pending;
    QTimer m_rest;
    /// A file that can neither be read nor moved away is not overwritten.
    std::filesystem::path m_untouched;
};

} // namespace pellucid::ui
