// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>

namespace pellucid::platform {

/// The system's number of an open file or socket; -1: none.
#ifdef _WIN32
using Native = std::intptr_t;
#else
using Native = int;
#endif

/// Systems differ in how they close and share these.
enum class Opened { file, socket, memory };

/// A file, a folder, a socket or shared memory that the system has opened. It is closed with its
/// owner.
class Handle {
public:
    Handle() = default;
    explicit Handle(Native native, Opened what = Opened::file) : m_native(native), m_what(what) {}
    ~Handle();
    Handle(Handle &&other) noexcept
        : m_native(std::exchange(other.m_native, -1)), m_what(other.m_what) {}
    Handle &operator=(Handle &&other) noexcept {
        std::swap(m_native, other.m_native);
        std::swap(m_what, other.m_what);
        return *this;
    }
    Native get() const { return m_native; }
    Opened what() const { return m_what; }
    explicit operator bool() const { return m_native != -1; }
    /// For whoever closes it otherwise.
    Native release() { return std::exchange(m_native, -1); }

private:
    Native m_native = -1;
    Opened m_what = Opened::file;
};

/// A handle that remains its owner's; or none.
class HandleView {
public:
    HandleView() = default;
    HandleView(const Handle &handle) : m_native(handle.get()), m_what(handle.what()) {}
    explicit HandleView(Native native, Opened what = Opened::file)
        : m_native(native), m_what(what) {}
    Native get() const { return m_native; }
    Opened what() const { return m_what; }
    explicit operator bool() const { return m_native != -1; }

private:
    Native m_native = -1;
    Opened m_what = Opened::file;
};

} // namespace pellucid::platform
