// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

namespace pellucid::platform {

/// A file, a folder or a socket that the system has opened. It is closed with its owner.
class Handle {
public:
    Handle() = default;
    explicit Handle(int native) : m_native(native) {}
    ~Handle();
    Handle(Handle &&other) noexcept : m_native(std::exchange(other.m_native, -1)) {}
    Handle &operator=(Handle &&other) noexcept {
        std::swap(m_native, other.m_native);
        return *this;
    }
    int get() const { return m_native; }
    explicit operator bool() const { return m_native >= 0; }

private:
    int m_native = -1;
};

} // namespace pellucid::platform
