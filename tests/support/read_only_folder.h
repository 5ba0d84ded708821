// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <linux/capability.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace pellucid::test {

/// Makes a folder read-only for this thread as long as the object exists, even for root.
class ReadOnlyFolder {
public:
    explicit ReadOnlyFolder(std::filesystem::path folder) : m_folder(std::move(folder)) {
        namespace fs = std::filesystem;
        fs::permissions(m_folder, fs::perms::owner_write, fs::perm_options::remove);
        ::syscall(SYS_capget, &m_header, m_before);
        __user_cap_data_struct fewer[2] = {m_before[0], m_before[1]};
        fewer[0].effective &= ~(1U << CAP_DAC_OVERRIDE);
        ::syscall(SYS_capset, &m_header, fewer);
    }
    ~ReadOnlyFolder() {
        namespace fs = std::filesystem;
        ::syscall(SYS_capset, &m_header, m_before);
        std::error_code ignored;
        fs::permissions(m_folder, fs::perms::owner_write, fs::perm_options::add, ignored);
    }
    ReadOnlyFolder(const ReadOnlyFolder &) = delete;
    ReadOnlyFolder &operator=(const ReadOnlyFolder &) = delete;

private:
    std::filesystem::path m_folder;
    __user_cap_header_struct m_header{_LINUX_CAPABILITY_VERSION_3, 0};
    __user_cap_data_struct m_before[2]{};
};

} // namespace pellucid::test
