// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::gpu {

/// A 2D texture of one or three float channels (R32F, RGB32F), filtered linearly, clamped at its
/// edges. Belongs to the context that is current when it is made; move-only.
class FloatTexture {
public:
    FloatTexture();
    ~FloatTexture();
    FloatTexture(FloatTexture &&other) noexcept;
    FloatTexture &operator=(FloatTexture &&other) noexcept;

    /// *Shape*: height x width x channels, rows from the top. One channel is read as all three.
    void upload(int width, int height, int channels, const float *samples);
    unsigned id() const { return m_id; }

private:
    unsigned m_id = 0;
    int m_width = 0, m_height = 0, m_channels = 0;
};

} // namespace pellucid::gpu
