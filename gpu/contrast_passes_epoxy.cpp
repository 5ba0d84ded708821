// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/contrast_passes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <epoxy/gl.h>

namespace pellucid::gpu {

namespace {

// Draws to textures, and restores the framebuffer and viewport that it found.
class Drawing {
public:
    Drawing() {
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &m_former);
        glGetIntegerv(GL_VIEWPORT, m_viewport.data());
        glGenFramebuffers(1, &m_framebuffer);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffer);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
        glDisable(GL_SCISSOR_TEST);
    }
    ~Drawing() {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, unsigned(m_former));
        glDeleteFramebuffers(1, &m_framebuffer);
        glViewport(m_viewport[0], m_viewport[1], m_viewport[2], m_viewport[3]);
        glActiveTexture(GL_TEXTURE0);
        glUseProgram(0);
    }
    Drawing(const Drawing &) = delete;
    Drawing &operator=(const Drawing &) = delete;

    // Every pixel of the texture, by the program in use.
    void cover(const GridTexture &target) const {
        glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                               target.id(), 0);
        glViewport(0, 0, target.width(), target.height());
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

private:
    unsigned m_framebuffer = 0;
    int m_former = 0;
    std::array<int, 4> m_viewport{};
};

void use(const Program &program) {
    glUseProgram(program.id());
}

void read(const Program &program, const char *sampler, int unit, const GridTexture &texture) {
    glActiveTexture(GL_TEXTURE0 + unsigned(unit));
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glUniform1i(program.uniform(sampler), unit);
}

void setCurve(const Program &program, const picture::Contrast &contrast, double sizeMm) {
    const picture::BandCurve curve = picture::bandCurve(contrast, sizeMm);
    glUniform3f(program.uniform("curve"), float(1.0 / (contrast.bright * picture::BandCurve::knee)),
                float(curve.amplification), float(curve.bend));
}

void setCompression(const Program &program, const picture::Contrast &contrast) {
    glUniform2f(program.uniform("compression"), float(contrast.middle),
                float(picture::largestScaleFactor(contrast)));
}

} // namespace

GridTexture::GridTexture(int width, int height, int channels)
    : m_name(makeTexture()), m_width(width), m_height(height) {
    glBindTexture(GL_TEXTURE_2D, m_name.name());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, channels == 1 ? GL_R32F : GL_RG32F, width, height, 0,
                 channels == 1 ? GL_RED : GL_RG, GL_FLOAT, nullptr);
}

ContrastPasses::ContrastPasses()
    : m_finest("tone.vert", "contrast_finest.frag"), m_halve("tone.vert", "contrast_halve.frag"),
      m_coarsest("tone.vert", "contrast_coarsest.frag"),
      m_expand("tone.vert", "contrast_expand.frag"),
      m_correct("tone.vert", "contrast_correction.frag"), m_vertexArray(makeVertexArray()) {}

void ContrastPasses::fit(const picture::ContrastGrids &grids) {
    m_factor = grids.factor;
    const auto &finest = grids.grids.front();
    if (m_finestGrids.empty() || m_finestGrids.front().width() != finest.width ||
        m_finestGrids.front().height() != finest.height) {
        m_finestGrids.clear();
        m_levels.clear();
        m_finestGrids.emplace_back(finest.width, finest.height, 1);
        m_finestGrids.emplace_back(finest.width, finest.height, 1);
    }
    // The sizes of the grids follow from the finest; their number also from the pixel size.
    const std::size_t count = grids.grids.size() - 1;
    if (m_levels.size() > count)
        m_levels.erase(m_levels.begin() + std::ptrdiff_t(count), m_levels.end());
    for (std::size_t n = m_levels.size(); n < count; ++n) {
        const auto &grid = grids.grids[n + 1];
        m_levels.push_back({{grid.width, grid.height, 2}, {grid.width, grid.height, 2}});
    }
}

void ContrastPasses::release() {
    m_finestGrids.clear();
    m_levels.clear();
}

const GridTexture &ContrastPasses::correction(const PictureTexture &picture,
                                              const picture::Display &display) {
    const picture::Contrast &contrast = display.contrast;
    const picture::ContrastGrids grids(picture.width, picture.height, picture.pixelMm, contrast);
    fit(grids);
    const picture::AirRamp air = picture::airRampOf(display);
    glBindVertexArray(m_vertexArray.name());
    {
        const Drawing drawing;
        const GridTexture &brightness = m_finestGrids.front();
        use(m_finest);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D_ARRAY, picture.texture);
        glUniform1i(m_finest.uniform("projection"), 0);
        glUniform1i(m_finest.uniform("layers"), picture.layers);
        glUniform3fv(m_finest.uniform("colors"), int(picture.colors.size()),
                     picture.colors.front().data());
        glUniform1i(m_finest.uniform("factor"), grids.factor);
        drawing.cover(brightness);

        use(m_halve);
        glUniform2f(m_halve.uniform("air"), air.level, air.scale);
        for (std::size_t n = 0; n < m_levels.size(); ++n) {
            glUniform1i(m_halve.uniform("isFinest"), n == 0 ? 1 : 0);
            read(m_halve, "finer", 0, n == 0 ? brightness : m_levels[n - 1].sums);
            drawing.cover(m_levels[n].sums);
        }
        if (!m_levels.empty()) {
            use(m_coarsest);
            glUniform1f(m_coarsest.uniform("middleWeight"), float(picture::middleWeight));
            setCompression(m_coarsest, contrast);
            read(m_coarsest, "level", 0, m_levels.back().sums);
            drawing.cover(m_levels.back().processed);
            use(m_expand);
            for (std::size_t n = m_levels.size() - 1; n-- > 0;) {
                setCurve(m_expand, contrast, grids.grids[n + 1].pixelMm);
                read(m_expand, "level", 0, m_levels[n].sums);
                read(m_expand, "coarser", 1, m_levels[n + 1].processed);
                drawing.cover(m_levels[n].processed);
            }
        }

        use(m_correct);
        read(m_correct, "finest", 0, brightness);
        if (!m_levels.empty())
            read(m_correct, "coarser", 1, m_levels.front().processed);
        glUniform1i(m_correct.uniform("hasCoarser"), m_levels.empty() ? 0 : 1);
        glUniform2f(m_correct.uniform("air"), air.level, air.scale);
        setCurve(m_correct, contrast, grids.grids.front().pixelMm);
        setCompression(m_correct, contrast);
        drawing.cover(m_finestGrids.back());
    }
    glBindVertexArray(0);
    return m_finestGrids.back();
}

} // namespace pellucid::gpu
