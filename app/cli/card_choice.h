// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/task/error.h"
#include "gpu/gpu_engine.h"

namespace pellucid::cli {

/// Whether to make the images on a graphics card, and on which one.
struct CardChoice {
    bool isRequired = false;                  ///< the user requires the card
    std::shared_ptr<gpu::FramePasses> passes; ///< null: the processor makes the images
    std::string reason;                       ///< why this engine was chosen, one line
};
/// Chooses between processor and graphics card. `engine`: "auto", "cpu" or "gpu". "auto" takes the
/// card if it is not a software renderer and there is more than one image to make: the processor
/// finishes a single image before the spectra have reached the card. *Throws* Error{noSuchDevice}
/// with the reason if "gpu" is requested and there is no card.
CardChoice chooseCard(const std::string &engine, int frames);

/// The error for a user who requires the card: the card is too small, or we cannot use one.
task::Error cardRefused(const task::Error &error);

} // namespace pellucid::cli
