// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <QSize>
#include <QString>

#include "core/files/session_folder.h"
#include "core/task/progress.h"

class QImage;
class QProcess;

namespace pellucid::ui {

/// Writes a video (H.264 in MP4) with the program ffmpeg. The file appears only when complete.
/// After a kill, the next export to the folder removes the unfinished file. Use it on one thread,
/// which may be any.
class VideoWriter {
public:
    /// Whether ffmpeg is installed.
    static bool isAvailable();

    /// *Throws* Error{output} if ffmpeg does not start.
    VideoWriter(const QString &path, const QSize &size, int framesPerSecond);
    ~VideoWriter();

    /// Adds a frame. *Shape*: `size` of the constructor. *Throws* Error{output} with the message of
    /// ffmpeg, Cancelled.
    void add(const QImage &frame, const task::Progress &progress);
    /// Waits for ffmpeg and puts the file in its place. *Throws* as `add`.
    void finish(const task::Progress &progress);

private:
    [[noreturn]] void fail();

    QString m_path, m_unfinished;
    files::SessionFolder m_folder;
    std::unique_ptr<QProcess> m_encoder;
};

} // namespace pellucid::ui
