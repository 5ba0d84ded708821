// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QObject>
#include <QTimer>

#include "core/render/spectrum_slice.h"
#include "ui/engine/shown_engine.h"
#include "ui/jobs/job_runner.h"

namespace pellucid::ui {

class Document;

/// Samples the slice of the spectrum that the projection is made from, over the band of the picture
/// or of the volume's shortest step, whichever is smaller. It works in the background, and only
/// while it is active. While the view turns, it samples the latest view a few times a second.
class SpectrumSampler : public QObject {
    Q_OBJECT
public:
    explicit SpectrumSampler(Document &document, QObject *parent = nullptr);

    void setEngine(const ShownEngine &shown);
    /// Activates it while its result is visible. At first it is inactive.
    void setActive(bool isActive);
    /// Whether the last slice is not that of the present view, or another one is underway.
    bool isBehind() const { return m_isStale || m_jobs.isRunning(); }

    /// Frequencies along one side of the slice.
    static constexpr int side = 256;

signals:
    void sampled(const pellucid::render::SpectrumSlice &slice);
    /// There is no slice. `reason`: why, unless no study is open.
    void cleared(const std::optional<pellucid::task::Reason> &reason);

private:
    void follow();
    void sampleNext();
    scene::Camera camera() const;

    Document &m_document;
    std::optional<render::EngineParts> m_parts;
    JobRunner m_jobs; // its own: no other job stops it, and it shows no progress
    QTimer m_pause;
    bool m_isActive = false, m_isStale = false;
};

} // namespace pellucid::ui
