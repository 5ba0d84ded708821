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

/// Writes a video (H.264 in MP4) with the program ffmpeg, where there is one. The file appears only
/// when complete; what a kill leaves the next export there removes. Used on one thread, any.
class VideoWriter {
public:
    static bool isAvailable();

    /// *Throws* Error{output} if ffmpeg does not start.
    VideoWriter(const QString &path, const QSize &size, int framesPerSecond);
    ~VideoWriter();

    /// *Shape*: of the size. *Throws* Error{output} with what ffmpeg says, Cancelled.
    void add(const QImage &frame, const task::Progress &progress);
    /// *Throws* as add.
    void finish(const task::Progress &progress);

private:
    [[noreturn]] void fail();

    QString m_path, m_unfinished;
    files::SessionFolder m_folder;
    std::unique_ptr<QProcess> m_encoder;
};

} // namespace pellucid::ui
