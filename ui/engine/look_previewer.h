// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QImage>
#include <QObject>

#include "core/presets/preset_library.h"
#include "core/volume/statistics.h"
#include "ui/jobs/job_runner.h"

namespace pellucid::ui {

class Document;

/// Computes the histogram of the open volume and small pictures of it with presets, in the
/// background.
class LookPreviewer : public QObject {
    Q_OBJECT
public:
    explicit LookPreviewer(Document &document, QObject *parent = nullptr);

    /// Makes the histogram, then the pictures one after the other.
    void preview(const std::vector<presets::Preset> &presets);

    static constexpr int pictureWidth = 60, pictureHeight = 52;

signals:
    void histogramReady(const pellucid::volume::Histogram &histogram);
    void pictureReady(const QString &preset, const QImage &picture);

private:
    Document &m_document;
    JobRunner m_jobs; // its own: no other job stops it, and it shows no progress
};

} // namespace pellucid::ui
