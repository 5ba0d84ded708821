// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include "core/scene/reasons.h"
#include "core/system/log.h"
#include "core/task/error.h"
#include "gpu/device.h"
#include "gpu/reasons.h"
#include "gpu/surfaceless_context.h"
#include "tests/support/fragile_context.h"

namespace pellucid {

namespace {

// A context that never comes up.
class NoContext final : public gpu::Context {
public:
    void makeCurrent() override {
        throw task::Error(task::ErrorCode::noSuchDevice, task::because::noEglDevice);
    }
    void doneCurrent() override {}
};

TEST(Device, SaysWhatItIs) {
    const gpu::Device device(std::make_unique<gpu::SurfacelessContext>());
    const gpu::Capabilities &c = device.capabilities();
    EXPECT_TRUE(c.canRender());
    EXPECT_FALSE(c.renderer.empty());
    EXPECT_GE(c.largest3dTexture, 2048);
    EXPECT_GE(c.sharedBytes, 32U << 10);
    EXPECT_GE(c.textureUnits, 16);
}

TEST(Device, RunsOnItsOwnThreadAndPassesOnWhatIsThrown) {
    gpu::Device device(std::make_unique<gpu::SurfacelessContext>());
    std::thread::id first, second;
    device.run([&] { first = std::this_thread::get_id(); });
    device.run([&] { second = std::this_thread::get_id(); });
    EXPECT_EQ(first, second);
    EXPECT_NE(first, std::this_thread::get_id());
    EXPECT_THROW(device.run([] {
        throw task::Error(task::ErrorCode::outOfMemory, task::because::noMemoryForAnImage);
    }),
                 task::Error);
    bool ran = false;
    device.run([&] { ran = true; }); // and goes on
    EXPECT_TRUE(ran);
}

TEST(Device, PostedWorkIsDoneBeforeItsEnd) {
    int done = 0;
    {
        gpu::Device device(std::make_unique<gpu::SurfacelessContext>());
        for (int n = 0; n < 100; ++n)
            device.post([&] { ++done; });
    }
    EXPECT_EQ(done, 100);
}

TEST(Device, DriverMessagesAreLogged) {
    std::vector<std::string> lines;
    system::setLogSink([&](const std::string &line) { lines.push_back(line); });
    {
        gpu::Device device(std::make_unique<gpu::SurfacelessContext>());
        device.run([] { glBindBuffer(GL_ARRAY_BUFFER + 12345, 0); }); // an enumerant that is none
        device.run([] { EXPECT_EQ(glGetError(), unsigned(GL_INVALID_ENUM)); });
    }
    system::setLogSink({});
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0].rfind("OpenGL 4.", 0), 0U) << lines[0];
    EXPECT_NE(lines[1].find("INVALID_ENUM"), std::string::npos) << lines[1];
}

TEST(Device, AContextThatFailsIsNamed) {
    try {
        gpu::Device device(std::make_unique<NoContext>());
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::noSuchDevice);
        EXPECT_TRUE(error.reason().is(task::because::noEglDevice)) << error.what();
    }
}

TEST(Device, ALostCardStaysLost) {
    auto lost = std::make_shared<std::atomic<bool>>(false);
    gpu::Device device(std::make_unique<test::FragileContext>(lost));
    device.run([] {});
    EXPECT_FALSE(device.isLost());
    const auto expectLost = [&] {
        try {
            device.run([] {});
            ADD_FAILURE() << "runs on a lost card";
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::noSuchDevice);
        }
        EXPECT_TRUE(device.isLost());
    };
    *lost = true;
    expectLost();
    *lost = false; // a driver that came back has none of what was on the card
    expectLost();
}

TEST(Device, CompilesAProgramOnce) {
    gpu::Device device(std::make_unique<gpu::SurfacelessContext>());
    device.run([&] {
        const gpu::Program &first = device.program("stage.comp");
        EXPECT_EQ(&first, &device.program("stage.comp"));
        EXPECT_NE(&device.program("rows.comp", {{"ROOM", 256}}),
                  &device.program("rows.comp", {{"ROOM", 512}}));
    });
}

} // namespace
} // namespace pellucid
