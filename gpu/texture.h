// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/storage.h"
#include "gpu/handle.h"

namespace pellucid::gpu {

/// The pixels of a projection: layers of one float each (R32F), as the passes write them, or one
/// layer of one or three (RGB32F) from memory. Filtered linearly, clamped at its edges. Belongs to
/// the context that is current when it is made, and to those that share.
class PixelTexture {
public:
    PixelTexture();

    /// *Shape*: height x width x channels, rows from the top. One channel is read as all three.
    void upload(int width, int height, int channels, const float *samples);
    /// Layers for passes to write into. *Throws* Error{outOfMemory}.
    void reserve(int width, int height, int layers);
    /// *Shape*: layers x height x width.
    std::vector<float> download() const;
    /// All zero.
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

/// A 3D texture of complex numbers, RG16F or RG32F, filtered linearly where it is filtered. Belongs
/// to the context that is current when it is made; move-only.
class ComplexTexture {
public:
    /// *Throws* Error{outOfMemory}.
    ComplexTexture(const std::array<int, 3> &size, fourier::Storage storage);

    /// *Shape*: planes x rows x columns, without gaps.
    void upload(int firstPlane, int planes, const void *cells);
    unsigned id() const { return m_name.name(); }

private:
    TextureName m_name;
    std::array<int, 3> m_size;
    fourier::Storage m_storage;
};

} // namespace pellucid::gpu
