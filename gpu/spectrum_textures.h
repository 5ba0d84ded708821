// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/render/projection_engine.h"
#include "gpu/frame_passes.h"

namespace pellucid::gpu {

/// The spectra of an engine on the card. The processor keeps its own, because the card can lose
/// them. They are 3D textures with the same cells and halo as on the processor, bit for bit, so
/// that both engines read the same. Several spectra are stacked in one texture, so that layers need
/// few textures; a spectrum larger than a texture may be is split into slabs.
class SpectrumTextures {
public:
    /// Copies some planes at a time, so that other engines can render in between.
    /// `maxTextureBytes`: of one texture. *Throws* Error{outOfMemory}, Error{noSuchDevice},
    /// Cancelled.
    static std::shared_ptr<const SpectrumTextures>
    upload(std::shared_ptr<FramePasses> passes, render::EngineSpectra spectra,
           const task::Progress &progress = {}, std::size_t maxTextureBytes = std::size_t(1) << 30);

    /// The same without the gradients, which only lights need.
    std::shared_ptr<const SpectrumTextures> withoutLight() const;

    const std::shared_ptr<FramePasses> &passes() const { return m_passes; }
    const render::EngineSpectra &spectra() const { return m_spectra; }
    const TexelLayout &layout() const { return m_layout; }
    /// Whether the gradients that lights need are on the card.
    bool canBeLit() const { return !m_gradients.empty(); }
    /// Texture names of the fields' pages, followed by the gradients' if `withGradients`.
    std::vector<unsigned> pages(bool withGradients) const;
    int fieldPages() const { return int(m_fields.size()); }
    /// Bytes on the card.
    std::size_t bytes() const;

private:
    using Pages = std::vector<std::shared_ptr<const ComplexTexture>>;
    SpectrumTextures(std::shared_ptr<FramePasses> passes, render::EngineSpectra spectra,
                     std::size_t maxTextureBytes);
    Pages uploadAll(const render::EngineSpectra::Spectra &spectra,
                    const task::Progress &progress) const;

    std::shared_ptr<FramePasses> m_passes;
    render::EngineSpectra m_spectra;
    TexelLayout m_layout;
    Pages m_fields, m_gradients;
};

} // namespace pellucid::gpu
