// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

namespace pellucid::gpu {

/// An OpenGL context that a Device may use on its own thread.
class Context {
public:
    virtual ~Context() = default;
    /// Makes the context current on the calling thread. *Throws* Error{noSuchDevice}.
    virtual void makeCurrent() = 0;
    virtual void doneCurrent() = 0;
    /// Whether the context and everything on the card is lost, because the driver was reset or
    /// updated or the card was removed. *Requires*: the context is current, and not lost at the
    /// first call: a lost context no longer reports whether it detects resets.
    virtual bool isLost();

private:
    std::optional<bool> m_detectsResets;
};

} // namespace pellucid::gpu
