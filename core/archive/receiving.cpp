// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/receiving.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "core/archive/reasons.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace because = task::because;
namespace fs = std::filesystem;
namespace status = network::status;

namespace {

// Disk space left to other programs, to the user's work and to this program's own reports. 1 GB
// holds a large image (32 MB) for each connection; on small disks, the 5 % that file systems
// reserve, too.
constexpr std::uintmax_t largestReserve = 1'000'000'000;
constexpr std::uintmax_t reservedShare = 20; // 1/20

void requireSpace(const fs::path &folder) {
    std::error_code unknown;
    const fs::space_info disk = fs::space(folder, unknown);
    const std::uintmax_t reserve = std::min(largestReserve, disk.capacity / reservedShare);
    if (!unknown && disk.available < reserve)
        throw task::Error(task::ErrorCode::output,
                          because::diskIsAlmostFull((reserve + 999'999) / 1'000'000));
}

} // namespace

class Receiving::Connection : public network::Receiver {
public:
    explicit Connection(Receiving &all) : m_all(all) {}

    std::variant<platform::HandleView, std::uint16_t>
    open(const network::Arrival &arrival) override {
        try {
            requireSpace(m_all.m_folder.folder());
            m_file = m_all.m_folder.open(arrival);
            return m_file->view();
        } catch (const task::Error &error) {
            refuse(arrival, error.reason());
            return status::outOfResources;
        }
    }
    std::uint16_t keep(const network::Arrival &arrival, std::uint64_t bytes) override {
        const std::unique_ptr<files::AtomicFile> file = std::move(m_file);
        try {
            const StoredObject object = m_all.m_folder.keep(*file, arrival, bytes);
            const std::lock_guard lock(m_all.m_mutex);
            if (m_all.m_log != nullptr)
                m_all.m_log->addArrival(object, arrival.callingAe);
            if (m_all.m_observer.stored)
                m_all.m_observer.stored(object);
            return 0;
        } catch (const task::Error &error) {
            refuse(arrival, error.reason());
            return error.code() == task::ErrorCode::unusable ? status::cannotUnderstand
                                                             : status::outOfResources;
        }
    }

private:
    void refuse(const network::Arrival &arrival, const task::Reason &reason) {
        const std::lock_guard lock(m_all.m_mutex);
        if (m_all.m_observer.refused)
            m_all.m_observer.refused({arrival.sopInstanceUid, reason});
    }

    Receiving &m_all;
    std::unique_ptr<files::AtomicFile> m_file;
};

Receiving::Receiving(const ObjectFolder &folder, TransferLog *log, ReceivingObserver observer)
    : m_folder(folder), m_log(log), m_observer(std::move(observer)) {}

Receiving::~Receiving() = default;

std::unique_ptr<network::Receiver> Receiving::receiver() {
    return std::make_unique<Connection>(*this);
}

} // namespace pellucid::archive
