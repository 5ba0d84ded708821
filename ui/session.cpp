// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session.h"

#include <filesystem>
#include <set>

#include "core/files/session_folder.h"

namespace pellucid::ui {

std::optional<Session> currentSession(const Document &document) {
    const int open = document.currentSource();
    if (open < 0 || !document.volume() || document.isPreview())
        return std::nullopt;
    const StudySource &source = document.sources()[std::size_t(open)];
    Session session;
    session.files = source.files;
    // What was left out beside them is looked at again, and named again.
    std::set<std::filesystem::path> folders;
    for (const QString &file : source.files)
        folders.insert(std::filesystem::path(file.toStdString()).parent_path());
    for (const dicom::Skipped &problem : document.problems()) {
        const QString path = QString::fromStdString(problem.path.string());
        if (folders.contains(problem.path.parent_path()) && !session.files.contains(path))
            session.files << path;
    }
    session.phantom = source.phantom;
    session.key = source.digest();
    session.shown = {document.scene(), document.displayWindow(), document.crosshair(),
                     document.cut()};
    if (session.files.isEmpty() && session.phantom.isEmpty())
        return std::nullopt;
    if (!session.files.isEmpty() && files::isInSessionFolder(session.files.front().toStdString()))
        return std::nullopt;
    return session;
}

void resume(const Session &session, StudyOpener &opener) {
    opener.resumeWith({session.key, session.shown});
    if (!session.phantom.isEmpty())
        opener.openPhantom(session.phantom);
    else
        opener.openPaths(session.files);
}

} // namespace pellucid::ui
