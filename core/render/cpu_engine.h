// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/render/projection_engine.h"

namespace pellucid::render {

struct FrameBuffers;

/// The projection-slice theorem on the processor. Interpolates the central slice of the half
/// spectrum strip by strip, multiplies by the reconstruction and the roll-off, and transforms each
/// strip back while it is in the cache. The result has the same bits for any number of threads;
/// between instruction sets that choose the same widths, images differ by less than 2e-6 of their
/// largest value. Each set measures the errors of widths with its own rounding, so that a tile on
/// the limit may get another width.
///
/// Several spectra are shown as their weighted sum: weights and positions of the kernel are
/// computed once for all, and each channel is transformed once, whatever the number of spectra. A
/// picture has one channel if all channel weights are grey and all lights are grey, else three. A
/// spectrum with zero weight costs nothing. *Source*: Cheng 2007, eq. 32 and 36.
///
/// Cue and light are applied to the slice (`shading::SliceShading`): a linear cue reads moments
/// from the same cells; light needs one more slice, whatever the number of lights.
class CpuEngine final : public ProjectionEngine {
public:
    /// `fieldOfView`: that of the plan; without it the spectrum's box is assumed to be full.
    /// `threads`: 0 for as many as oneTBB may use.
    explicit CpuEngine(std::shared_ptr<const fourier::Spectrum> spectrum,
                       const std::optional<plan::FieldOfView> &fieldOfView = std::nullopt,
                       int threads = 0);
    /// The channel weights are 1 until set.
    CpuEngine(EngineSpectra spectra, const plan::FieldOfView &fieldOfView, int threads = 0);
    ~CpuEngine() override;

    /// Sets the data for choosing kernel widths; null: the layout's own kernel reads everything.
    /// *Requires*: no concurrent frame.
    void setWidths(std::shared_ptr<const widths::AdaptiveWidths> widths);
    /// *Shape*: one entry per field.
    void setChannelWeights(std::vector<ChannelWeights> channelWeights);
    std::size_t fieldCount() const { return m_parts.spectra.fields.size(); }
    /// Bytes of all spectra.
    std::size_t bytes() const;
    /// Whether there are gradients, which lights need.
    bool canBeLit() const { return !m_parts.spectra.gradients.empty(); }

    task::Reason description() const override;
    /// *Requires*: no concurrent setChannelWeights().
    EngineParts parts() const override { return m_parts; }
    const EngineSpectra &spectra() const { return m_parts.spectra; }
    const plan::FieldOfView &fieldOfView() const { return m_parts.fieldOfView; }
    picture::ProjectionImage render(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading = {},
                                    picture::FrameTimes *times = nullptr) override;

    scene::Camera periodOf(const scene::Camera &camera,
                           const scene::ImageDefinition &image) override;

private:
    EngineParts m_parts;
    std::unique_ptr<FrameBuffers> m_buffers;
};

} // namespace pellucid::render
