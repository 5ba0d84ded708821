// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "gpu/frame_passes.h"
#include "gpu/surfaceless_context.h"

namespace pellucid::test {

/// Tests on a device that is made once for all of them: compiling shaders takes long. A software
/// renderer will do, and is there wherever the tests run.
class CardTest : public testing::Test {
public:
    static void SetUpTestSuite() {
        card = std::make_shared<gpu::FramePasses>(
            std::make_shared<gpu::Device>(std::make_unique<gpu::SurfacelessContext>()));
    }
    static void TearDownTestSuite() { card.reset(); }

protected:
    static inline std::shared_ptr<gpu::FramePasses> card;
};

} // namespace pellucid::test
