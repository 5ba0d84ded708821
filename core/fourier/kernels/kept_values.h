// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <mutex>
#include <utility>

namespace pellucid::fourier {

/// Values that take milliseconds to make, and of which there are few: each is kept. Thread-safe.
template <class Key, class Value> class KeptValues {
public:
    /// `make()` makes the value of a key that is new; several threads may do so at once. The
    /// reference stays valid as long as this object.
    template <class Make> const Value &of(const Key &key, const Make &make) {
        {
            const std::lock_guard lock(m_mutex);
            if (const auto known = m_values.find(key); known != m_values.end())
                return known->second;
        }
        Value made = make();
        const std::lock_guard lock(m_mutex);
        return m_values.try_emplace(key, std::move(made)).first->second;
    }

private:
    std::mutex m_mutex;
    std::map<Key, Value> m_values;
};

} // namespace pellucid::fourier
