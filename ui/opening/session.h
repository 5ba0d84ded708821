// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <QStringList>

#include "core/files/file_lock.h"
#include "core/task/error.h"
#include "ui/opening/study_opener.h"

namespace pellucid::ui {

/// The open study, so that it can be reopened: where it comes from and how it was displayed. A
/// session holds paths, but no names of patients.
struct Session {
    QStringList files; ///< files of the series, or the archives that contain them
    /// Other files of the same folders that could not be used. Reopening reports them without
    /// reading them again.
    std::vector<dicom::Skipped> leftOut;
    QStringList segmentations;              ///< files of the segments that are loaded
    std::optional<DifferenceOf> difference; ///< of what the open volume is a difference
    QString phantom;                        ///< name of the phantom, if the study is one
    QString key;                            ///< digest of the source
    StudyView view;                         ///< without segments, which are in files
    /// The program that wrote the session ended normally.
    bool hasEnded = false;
};

/// The text of a session file. Reading *throws* Error{unusable} if the text is no session.
std::string toJson(const Session &session);
Session sessionFromJson(const std::string &text);

/// The session of the open study; none if no study is open.
std::optional<Session> currentSession(const Document &document);

/// The user's session file. The program writes it a moment after each change and when it ends: a
/// program that is killed loses a second or two. A file that cannot be written or read counts as
/// missing, so that it keeps no program from starting or ending. Each running program has its own
/// file. A program that starts takes the file of the program that was killed last, otherwise of the
/// one that ended last.
class SessionFile {
public:
    /// *Throws* std::system_error if no thread is available.
    SessionFile();
    /// Waits until the last session is written.
    ~SessionFile();

    /// Writes a session on a thread of its own, because the disk may be slow.
    void keep(const Session &session);
    /// Deletes the file of this program, and drops a session that has not been written yet.
    void forget();
    /// Also deletes the files of programs that have ended.
    void forgetAll();
    /// The session that was kept last, by this program or by the one whose file it took; none if
    /// there is none or it cannot be read.
    std::optional<Session> kept() const;
    /// Why the session cannot be read; none if it can, or if there is none.
    std::optional<task::Error> fault() const;

private:
    void chooseFile();
    void write(const std::stop_token &stop);
    /// Waits for the write that is under way. No other begins while the lock is held.
    std::unique_lock<std::mutex> lockWhileIdle() const;

    std::optional<std::filesystem::path> m_path; ///< none: the user has no data folder
    std::optional<files::FileLock> m_lock;
    mutable std::mutex m_mutex;
    mutable std::condition_variable_any m_changed;
    std::optional<Session> m_next;
    bool m_isWriting = false;
    // Not a QThreadPool: if the system has no thread left, it drops the session without an error
    // and its destructor waits forever.
    std::jthread m_thread; ///< last: it uses the other members
};

/// Reopens a session as it was displayed. Files that no longer exist are listed as problems.
void resume(const Session &session, StudyOpener &opener);

} // namespace pellucid::ui
