// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <QObject>
#include <QStringList>

#include "core/render/prepared_engine.h"

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
    /// Prepares the projection that the document's scene asks for, unless it is there or on its
    /// way, even if that was cancelled or failed before.
    void prepareAgain();

signals:
    /// The paths held something.
    void pathsOpened(const QStringList &paths);
    /// An engine for the document's volume is ready; a finer one may follow.
    void engineReady(const pellucid::render::PreparedEngine &engine, bool coarse);
    /// The open volume cannot be projected.
    void notProjectable(const QString &reason);

private:
    /// What of a scene an engine is made for; the rest changes from frame to frame.
    struct Prepared {
        explicit Prepared(const render::Scene &scene)
            : window(scene.fieldWindow), look(scene.look), tolerance(scene.tolerance),
              interpolation(scene.interpolation) {}
        std::optional<classify::FieldWindow> window;
        classify::Look look;
        double tolerance;
        render::Interpolation interpolation;
        bool operator==(const Prepared &) const = default;
    };
    /// The same, but what was given up stays so.
    void followScene();
    void startPreparing();
    void prepare(const class Job &job, const volume::Volume &volume, const Prepared &wanted,
                 double from, bool coarseFirst);

    Document &m_document;
    JobRunner &m_jobs;
    /// What the last engine was made for, what the next one is being made for, and what was
    /// cancelled or failed.
    std::optional<Prepared> m_prepared, m_underway, m_givenUp;
    bool m_scanning = false;
};

} // namespace pellucid::ui
