// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <QObject>
#include <QStringList>

#include "core/render/cpu_engine.h"

namespace pellucid::ui {

class Document;
class JobRunner;

/// The way from a path to a turning picture, as jobs: scan, choose, load with previews, prepare a
/// coarse projection, then the fine one.
class StudyOpener : public QObject {
    Q_OBJECT
public:
    StudyOpener(Document &document, JobRunner &jobs, QObject *parent = nullptr);

    void openPaths(const QStringList &paths);
    void openPhantom(const QString &kind);
    void openSource(int index);

signals:
    /// The paths held something.
    void pathsOpened(const QStringList &paths);
    /// An engine for the document's volume is ready; a finer one may follow.
    void engineReady(std::shared_ptr<pellucid::render::ProjectionEngine> engine,
                     double predictedError, bool coarse);
    /// The open volume cannot be projected.
    void notProjectable(const QString &reason);

private:
    void followFieldWindow();
    void prepare(const class Job &job, const volume::Volume &volume, const render::Scene &scene,
                 double from);

    Document &m_document;
    JobRunner &m_jobs;
    /// The field's window that the last engine was, or is being, made for.
    std::optional<classify::FieldWindow> m_preparedWindow;
};

} // namespace pellucid::ui
