// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace pellucid::ui {

namespace fs = std::filesystem;

namespace {

// What could not be used of the folders that a session opens, or of its archive. Texts and programs
// lie beside images, and are nobody's loss.
std::vector<dicom::Skipped> leftOutOf(const QStringList &files,
                                      const std::vector<dicom::Skipped> &problems) {
    constexpr std::size_t most = 1000;
    std::set<fs::path> folders;
    for (const QString &file : files)
        folders.insert(fs::path(file.toStdString()).parent_path());
    std::vector<dicom::Skipped> left;
    for (const dicom::Skipped &problem : problems)
        if (problem.reason != "is not a DICOM file" && left.size() < most &&
            std::any_of(folders.begin(), folders.end(), [&](const fs::path &folder) {
                return problem.path.native().starts_with(folder.native());
            }))
            left.push_back(problem);
    return left;
}

} // namespace

std::optional<Session> currentSession(const Document &document) {
    const int open = document.currentSource();
    if (open < 0 || !document.volume() || document.isPreview())
        return std::nullopt;
    const StudySource &source = document.sources()[std::size_t(open)];
    Session session;
    session.files = source.archive.isEmpty() ? source.files : QStringList{source.archive};
    session.leftOut = leftOutOf(session.files, document.problems());
    session.phantom = source.phantom;
    session.key = source.digest();
    session.shown = {document.scene(), document.displayWindow(), document.crosshair(),
                     document.cut()};
    if (session.files.isEmpty() && session.phantom.isEmpty())
        return std::nullopt;
    return session;
}

void resume(const Session &session, StudyOpener &opener, Document &document) {
    document.addProblems(session.leftOut);
    opener.resumeWith({session.key, session.shown});
    if (!session.phantom.isEmpty())
        opener.openPhantom(session.phantom);
    else
        opener.openPaths(session.files);
}

} // namespace pellucid::ui
