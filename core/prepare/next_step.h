// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/prepare/prepared_for.h"

/// How the engine of the projection follows the scene. While weights and colors change, the layers
/// of the look are summed; when they rest, one engine is made of the sum. All decisions are pure
/// functions here; ui/engine/look_preparer.h executes them.
namespace pellucid::prepare {

/// How far an engine is from the requested one: a first, small picture; the layers of a look,
/// summed while their weights change; the sum itself, after they have come to rest; or a full
/// engine for a different look.
enum class EngineStage { coarse, live, settled, full };

/// What an engine is made from: a reduced copy of the volume, which takes an instant, or the volume
/// itself.
enum class Detail { coarse, full };

/// The job that makes an engine or layers; there is at most one.
struct Underway {
    enum class Makes { engine, layers };
    Makes makes = Makes::engine;
    PreparedFor of;
    bool isCoarsePending = false; ///< the engine's coarse picture is still to come
};

/// What exists, what is being made, and what was given up.
struct Have {
    std::optional<PreparedFor> full;   ///< the scene that the full engine was made for
    std::optional<PreparedFor> layers; ///< the scene that the layers, coarse or full, were made for
    std::optional<EngineStage> shown;  ///< the last engine handed over; not set for a new volume
    std::optional<Underway> underway;
    std::optional<PreparedFor> givenUp;       ///< a full engine that was cancelled or failed
    std::optional<PreparedFor> layersGivenUp; ///< layers that were cancelled or failed
    bool isHeld = false; ///< a job that changes the scene is running: nothing is prepared now
};

/// What has just happened.
enum class Occasion {
    sceneChanged,  ///< by a drag that may continue; also if the same scene is requested again
    handRested,    ///< the weights have not changed for a while
    fullArrived,   ///< a full engine was delivered and is shown
    layersArrived, ///< coarse or full layers were delivered
    gaveUp         ///< a full engine was cancelled or failed
};

/// The requested look, and why it is asked for now.
struct Wanted {
    PreparedFor look;
    Occasion occasion = Occasion::sceneChanged;
};

/// A single action.
enum class Step {
    nothing,          ///< the look is being made, was given up, or has to wait
    hold,             ///< keep everything: the look is prepared and shown
    awaitScan,        ///< the look follows after the scan
    awaitRest,        ///< the look follows when the weights rest
    stopJob,          ///< stop the current job, which is obsolete; it does not count as given up
    dropLight,        ///< show the full engine without its light
    showFull,         ///< show the full engine in place of a coarse picture or of layers
    showLayers,       ///< show layers with the current weights, then await rest
    startLayers,      ///< make layers, and await rest
    startFull,        ///< make only the full engine: the current picture is close enough
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
/// The state after a coarse engine was delivered. If only weights differ from the full engine, it
/// keeps that engine's brightness, as layers do.
Have afterCoarse(const PreparedFor &of, Have have);
/// The state after a full engine was delivered and shown. Layers of another look are dropped.
Have afterFull(const PreparedFor &of, Have have);
/// The state after layers were delivered. The job of coarse layers continues with the full ones.
Have afterLayers(const PreparedFor &of, Detail detail, Have have);
/// The state after the current job ended before it had delivered everything.
Have afterGivingUp(Have have);

} // namespace pellucid::prepare
