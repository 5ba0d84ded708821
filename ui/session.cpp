// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session.h"

#include <filesystem>
#include <set>

namespace pellucid::ui {

namespace fs = std::filesystem;

namespace {

// What could not be used of the folders that the files of a session are in, or of its archive.
// Texts and programs lie beside images, and are nobody's loss.
std::vector<dicom::Skipped> leftOutOf(const StudySource &source,
                                      const std::vector<dicom::Skipped> &problems) {
    constexpr std::size_t most = 1000;
    const std::string archive = source.archive.toStdString() + "/";
    std::set<fs::path> folders;
    for (const QString &file : source.files)
        folders.insert(fs::path(file.toStdString()).parent_path());
    std::vector<dicom::Skipped> left;
    for (const dicom::Skipped &problem : problems) {
        const bool isOfIt = source.archive.isEmpty() ? folders.contains(problem.path.parent_path())
                                                     : problem.path.native().starts_with(archive);
        if (isOfIt && problem.reason != "is not a DICOM file" && left.size() < most)
            left.push_back(problem);
    }
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
    session.leftOut = leftOutOf(source, document.problems());
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
