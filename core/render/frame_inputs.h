// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/render/frame_geometry.h"
#include "core/render/frame_mixing.h"
#include "core/render/frame_widths.h"

namespace pellucid::render {

/// The inputs of a frame, the same on the processor and on the graphics card.
struct FrameInputs {
    Mixing mixing;
    // Not set if nothing is shown.
    plan::SliceGrid grid;
    FrameGeometry geometry;
    FrameShading shading;
    bool isShaded = false; ///< whether cue or light change the slice
    ZeroSums zero{};       ///< of the sums, at frequency 0
    /// The widths that the slice is read by, and their kernels. Not set: the layout's own reads it.
    std::optional<widths::WidthMap> widthMap;
    std::shared_ptr<const fourier::KernelsByWidth> kernels;

    RadialFactors radial;

    /// Whether nothing is shown, so that the picture is zero.
    bool isEmpty() const { return mixing.sources.empty(); }
    /// 1 for a grey picture, else 3.
    int pictureChannels() const { return mixing.grey ? 1 : 3; }
    /// See `picture::FrameTimes`.
    widths::WidthMap::Shares widthShares(const fourier::SpectrumLayout &layout) const;
    widths::SlicePlane plane() const {
        return {grid.columns, grid.rows, geometry.cellsPerColumn, geometry.cellsPerRow};
    }
    /// The factor of the sums. The image of a grey picture also has its channel weight in it.
    double unit() const;
    /// The colors of the images of a color picture, whose sum is the picture.
    using ImageColors = std::array<std::array<float, 3>, FrameJob::maxImages>;
    ImageColors imageColors() const;
};

/// The part of a frame's job that reads the slice: spectra, kernels, geometry. It refers to the
/// inputs and the spectrum.
FrameJob readingJob(const FrameInputs &inputs, const fourier::Spectrum &spectrum,
                    const scene::ImageDefinition &image);

/// Computes the inputs of frames, and keeps what successive views share: the slice grid of a
/// framing, the moment kernels, and the tables for choosing widths. *Shape*: for spectra of one
/// layout. Not thread-safe.
class FrameSetup {
public:
    explicit FrameSetup(plan::FieldOfView fieldOfView,
                        std::shared_ptr<const widths::AdaptiveWidths> adaptive = nullptr)
        : m_fieldOfView(std::move(fieldOfView)), m_adaptive(std::move(adaptive)) {}

    void setWidths(std::shared_ptr<const widths::AdaptiveWidths> adaptive) {
        m_adaptive = std::move(adaptive);
    }
    const std::shared_ptr<const widths::AdaptiveWidths> &adaptiveWidths() const {
        return m_adaptive;
    }
    const plan::FieldOfView &fieldOfView() const { return m_fieldOfView; }
    /// Lights are off if there are no spectra of gradients. The moment kernels that the shading
    /// refers to live as long as this object. *Shape*: `channelWeights` has one entry per field.
    /// *Throws* Error{outOfMemory} as `plan::sliceGrid` does.
    FrameInputs inputsFor(const EngineSpectra &spectra,
                          const std::vector<ChannelWeights> &channelWeights,
                          const scene::Camera &camera, const scene::ImageDefinition &image,
                          const shading::Shading &shading,
                          const widths::ForEach &forEach = widths::inOrder);

    /// See `FramedGrid::periodOf`.
    scene::Camera periodOf(const EngineSpectra &spectra, const scene::Camera &camera,
                           const scene::ImageDefinition &image) {
        return m_framed.periodOf(camera, m_fieldOfView, spectra.fields.front()->lattice(), image);
    }

private:
    const MomentKernels *momentsFor(const fourier::KernelsByWidth *narrower,
                                    const fourier::SpectrumLayout &layout);

    plan::FieldOfView m_fieldOfView;
    std::shared_ptr<const widths::AdaptiveWidths> m_adaptive;
    FrameWidths m_frameWidths;
    FramedGrid m_framed;
    MomentKernels m_moments; // of each width, made for the first frame with a linear cue
};

} // namespace pellucid::render
