// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

namespace pellucid::gpu {

/// A context that a Device may take into its thread.
class Context {
public:
    virtual ~Context() = default;
    /// Makes it current on the calling thread. *Throws* Error{noSuchDevice}.
    virtual void makeCurrent() = 0;
    virtual void doneCurrent() = 0;
    /// Whether what is on the card is gone: the driver was reset or updated, the card was taken
    /// away. *Shape*: called while current, the first time while it is whole: a lost context no
    /// longer says what it can tell.
    virtual bool isLost();

private:
    std::optional<bool> m_tellsResets;
};

} // namespace pellucid::gpu
