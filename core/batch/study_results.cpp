// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/batch/study_results.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "core/batch/reasons.h"
#include "core/files/atomic_file.h"
#include "core/platform/folders.h"
#include "core/task/error.h"

namespace pellucid::batch {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;

[[noreturn]] void fail(const std::error_code &error, const fs::path &path) {
    throw task::Error(task::ErrorCode::output, task::systemReason(error), path);
}

// File managers and network file systems leave such files in folders.
bool isOfTheSystem(const std::string &name) {
    return name == ".DS_Store" || name == ".directory" || name == "Thumbs.db" ||
           name == "desktop.ini" || name.starts_with("._") || name.starts_with(".nfs");
}

} // namespace

void requireReplaceable(const fs::path &place) {
    std::error_code unknown;
    const bool isFree = !fs::exists(fs::symlink_status(place, unknown)) ||
                        (fs::is_directory(place, unknown) && fs::is_empty(place, unknown));
    if (isFree)
        return;
    const auto done = doneIn(place);
    if (!done)
        throw task::Error(task::ErrorCode::unusable, because::holdsNoResults, place);
    std::set<std::string> results{doneFile};
    for (const DoneRecord::MadeFile &file : done->files)
        results.insert(file.name);
    for (const fs::directory_entry &entry : fs::directory_iterator(place, unknown))
        if (const std::string name = entry.path().filename().string();
            !results.contains(name) && !isOfTheSystem(name))
            throw task::Error(task::ErrorCode::unusable, because::holdsOtherThanResults(name),
                              place);
}

StudyResults::StudyResults(const fs::path &out, const std::string &key)
    : m_place(out / key), m_aside(files::SessionFolder::in(out)),
      m_folder(m_aside.path() / "results") {
    requireReplaceable(m_place);
    std::error_code failed;
    fs::create_directory(m_folder, failed);
    if (failed)
        fail(failed, m_folder);
}

// In two steps. If the second fails, the former results come back.
void StudyResults::replace(std::error_code &failed) const {
    const fs::path former = m_aside.path() / "former";
    fs::rename(m_place, former, failed);
    if (failed)
        return;
    fs::rename(m_folder, m_place, failed);
    std::error_code ignored;
    if (failed)
        fs::rename(former, m_place, ignored);
}

void StudyResults::publish(DoneRecord record) {
    record.files.clear();
    for (const fs::directory_entry &entry : fs::directory_iterator(m_folder))
        record.files.push_back({entry.path().filename().string(), entry.file_size()});
    std::sort(record.files.begin(), record.files.end(),
              [](const auto &a, const auto &b) { return a.name < b.name; });
    files::AtomicFile done(m_folder / doneFile);
    done.write(toJson(record));
    done.commit();
    std::error_code failed;
    fs::rename(m_folder, m_place, failed); // succeeds if there is none, or an empty one
    if (failed) {
        requireReplaceable(m_place);
        if (platform::exchange(m_folder, m_place))
            failed.clear();
        else
            replace(failed);
    }
    if (failed)
        fail(failed, m_place);
    files::flush(m_place.parent_path());
}

} // namespace pellucid::batch
