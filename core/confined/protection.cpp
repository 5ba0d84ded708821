// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/confined/protection.h"

#include <mutex>
#include <set>
#include <utility>

#include "core/platform/confinement.h"
#include "core/system/log.h"

namespace pellucid::confined {

namespace {

using namespace platform;

struct Noted {
    std::mutex mutex;
    std::set<std::string> helpers;
    std::function<void()> handler;
};

Noted &noted() {
    static Noted all;
    return all;
}

} // namespace

void whenUnprotected(std::function<void()> handler) {
    const std::lock_guard lock(noted().mutex);
    noted().handler = std::move(handler);
}

void noteProtection(const std::string &helpers, int bits) {
    const std::lock_guard lock(noted().mutex);
    if (noted().helpers.insert(helpers).second) {
        const auto has = [bits](int bit, const char *yes, const char *no) {
            return (bits & bit) != 0 ? yes : no;
        };
        system::log(helpers + ": resource limits " + has(limitsHold, "in force", "NOT in force") +
                    ", rights " + has(callsAreFiltered, "given up", "NOT given up") + ", files " +
                    has(filesAreFiltered, "closed", "not closed") + ", network " +
                    has(networkIsEmpty, "empty", "not empty"));
    }
    if ((bits & callsAreFiltered) == 0 && noted().handler)
        noted().handler();
}

} // namespace pellucid::confined
