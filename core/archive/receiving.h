// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "core/archive/object_folder.h"
#include "core/archive/transfer_log.h"

namespace pellucid::archive {

/// Told of each object that is kept or refused, from several threads, one at a time.
struct ReceivingObserver {
    std::function<void(const StoredObject &)> stored;
    std::function<void(const RefusedObject &)> refused;
};

/// Stores the objects that known senders deliver to a listener. Confirms each object after it is on
/// the disk and in the log of arrivals. Refuses objects while the disk is almost full.
class Receiving {
public:
    /// `log`: may be null, for objects that no library lists. Both live as long as this object.
    Receiving(const ObjectFolder &folder, TransferLog *log, ReceivingObserver observer = {});
    ~Receiving();
    /// For one connection.
    std::unique_ptr<network::Receiver> receiver();

private:
    class Connection;
    const ObjectFolder &m_folder;
    TransferLog *m_log;
    ReceivingObserver m_observer;
    std::mutex m_mutex;
};

} // namespace pellucid::archive
