// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::test {

/// An OpenGL 3.3 core context without a window, current as long as the object.
class SurfacelessContext {
public:
    SurfacelessContext();
    ~SurfacelessContext();
    SurfacelessContext(const SurfacelessContext &) = delete;
    SurfacelessContext &operator=(const SurfacelessContext &) = delete;

    bool isValid() const { return m_context != nullptr; }
    const std::string &reason() const { return m_reason; }

private:
    void *m_display = nullptr;
    void *m_context = nullptr;
    std::string m_reason;
};

} // namespace pellucid::test
