// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::gpu {

/// A 2D texture of one float channel (R32F), filtered linearly, clamped at its edges. Belongs to
/// the context that is current when it is made; move-only.
class FloatTexture {
public:
    FloatTexture();
    ~FloatTexture();
    FloatTexture(FloatTexture &&other) noexcept;
    FloatTexture &operator=(FloatTexture &&other) noexcept;

    /// *Shape*: height x width, rows from the top.
    void upload(int width, int height, const float *samples);
    unsigned id() const { return m_id; }

private:
    unsigned m_id = 0;
    int m_width = 0, m_height = 0;
};

} // namespace pellucid::gpu
