// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/opening/session.h"

#include <filesystem>
#include <set>

#include "core/decoding/client/reasons.h"
#include "core/files/reasons.h"

namespace pellucid::ui {

namespace fs = std::filesystem;

namespace {

// The problems in the folders of a session's files. Without the files themselves, which are read
// again, and without texts and programs, which are common beside images.
std::vector<dicom::Skipped> leftOutOf(const StudySource &source,
                                      const std::vector<dicom::Skipped> &problems) {
    constexpr std::size_t maxCount = 1000;
    std::set<fs::path> folders, opened;
    for (const QString &file : source.lasting) {
        opened.insert(file.toStdString());
        folders.insert(fs::path(file.toStdString()).parent_path());
    }
    std::vector<dicom::Skipped> left;
    for (const dicom::Skipped &problem : problems)
        if (folders.contains(problem.path.parent_path()) && !opened.contains(problem.path) &&
            !problem.reason.is(task::because::isNotDicom) && left.size() < maxCount)
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
    session.files = source.lasting;
    session.leftOut = leftOutOf(source, document.problems());
    session.phantom = source.phantom;
    session.difference = source.difference;
    session.key = source.digest();
    session.view = document.view();
    session.view.segments = nullptr;
    if (!document.exposure()) // it is of another scene
        session.view.exposure.reset();
    if (document.segments())
        for (const segment::Segmentation &segmentation : document.segments()->segmentations())
            session.segmentations << QString::fromStdString(segmentation.path.string());
    if (session.files.isEmpty() && session.phantom.isEmpty())
        return std::nullopt;
    return session;
}

void resume(const Session &session, StudyOpener &opener) {
    const StudyOpener::Resumption resumption{session.key, session.view, session.leftOut,
                                             session.segmentations, session.difference};
    if (!session.phantom.isEmpty())
        opener.openPhantom(session.phantom, resumption);
    else
        opener.openPaths(session.files, resumption);
}

} // namespace pellucid::ui
