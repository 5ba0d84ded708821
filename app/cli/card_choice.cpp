// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/card_choice.h"

#include "core/task/reasons.h"
#include "gpu/surfaceless_context.h"

namespace pellucid::cli {

task::Error cardRefused(const task::Error &error) {
    const bool isTooSmall = error.code() == task::ErrorCode::outOfMemory;
    return {isTooSmall ? error.code() : task::ErrorCode::noSuchDevice,
            task::because::inWords("--engine gpu: " + error.reason().english())};
}

CardChoice chooseCard(const std::string &engine, int frames) {
    CardChoice choice{engine == "gpu", nullptr, "the graphics card was requested"};
    if (engine == "cpu")
        choice.reason = "the processor was requested";
    else if (engine == "auto" && frames < 2)
        choice.reason = "a single image is finished before its spectra would be on a graphics card";
    else
        try {
            choice.passes = std::make_shared<gpu::FramePasses>(std::make_shared<gpu::Device>(
                std::make_unique<gpu::SurfacelessContext>(choice.isRequired)));
            if (!choice.isRequired)
                choice.reason = "a graphics card was found";
            if (!choice.isRequired && choice.passes->device().capabilities().software) {
                choice.reason = "OpenGL runs on a software renderer";
                choice.passes.reset();
            }
        } catch (const task::Error &error) {
            if (choice.isRequired)
                throw cardRefused(error);
            choice.reason = error.reason().english();
        }
    return choice;
}

} // namespace pellucid::cli
