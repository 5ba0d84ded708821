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

/// The open study, so that it can be resumed: where it comes from and how it was looked at. It
/// contains paths, but no names of patients.
struct Session {
    QStringList files; ///< of the series, or the archives that contain them
    /// Other files of the same folders that could not be used. They are listed again, and not read.
    std::vector<dicom::Skipped> leftOut;
    QString phantom; ///< its name, in place of files
    QString key;     ///< the digest of the source
    Continuity shown;
    /// The program that kept the session has ended normally.
    bool hasEnded = false;
};

/// The session as JSON. Reading *throws* Error{unusable} if the text is no session.
std::string toJson(const Session &session);
Session sessionFromJson(const std::string &text);

/// The session of the open study; none if no study is open.
std::optional<Session> currentSession(const Document &document);

/// The user's session file. It is written a moment after each change and when the program ends: a
/// killed program loses a second or two. A file that cannot be written or read counts as absent, so
/// that the program can always start and end. Programs that run at the same time have files of
/// their own. A new program continues the session of the one that was killed last, else of the one
/// that ended last.
class SessionFile {
public:
    SessionFile();
    /// Waits until the last session is written.
    ~SessionFile();

    /// Returns at once; a thread of its own writes the session.
    void keep(const Session &session);
    void forget();
    /// Forgets the sessions of programs that have ended, too.
    void forgetAll();
    std::optional<Session> kept() const;
    /// Why the kept session cannot be read; none if it can, or if there is none.
    std::optional<task::Error> fault() const;

private:
    void choose();
    void write(const std::stop_token &stop);
    /// Waits until nothing is being written, and holds off the next write.
    std::unique_lock<std::mutex> rest() const;

    std::optional<std::filesystem::path> m_path; ///< none: there is no folder for it
    std::optional<files::FileLock> m_lock;
    mutable std::mutex m_mutex;
    mutable std::condition_variable_any m_changed;
    std::optional<Session> m_next;
    bool m_isWriting = false;
    std::jthread m_thread; ///< last: it uses the others
};

/// Opens the study of a session and looks at it as before. Missing files are listed as problems.
void resume(const Session &session, StudyOpener &opener);

} // namespace pellucid::ui
