// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QStringList>

#include "ui/study_opener.h"

namespace pellucid::ui {

/// What was open, so that it can be taken up again: where it comes from and how it was looked at.
/// Names of patients are not kept, paths are.
struct Session {
    QStringList files; ///< of the series
    QString phantom;   ///< or its name
    QString key;       ///< a digest of the source's
    Continuity shown;
    /// The program that kept it has ended as programs should.
    bool hasEnded = false;
};

/// The session as it is; none while nothing is open, or where what is open is gone with the
/// program.
std::optional<Session> currentSession(const Document &document);

/// The user's file of it, written a moment after each change and when the program ends: one that is
/// killed loses a second or two. What cannot be written or read is as if there were none: nobody is
/// kept from ending or beginning.
void keepSession(const std::optional<Session> &session);
std::optional<Session> keptSession();

/// Opens it, as it was looked at. Files that are gone are among the problems.
void resume(const Session &session, StudyOpener &opener);

} // namespace pellucid::ui
