// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/plan/render_plan.h"

namespace pellucid::plan {

/// How the images of a frame are made.
enum class Combination {
    one,     ///< one spectrum, one grey image
    tinted,  ///< one image, colored pixel by pixel
    mixed,   ///< two images in two colors, added pixel by pixel
    channels ///< one image each for red, green and blue, from weighted sums of slices
};

/// Work that a frame does not need, so that it is not done.
enum class LeftOut {
    secondHalf,   ///< of the spectrum: for real values it is the mirror image
    emptySpace,   ///< samples outside the part of the volume that is not empty
    light,        ///< without light no spectrum of gradients is needed
    depthCue,     ///< without a cue one slice of a spectrum is enough
    color,        ///< a grey picture needs one image instead of three
    cornersOfBand ///< frequencies beyond the largest circle
};

/// What a spectrum represents, and therefore why it is needed.
enum class SpectrumOf {
    look,    ///< the density of the whole look
    color,   ///< the density of a color that the look's colors are mixed from
    layer,   ///< a class or a control point of the transfer function, whose weight may change
    gradient ///< the length of the gradient of one of the others
};

/// The densities whose spectra an engine holds.
struct FrameFields {
    int count = 1;
    SpectrumOf of = SpectrumOf::look;
    int colors = 0; ///< the rank of the look's colors; 0: the look is grey
};

/// The parts of a frame of a plan, and their cost.
struct FrameModel {
    struct Spectra {
        SpectrumOf of = SpectrumOf::look;
        int count = 0;
    };
    std::vector<Spectra> spectra; ///< one entry for each kind
    int slices = 1;               ///< slices of spectra in a frame
    int images = 1;               ///< two-dimensional transforms in a frame
    Combination combination = Combination::one;
    double multiplyAdds = 0.0; ///< real multiply-adds for the slices
    /// Real additions and multiplications in the transforms: 2.5 N log2 N for an image of N
    /// frequencies, as in a split-radix real transform.
    double transformOperations = 0.0;
    std::size_t spectrumBytes = 0, frameBytes = 0;
    std::vector<LeftOut> leftOut;
};

/// The frame for the scene's camera. `widthShares`: those of a frame that was made, see
/// `picture::FrameTimes`; without them one width reads everything. *Shape*: the volume's lattice.
FrameModel modelFrame(const RenderPlan &plan, const scene::Scene &scene, const FrameFields &fields,
                      const volume::Lattice &lattice, std::span<const double> widthShares = {});

/// One line each, for scripts and for the user.
std::string spectrumText(SpectrumOf what); ///< what it represents
std::string reasonText(SpectrumOf what);   ///< why it is needed
std::string leftOutText(LeftOut what);
std::string combinationText(Combination how);

} // namespace pellucid::plan
