// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/color_basis.h"
#include "core/render/frame_job.h"
#include "core/render/projection_engine.h"

namespace pellucid::render {

/// The spectra with a nonzero weight in a picture, the number of sums and the number of images.
/// Without sources nothing is shown.
struct Mixing {
    /// `greyLight`: no light is colored, whatever color their sum has.
    Mixing(const EngineSpectra &spectra, const std::vector<ChannelWeights> &channelWeights,
           const shading::SliceShading &shading, bool greyLight);

    std::vector<FrameSource> sources;
    bool grey; ///< the picture has one channel
    int sums = 1, imageCount = 1;
    double unit = 1.0; ///< of the sums
    /// The colors of the sums. The picture needs as many sums as its colors have rank, see
    /// classify::ColorBasis; colored light needs one sum, or red, green and blue.
    std::array<ChannelWeights, 3> colors{primaries};
    /// The color of an image. Colored light gives one sum three images, which have theirs already.
    const ChannelWeights &imageColor(std::size_t image) const {
        return imageCount > sums ? primaries[image] : colors[image];
    }
    /// The sums at frequency 0, and their first moments in samples from the wrap voxel.
    struct Dc {
        double value = 0.0;
        glm::dvec3 moments{0.0};
    };
    std::array<std::array<Dc, 3>, 2> dc; ///< by kind and sum

private:
    static constexpr auto &primaries = classify::ColorBasis::primaries;
    // `weights`: in each sum.
    void add(const fourier::Spectrum &spectrum, FrameKind kind, std::size_t field,
             const ChannelWeights &weights);
};

/// A picture's shading in terms of cells and sums, without the moment kernels. *Shape*: `toWrap`
/// from the centre of rotation to the wrap voxel, mm; `toViewer` is W.
FrameShading frameShading(const shading::SliceShading &shading, const Mixing &mixing,
                          const fourier::Spectrum &spectrum, const glm::dvec3 &toWrap,
                          const glm::dvec3 &toViewer, double stepMm);

/// The moment kernels that belong to kernels of a layout, by axis.
std::vector<fourier::MomentKernel> momentKernels(const std::array<fourier::Kernel, 3> &kernels,
                                                 const fourier::SpectrumLayout &layout);

/// *Units*: of the mixing.
ZeroSums zeroSums(const Mixing &mixing, const FrameShading &shading,
                  const fourier::SpectrumLayout &layout);

} // namespace pellucid::render
