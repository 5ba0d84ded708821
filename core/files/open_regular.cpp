// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/open_regular.h"

#include <system_error>
#include <utility>

#include "core/files/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::files {

bool RegularFile::isUnchanged() const {
    try {
        return platform::factsOf(handle) == facts;
    } catch (const std::system_error &) {
        return false;
    }
}

RegularFile openRegular(const std::filesystem::path &path) {
    try {
        platform::Handle file = platform::openForReading(path);
        const platform::FileFacts facts = platform::factsOf(file);
        if (facts.isRegular)
            return {std::move(file), facts};
    } catch (const std::system_error &error) {
        const bool isMissing = error.code() == std::errc::no_such_file_or_directory;
        throw task::Error(
            task::ErrorCode::unusable,
            isMissing ? task::because::doesNotExist : task::systemReason(error.code()), path);
    }
    throw task::Error(task::ErrorCode::unusable, task::because::isNotARegularFile, path);
}

} // namespace pellucid::files
