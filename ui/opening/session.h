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

/// What was open, so that it can be taken up again: where it comes from and how it was looked at.
/// Names of patients are not kept, paths are.
struct Session {
    QStringList files; ///< of the series, or the archives that they are in
    /// What else of the same folders could not be used: it is said again, and not looked at again.
    std::vector<dicom::Skipped> leftOut;
    QString phantom; ///< or its name
    QString key;     ///< a digest of the source's
    Continuity shown;
    /// The program that kept it has ended as programs should.
    bool hasEnded = false;
};

/// As it is kept. Reading *throws* Error{unusable} if the text is no session.
std::string toJson(const Session &session);
Session sessionFromJson(const std::string &text);

/// The session as it is; none while nothing is open.
std::optional<Session> currentSession(const Document &document);

/// The user's file of it, written a moment after each change and when the program ends: one that is
/// killed loses a second or two. What cannot be written or read is as if there were none: nobody is
/// kept from ending or beginning. Programs that run at the same time have files of their own; one
/// that begins goes on with the one that was killed last, else with the one that ended last.
class SessionFile {
public:
    SessionFile();
    /// Waits until what was given last is written.
    ~SessionFile();

    /// Written aside, because it waits for the disk.
    void keep(const Session &session);
    void forget();
    /// Those of programs that have ended, too.
    void forgetAll();
    std::optional<Session> kept() const;
    /// Why what was kept cannot be taken up, where something was.
    std::optional<task::Error> fault() const;

private:
    void choose();
    void write(const std::stop_token &stop);
    /// A moment when nothing is being written; what was not begun may be dropped then.
    std::unique_lock<std::mutex> rest() const;

    std::optional<std::filesystem::path> m_path; ///< none: there is no place for it
    std::optional<files::FileLock> m_lock;
    mutable std::mutex m_mutex;
    mutable std::condition_variable_any m_changed;
    std::optional<Session> m_next;
    bool m_isWriting = false;
    std::jthread m_thread; ///< last: it uses the others
};

/// Opens it, as it was looked at. Files that are gone are among the problems.
void resume(const Session &session, StudyOpener &opener);

} // namespace pellucid::ui
