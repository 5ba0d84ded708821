// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/picture/contrast.h"
#include "gpu/frame_passes.h"
#include "gpu/program.h"
#include "gpu/texture.h"

namespace pellucid::gpu {

/// A picture as a texture: the images that it is mixed from, see `CardPicture`.
struct PictureTexture {
    unsigned texture = 0;
    int width = 0, height = 0, layers = 1;
    double pixelMm = 1.0;
    CardPicture::Colors colors{{{1.0F, 1.0F, 1.0F}}};
};

/// A 2D texture of floats that passes draw to: one or two channels, linear filter, clamped to the
/// edge. Belongs to the context that is current when it is created.
class GridTexture {
public:
    GridTexture(int width, int height, int channels);
    int width() const { return m_width; }
    int height() const { return m_height; }
    unsigned id() const { return m_name.name(); }

private:
    TextureName m_name;
    int m_width, m_height;
};

/// picture::ContrastCorrection on the card. Belongs to the context that is current when it is
/// created.
class ContrastPasses {
public:
    /// *Throws* Error{internal} if the shaders do not compile.
    ContrastPasses();

    /// The correction on the finest grid, valid until the next call; the framebuffer and the
    /// viewport stay as they are. *Requires*: the display's contrast is not off.
    const GridTexture &correction(const PictureTexture &picture, const picture::Display &display);
    void release();
    /// Pixels of the picture a side of one of the last correction.
    int factor() const { return m_factor; }

private:
    struct Level {
        GridTexture sums;      ///< weighted values and shares
        GridTexture processed; ///< means and the processed picture
    };
    void fit(const picture::ContrastGrids &grids);

    Program m_finest, m_halve, m_coarsest, m_expand, m_correct;
    VertexArrayName m_vertexArray;
    std::vector<GridTexture> m_finestGrids; ///< brightness and its correction
    std::vector<Level> m_levels;
    int m_factor = 1;
};

} // namespace pellucid::gpu
