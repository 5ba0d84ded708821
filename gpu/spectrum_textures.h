// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/render/projection_engine.h"
#include "gpu/frame_passes.h"

namespace pellucid::gpu {

/// The spectra of an engine on the card, beside those on the processor: what the card holds can be
/// lost. They are 3D textures with the halo of the processor's, cell for cell and bit for bit, so
/// that both engines read the same: spectra on top of each other, so that layers need no more
/// textures than one, or one in several where it would be larger than the card takes.
class SpectrumTextures {
public:
    /// Copies plane by plane, part by part: frames of others go on meanwhile.
    /// `mostTextureBytes`: of one texture. *Throws* Error{outOfMemory}, Error{noSuchDevice},
    /// Cancelled.
    static std::shared_ptr<const SpectrumTextures>
    upload(std::shared_ptr<FramePasses> passes, render::EngineSpectra spectra,
           const task::Progress &progress = {},
           std::size_t mostTextureBytes = std::size_t(1) << 30);

    /// The same without what lights need.
    std::shared_ptr<const SpectrumTextures> withoutLight() const;

    const std::shared_ptr<FramePasses> &passes() const { return m_passes; }
    const render::EngineSpectra &spectra() const { return m_spectra; }
    const TexelLayout &layout() const { return m_layout; }
    bool takesLight() const { return !m_gradients.empty(); }
    /// The textures of the fields and, if they are asked for, of the gradients after them.
    std::vector<unsigned> pages(bool withGradients) const;
    int fieldPages() const { return int(m_fields.size()); }
    /// Bytes on the card.
    std::size_t bytes() const;

private:
    using Pages = std::vector<std::shared_ptr<const ComplexTexture>>;
    SpectrumTextures(std::shared_ptr<FramePasses> passes, render::EngineSpectra spectra,
                     std::size_t mostTextureBytes);
    Pages uploadAll(const render::EngineSpectra::Spectra &spectra,
                    const task::Progress &progress) const;

    std::shared_ptr<FramePasses> m_passes;
    render::EngineSpectra m_spectra;
    TexelLayout m_layout;
    Pages m_fields, m_gradients;
};

} // namespace pellucid::gpu
