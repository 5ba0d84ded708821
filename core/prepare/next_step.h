// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/prepare/prepared_for.h"

/// How the engine of the projection follows the scene. While weights and colours move, the layers
/// of the look are summed; when they rest, one engine is made of the sum. All decisions are pure
/// functions here; ui/engine/look_preparer.h carries them out.
namespace pellucid::prepare {

/// How far an engine is from what is wanted: a first, small picture; the parts of a look summed
/// while its weights move; the sum itself, after they came to rest; or another thing altogether.
enum class EngineStage { coarse, live, settled, full };

/// What an engine is made from: a reduced copy of the volume, which takes a blink, or the volume.
enum class Detail { coarse, full };

/// The job that makes an engine or layers; there is one at a time.
struct Underway {
    enum class Makes { engine, layers };
    Makes makes = Makes::engine;
    PreparedFor of;
    bool isCoarseToCome = false; ///< the engine's coarse picture is still to come
};

/// What has been made, is being made and was given up.
struct Have {
    std::optional<PreparedFor> full;   ///< what the full engine is made for
    std::optional<PreparedFor> layers; ///< what the layers, coarse or full, are made for
    std::optional<EngineStage> shown;  ///< the last engine handed over; none for a new volume
    std::optional<Underway> underway;
    std::optional<PreparedFor> givenUp;       ///< a full engine that was cancelled or failed
    std::optional<PreparedFor> layersGivenUp; ///< layers that were cancelled or failed
    bool isHeld = false; ///< studies are being scanned: nothing is prepared meanwhile
};

/// What has just happened.
enum class Occasion {
    sceneChanged, ///< by a hand that may go on; also when the same is requested again
    handRested,   ///< the weights have stood still for a while
    fullCame,     ///< a full engine was delivered and is shown
    layersCame,   ///< coarse or full layers were delivered
    gaveUp        ///< a full engine was cancelled or failed
};

/// What is wanted, and why the question arises now.
struct Wanted {
    PreparedFor look;
    Occasion occasion = Occasion::sceneChanged;
};

/// One thing to do.
enum class Step {
    nothing,          ///< the look is underway, was given up, or has to wait
    hold,             ///< the look is prepared and shown
    awaitScan,        ///< the look follows after the scan
    awaitRest,        ///< the look follows when the hand rests
    stopJob,          ///< the job underway is not wanted any more; it does not count as given up
    dropLight,        ///< show the full engine without its light
    showFull,         ///< show the full engine in place of a coarse picture or of layers
    showLayers,       ///< show layers with the present weights; then, as the hand moves, await rest
    startLayers,      ///< make layers, and await rest
    startFull,        ///< make the full engine alone: what is shown is close enough
    startCoarseFirst, ///< make a coarse engine, then the full one
};

/// The next step. Steps that start a job are returned only while no job is underway.
Step next(const Wanted &wanted, const Have &have);

/// Whether another step follows this one on the same occasion: then `next` is asked again.
bool isFollowed(Step step);

/// Whether this step starts a job.
bool startsJob(Step step);

/// The state after a step for a look.
Have afterStep(Step step, const PreparedFor &look, Have have);
/// The state after a coarse engine was delivered. Where only weights differ from the full engine,
/// it keeps that one's brightness, as layers do.
Have afterCoarse(const PreparedFor &of, Have have);
/// The state after a full engine was delivered and shown. Layers of another look are dropped.
Have afterFull(const PreparedFor &of, Have have);
/// The state after layers were delivered. The job of coarse layers goes on to the full ones.
Have afterLayers(const PreparedFor &of, Detail detail, Have have);
/// The state after the job underway ended before it had delivered everything.
Have afterGivingUp(Have have);

} // namespace pellucid::prepare
