// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/plan/render_plan.h"

namespace pellucid::plan {

/// How the images of a frame come about.
enum class Combination {
    one,     ///< one spectrum, one grey image
    tinted,  ///< one image, which takes its colour pixel by pixel
    channels ///< an image each for red, green and blue, of weighted sums of slices
};

/// What a frame does not need, and is not done.
enum class LeftOut {
    secondHalf,   ///< of the spectrum: that of real values is its mirror image
    emptySpace,   ///< samples of the volume beyond the part that is not empty
    light,        ///< without light there is no spectrum of gradients
    depthCue,     ///< without a cue there is one slice of a spectrum, not several
    color,        ///< of grey there is one image, not three
    cornersOfBand ///< frequencies beyond the largest circle
};

/// What a spectrum represents, which is also the reason for it.
enum class SpectrumOf {
    look,    ///< the density of the whole look
    channel, ///< the density of one of red, green and blue
    layer,   ///< a class or a point of the transfer function, whose weight may change
    gradient ///< the length of the gradient of one of those
};

/// The densities that an engine holds the spectra of.
struct FrameFields {
    int count = 1;
    SpectrumOf of = SpectrumOf::look;
    bool isColored = false; ///< the look is not grey
};

/// What a frame of a plan is made of, and what it costs.
struct FrameModel {
    struct Spectra {
        SpectrumOf of = SpectrumOf::look;
        int count = 0;
    };
    std::vector<Spectra> spectra; ///< one entry for each kind
    int slices = 1;               ///< of spectra, in a frame
    int images = 1;               ///< two-dimensional transforms, in a frame
    Combination combination = Combination::one;
    double multiplyAdds = 0.0; ///< of reals, to take the slices
    /// Additions and multiplications of reals in the transforms: 2.5 N log2 N of each image of N
    /// frequencies, as a real transform of any split radix about has.
    double transformOperations = 0.0;
    std::size_t spectrumBytes = 0, frameBytes = 0;
    std::vector<LeftOut> leftOut;
};

/// The frame that the scene's camera asks for. *Shape*: the lattice is that of the volume.
FrameModel modelFrame(const RenderPlan &plan, const scene::Scene &scene, const FrameFields &fields,
                      const volume::Lattice &lattice);

/// A line each, for scripts and for the user.
std::string spectrumText(SpectrumOf what); ///< what it represents
std::string reasonText(SpectrumOf what);   ///< why it is needed
std::string leftOutText(LeftOut what);
std::string combinationText(Combination how);

} // namespace pellucid::plan
