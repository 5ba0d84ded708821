// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/export/video_writer.h"

#include <filesystem>

#include <QImage>
#include <QProcess>
#include <QStandardPaths>

#include "core/files/atomic_file.h"
#include "core/task/error.h"

namespace pellucid::ui {

namespace {

constexpr int waitMs = 100;
// Bytes that may wait to be encoded.
constexpr qint64 maxPending = qint64(64) << 20;

} // namespace

bool VideoWriter::isAvailable() {
    return !QStandardPaths::findExecutable("ffmpeg").isEmpty();
}

VideoWriter::VideoWriter(const QString &path, const QSize &size, int framesPerSecond)
    : m_path(path), m_folder(files::SessionFolder::beside(path.toStdString())),
      m_encoder(std::make_unique<QProcess>()) {
    m_unfinished = QString::fromStdString((m_folder.path() / "video.mp4").string());
    m_encoder->start("ffmpeg",
                     {"-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24",
                      "-s", QString("%1x%2").arg(size.width()).arg(size.height()), "-r",
                      QString::number(framesPerSecond), "-i", "-",
                      // The codec needs even sizes, players need this pixel format.
                      "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "16",
                      "-pix_fmt", "yuv420p", "-metadata", "comment=Not for diagnostic use",
                      "-movflags", "+faststart", m_unfinished});
    if (!m_encoder->waitForStarted())
        throw task::Error(task::ErrorCode::output, task::because::ffmpegDoesNotStart,
                          path.toStdString());
}

VideoWriter::~VideoWriter() {
    if (m_encoder->state() != QProcess::NotRunning) {
        m_encoder->kill();
        m_encoder->waitForFinished();
    }
}

void VideoWriter::fail() {
    m_encoder->waitForFinished(waitMs);
    const QString message = QString::fromUtf8(m_encoder->readAllStandardError()).simplified();
    throw task::Error(task::ErrorCode::output,
                      message.isEmpty() ? task::Reason(task::because::ffmpegEndedEarly)
                                        : task::because::ffmpegReports(message.toStdString()),
                      m_path.toStdString());
}

void VideoWriter::add(const QImage &frame, const task::Progress &progress) {
    const QImage rgb = frame.convertToFormat(QImage::Format_RGB888);
    for (int row = 0; row < rgb.height(); ++row) // a line may end with padding
        m_encoder->write(reinterpret_cast<const char *>(rgb.constScanLine(row)),
                         qint64(rgb.width()) * 3);
    while (m_encoder->bytesToWrite() > maxPending) {
        progress.check();
        if (m_encoder->state() == QProcess::NotRunning)
            fail();
        m_encoder->waitForBytesWritten(waitMs);
    }
    if (m_encoder->state() == QProcess::NotRunning)
        fail();
}

void VideoWriter::finish(const task::Progress &progress) {
    while (m_encoder->bytesToWrite() > 0) {
        progress.check();
        if (m_encoder->state() == QProcess::NotRunning)
            fail();
        m_encoder->waitForBytesWritten(waitMs);
    }
    m_encoder->closeWriteChannel();
    while (!m_encoder->waitForFinished(waitMs) && m_encoder->state() != QProcess::NotRunning)
        progress.check();
    if (m_encoder->exitStatus() != QProcess::NormalExit || m_encoder->exitCode() != 0)
        fail();
    files::rename(m_unfinished.toStdString(), m_path.toStdString());
}

} // namespace pellucid::ui
