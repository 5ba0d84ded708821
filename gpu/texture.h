// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/storage.h"
#include "core/picture/projection_image.h"
#include "gpu/handle.h"

namespace pellucid::gpu {

/// The pixels of a projection: layers of one float per pixel (R32F), which the passes write, or one
/// layer of one or three floats (RGB32F) uploaded from memory. Linear filter, clamped to the edge.
/// Belongs to the context that is current when it is created, and to contexts that share with it.
class PixelTexture {
public:
    PixelTexture();

    /// *Shape*: height x width x channels, rows from the top. One channel is read as all three.
    void upload(int width, int height, int channels, const float *samples);
    /// Allocates layers for passes to write. *Throws* Error{outOfMemory}.
    void reserve(int width, int height, int layers);
    /// *Shape*: layers x height x width.
    picture::Samples download() const;
    /// Sets all pixels to zero.
    void clear();
    int width() const { return m_width; }
    int height() const { return m_height; }
    int layers() const { return m_layers; }
    unsigned id() const { return m_name.name(); }

private:
    void allocate(int width, int height, int layers, int channels, const float *samples);

    TextureName m_name;
    int m_width = 0, m_height = 0, m_layers = 0, m_channels = 0;
};

/// A 3D texture of complex numbers, RG16F or RG32F, with a linear filter. Belongs to the context
/// that is current when it is created; move-only.
class ComplexTexture {
public:
    /// *Throws* Error{outOfMemory}.
    ComplexTexture(const std::array<int, 3> &size, fourier::Storage storage);

    /// *Shape*: planes x rows x columns, contiguous.
    void upload(int firstPlane, int planes, const void *cells);
    unsigned id() const { return m_name.name(); }

private:
    TextureName m_name;
    std::array<int, 3> m_size;
    fourier::Storage m_storage;
};

} // namespace pellucid::gpu
