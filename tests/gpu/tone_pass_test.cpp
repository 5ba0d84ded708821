// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include <epoxy/gl.h>

#include "core/task/error.h"
#include "gpu/capabilities.h"
#include "gpu/surfaceless_context.h"
#include "gpu/tone_pass.h"

namespace pellucid {

namespace {

class TonePass : public testing::Test {
protected:
    void SetUp() override { context.makeCurrent(); }
    void TearDown() override { context.doneCurrent(); }
    gpu::SurfacelessContext context;
};

std::vector<std::uint8_t> drawn(const render::ProjectionImage &image, const render::Tone &tone) {
    unsigned framebuffer = 0, target = 0;
    glGenFramebuffers(1, &framebuffer);
    glGenTextures(1, &target);
    glBindTexture(GL_TEXTURE_2D, target);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target, 0);
    glViewport(0, 0, image.width, image.height);
    gpu::TonePass pass;
    pass.upload(image);
    pass.draw(render::toneRange(image, tone), tone.inverted);
    std::vector<std::uint8_t> rows(std::size_t(image.width) * image.height * 4);
    glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
    EXPECT_EQ(glGetError(), unsigned(GL_NO_ERROR));
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &target);
    // OpenGL counts rows from the bottom.
    std::vector<std::uint8_t> flipped;
    for (int r = image.height - 1; r >= 0; --r)
        flipped.insert(flipped.end(), rows.begin() + std::ptrdiff_t(r) * image.width * 4,
                       rows.begin() + std::ptrdiff_t(r + 1) * image.width * 4);
    return flipped;
}

TEST_F(TonePass, DrawsWhatComposeComputes) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-20.0F, 120.0F);
    render::ProjectionImage image{37, 23, 1.0, std::vector<float>(37 * 23)};
    for (float &p : image.samples)
        p = uniform(random);
    render::ProjectionImage colored{37, 23, 1.0, std::vector<float>(37 * 23 * 3), 3};
    for (float &p : colored.samples)
        p = uniform(random);
    for (const auto &[shown, tone] : {std::pair(image, render::Tone{}),
                                      {image, render::Tone{10.0, 70.0, true}},
                                      {colored, render::Tone{}},
                                      {colored, render::Tone{10.0, 70.0, true}}}) {
        const auto expected = render::compose(shown, tone), found = drawn(shown, tone);
        int largest = 0;
        for (std::size_t n = 0; n < expected.size(); ++n)
            largest = std::max(largest, std::abs(int(expected[n]) - int(found[n])));
        EXPECT_LE(largest, 1); // rounding to eight bits
    }
}

TEST_F(TonePass, KnowsItsContext) {
    const auto capabilities = gpu::currentCapabilities();
    EXPECT_TRUE(capabilities.canShowImages());
    EXPECT_FALSE(capabilities.renderer.empty());
}

TEST_F(TonePass, ABrokenShaderIsNamed) {
    try {
        gpu::Program("lib/tone.glsl", "tone.frag"); // a library has no main
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_NE(std::string(error.what()).find("lib/tone.glsl"), std::string::npos)
            << error.what();
    }
    EXPECT_THROW(gpu::Program("absent.vert", "tone.frag"), task::Error);
}

TEST(Shaders, IncludesAreReplacedAndNumbered) {
    const auto shader = gpu::assembledShader("tone.frag");
    ASSERT_EQ(shader.files.size(), 2U);
    EXPECT_EQ(shader.files[1], "lib/tone.glsl");
    EXPECT_EQ(shader.text.find("#include"), std::string::npos);
    EXPECT_EQ(shader.text.rfind("#version 330 core", 0), 0U);
    EXPECT_NE(shader.text.find("#line 1 1"), std::string::npos);
}

} // namespace
} // namespace pellucid
