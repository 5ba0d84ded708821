// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <random>
#include <span>
#include <stdexcept>

#include <epoxy/gl.h>

#include "core/picture/compose.h"
#include "core/prepare/prepared_engine.h"
#include "core/task/error.h"
#include "gpu/capabilities.h"
#include "gpu/gpu_engine.h"
#include "gpu/surfaceless_context.h"
#include "gpu/tone_pass.h"
#include "tests/gpu/card.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

class TonePass : public testing::Test {
protected:
    void SetUp() override { context.makeCurrent(); }
    void TearDown() override { context.doneCurrent(); }
    gpu::SurfacelessContext context;
};

// Runs `draw` on a framebuffer of a size and returns its pixels, rows from the top.
std::vector<std::uint8_t> drawnBy(int width, int height, const std::function<void()> &draw) {
    unsigned framebuffer = 0, target = 0;
    glGenFramebuffers(1, &framebuffer);
    glGenTextures(1, &target);
    glBindTexture(GL_TEXTURE_2D, target);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target, 0);
    glViewport(0, 0, width, height);
    draw();
    std::vector<std::uint8_t> rows(std::size_t(width) * std::size_t(height) * 4);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
    EXPECT_EQ(glGetError(), unsigned(GL_NO_ERROR));
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &target);
    // OpenGL counts rows from the bottom.
    std::vector<std::uint8_t> flipped;
    for (int r = height - 1; r >= 0; --r)
        flipped.insert(flipped.end(), rows.begin() + std::ptrdiff_t(r) * width * 4,
                       rows.begin() + std::ptrdiff_t(r + 1) * width * 4);
    return flipped;
}

std::vector<std::uint8_t> drawn(const picture::ProjectionImage &image,
                                const picture::Display &display) {
    return drawnBy(image.width, image.height, [&] {
        gpu::TonePass pass;
        pass.upload(image);
        pass.draw(display);
    });
}

int largestDifference(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
    int largest = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        largest = std::max(largest, std::abs(int(a[n]) - int(b[n])));
    return largest;
}

TEST_F(TonePass, DrawsWhatComposeComputes) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-20.0F, 120.0F);
    picture::ProjectionImage image{37, 23, 1.0, picture::Samples(37 * 23)};
    for (float &p : image.samples)
        p = uniform(random);
    picture::ProjectionImage colored{37, 23, 1.0, picture::Samples(37 * 23 * 3), 3};
    for (float &p : colored.samples)
        p = uniform(random);
    const picture::Contrast contrast{0.6, 0.8, 90.0, 40.0, 2.0}, latitude{0.0, 1.0, 90.0, 40.0};
    for (const picture::Display &display : {picture::Display{{0.0, 100.0}, false, 0.7},
                                            {{10.0, 70.0}, true, 1.3, {}, 4.0, 6.0},
                                            {{-60.0, 70.0}},
                                            {{-60.0, 90.0}, false, 1.2, contrast, 3.0, 5.0},
                                            {{0.0, 90.0}, true, 1.0, latitude, 0.0, 5.0}})
        for (const auto *shown : {&image, &colored}) {
            const auto expected = picture::compose(*shown, display);
            const auto found = drawn(*shown, display);
            EXPECT_LE(largestDifference(expected, found), 1); // rounding to eight bits
        }
}

// Pictures of every shape, with pixels so small that the processing averages 1, 2 or 4 of them, so
// large that it has no levels, and with a body beside air.
TEST_F(TonePass, DrawsTheContrastThatComposeComputes) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> noise(0.0F, 30.0F);
    for (const auto &[width, height] : {std::pair(64, 48), {201, 77}, {31, 130}, {5, 9}, {1, 1}})
        for (const double pixelMm : {0.1, 0.3, 1.0, 7.0, 100.0}) {
            picture::ProjectionImage image{width, height, pixelMm};
            for (int r = 0; r < height; ++r)
                for (int c = 0; c < width; ++c)
                    image.samples.push_back(
                        c < width / 4 ? 0.0F : 50.0F + 0.3F * float(r) + noise(random));
            const picture::Display display{{20.0, 140.0}, false, 1.2, {0.7, 0.5, 120.0, 70.0, 2.0},
                                           2.0,           6.0};
            EXPECT_LE(largestDifference(picture::compose(image, display), drawn(image, display)), 1)
                << width << " x " << height << ", " << pixelMm << " mm";
        }
}

class CardTone : public test::CardTest {};

// One layer, one in a color, two in two colors, and three.
TEST_F(CardTone, DrawsPicturesOfTheCard) {
    const auto lattice = volume::Lattice::centred({20, 21, 22}, {1, 1, 1});
    const classify::ShownFields grey{{test::noiseField(lattice)}, {}};
    const classify::ShownFields colored{{test::noiseField(lattice)}, {{{1.0, 0.4, 0.1}}}};
    const classify::ShownFields mixed{{test::noiseField(lattice, 1), test::noiseField(lattice, 2)},
                                      {{{1.0, 0.4, 0.1}, {0.2, 0.3, 0.9}}}};
    const classify::ShownFields three{
        {test::noiseField(lattice, 1), test::noiseField(lattice, 2), test::noiseField(lattice, 3)},
        classify::primaries};
    for (const auto &fields : {grey, colored, mixed, three}) {
        const scene::Scene scene{.camera = scene::defaultCamera(lattice)};
        const auto prepared = prepare::prepareEngine({scene, fields});
        const auto engine = gpu::copyToCard(card, *prepared.engine);
        const auto picture = engine->renderOnCard(scene.camera, scene.image);
        EXPECT_EQ(picture->layers(), int(fields.channels.size()));
        const auto image = picture->download();
        const picture::Display display{{2.0, 15.0}, false, 1.1, {0.5, 0.5, 12.0, 6.0, 2.0},
                                       0.0,         1.0};
        std::vector<std::uint8_t> found;
        card->device().run([&] {
            found = drawnBy(image.width, image.height, [&] {
                gpu::TonePass pass;
                pass.draw(*picture, display);
            });
        });
        EXPECT_LE(largestDifference(picture::compose(image, display), found), 1);
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
    EXPECT_THROW(gpu::Program("absent.vert", "tone.frag"), std::logic_error);
}

TEST(Shaders, IncludesAreReplacedAndNumbered) {
    const auto shader = gpu::assembledShader("tone.frag");
    ASSERT_EQ(shader.files.size(), 3U);
    EXPECT_EQ(shader.files[2], "lib/tone.glsl");
    EXPECT_EQ(shader.text.find("#include"), std::string::npos);
    EXPECT_EQ(shader.text.rfind("#version 330 core", 0), 0U);
    EXPECT_NE(shader.text.find("#line 1 1"), std::string::npos);
}

} // namespace
} // namespace pellucid
