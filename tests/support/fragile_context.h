// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "gpu/surfaceless_context.h"

namespace pellucid::test {

/// A context whose driver reports a reset on request.
class FragileContext final : public gpu::Context {
public:
    explicit FragileContext(std::shared_ptr<std::atomic<bool>> lost) : m_lost(std::move(lost)) {}
    void makeCurrent() override { m_context.makeCurrent(); }
    void doneCurrent() override { m_context.doneCurrent(); }
    bool isLost() override { return *m_lost || m_context.isLost(); }

private:
    gpu::SurfacelessContext m_context;
    std::shared_ptr<std::atomic<bool>> m_lost;
};

} // namespace pellucid::test
