// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/prepare/next_step.h"

#include <utility>

namespace pellucid::prepare {

namespace {

bool isMaking(const Have &have, Underway::Makes makes) {
    return have.underway && have.underway->makes == makes;
}

bool isUnderway(const PreparedFor &look, const Have &have) {
    return isMaking(have, Underway::Makes::engine) && have.underway->of == look;
}

// Whether the picture is only a placeholder for that of a full engine.
bool isPlaceholderShown(const Have &have) {
    return have.shown == EngineStage::coarse || have.shown == EngineStage::live;
}

// Jobs do not overlap: the current one is stopped first.
Step start(Step step, const Have &have) {
    return have.underway ? Step::stopJob : step;
}

Step backToFull(const Have &have) {
    // Layers underway may finish: the user may need them in a moment.
    if (isMaking(have, Underway::Makes::engine))
        return Step::stopJob;
    return isPlaceholderShown(have) ? Step::showFull : Step::hold;
}

Step followCueAndLight(const PreparedFor &look, const Have &have) {
    // An engine without its light may be sufficient.
    if (have.full->isLit && !look.isLit)
        return have.underway ? Step::stopJob : Step::dropLight;
    // A light needs gradients, so a coarse engine comes first. A cue shows with any engine.
    if (look.isLit && !have.full->isLit)
        return start(Step::startCoarseFirst, have);
    return isPlaceholderShown(have) ? Step::showFull : start(Step::startFull, have);
}

Step followWeights(const PreparedFor &look, const Have &have) {
    // Under light the picture is not a sum of layers: coarse engines serve the interaction.
    if (look.isLit)
        return start(Step::startCoarseFirst, have);
    // The engine of an earlier sum is obsolete and would slow down the interaction.
    if (isMaking(have, Underway::Makes::engine))
        return Step::stopJob;
    if (have.layers && have.layers->hasSameLayersAs(look))
        return Step::showLayers;
    if ((have.underway && have.underway->of.hasSameLayersAs(look)) ||
        (have.layersGivenUp && have.layersGivenUp->hasSameLayersAs(look)))
        return Step::awaitRest;
    return start(Step::startLayers, have);
}

Step follow(const PreparedFor &look, const Have &have) {
    if (isUnderway(look, have) || look == have.givenUp)
        return Step::nothing;
    if (have.isHeld)
        return have.full && look != have.full ? Step::awaitScan : Step::nothing;
    if (look == have.full)
        return backToFull(have);
    // A coarse picture with other weights is about to arrive, and the next one follows it. If a
    // continuing drag stopped it, the user would never see any.
    if (have.underway && have.underway->isCoarsePending && look.hasSameLayersAs(have.underway->of))
        return Step::nothing;
    if (have.full && look.showsSameAs(*have.full))
        return followCueAndLight(look, have);
    if (have.full && look.hasSameLayersAs(*have.full))
        return followWeights(look, have);
    return start(Step::startCoarseFirst, have);
}

Step settle(const PreparedFor &look, const Have &have) {
    // Layers finish first: they serve the interaction.
    if (isMaking(have, Underway::Makes::layers))
        return Step::awaitRest;
    if (have.isHeld || look == have.full || isUnderway(look, have) || look == have.givenUp)
        return Step::nothing;
    return start(Step::startFull, have);
}

// A full engine after layers keeps their brightness.
void show(Have &have) {
    have.shown = have.shown == EngineStage::live ? EngineStage::settled : EngineStage::full;
}

} // namespace

Step next(const Wanted &wanted, const Have &have) {
    const PreparedFor &look = wanted.look;
    switch (wanted.occasion) {
    case Occasion::sceneChanged:
        return follow(look, have);
    case Occasion::handRested:
        return settle(look, have);
    case Occasion::fullArrived:
        // A small volume has no coarse engine, so the user waited for the full one. If the look has
        // changed meanwhile, it gets its own brightness.
        return have.isHeld || look == have.full ? Step::nothing
                                                : start(Step::startCoarseFirst, have);
    case Occasion::layersArrived:
        return have.full && look != have.full && look.hasSameLayersAs(*have.layers)
                   ? Step::showLayers
                   : Step::nothing;
    case Occasion::gaveUp:
        // The previous full picture is better than a coarse one that will not be completed.
        return have.full && isPlaceholderShown(have) ? Step::showFull : Step::nothing;
    }
    return Step::nothing;
}

bool isFollowed(Step step) {
    return step == Step::stopJob || step == Step::dropLight || step == Step::showFull;
}

bool startsJob(Step step) {
    return step == Step::startLayers || step == Step::startFull || step == Step::startCoarseFirst;
}

Have afterStep(Step step, const PreparedFor &look, Have have) {
    switch (step) {
    case Step::nothing:
    case Step::awaitScan:
    case Step::awaitRest:
        break;
    case Step::hold:
        have.givenUp.reset(); // it may be requested again
        break;
    case Step::stopJob:
        have.underway.reset();
        break;
    case Step::dropLight:
        have.givenUp.reset();
        have.full->isLit = false;
        show(have);
        break;
    case Step::showFull:
        show(have);
        break;
    case Step::showLayers:
        have.shown = EngineStage::live;
        break;
    case Step::startLayers:
        have.layers.reset();
        have.underway = Underway{Underway::Makes::layers, look};
        break;
    case Step::startFull:
    case Step::startCoarseFirst:
        have.givenUp.reset();
        have.underway = Underway{Underway::Makes::engine, look, step == Step::startCoarseFirst};
        break;
    }
    return have;
}

Have afterCoarse(const PreparedFor &of, Have have) {
    if (have.underway)
        have.underway->isCoarsePending = false;
    have.shown =
        have.full && of.hasSameLayersAs(*have.full) ? EngineStage::live : EngineStage::coarse;
    return have;
}

Have afterFull(const PreparedFor &of, Have have) {
    have.underway.reset();
    have.givenUp.reset();
    if (have.layers && !have.layers->hasSameLayersAs(of)) {
        have.layers.reset();
        have.shown.reset();
    }
    have.full = of;
    show(have);
    return have;
}

Have afterLayers(const PreparedFor &of, Detail detail, Have have) {
    have.layers = of;
    if (detail == Detail::full)
        have.underway.reset();
    return have;
}

Have afterGivingUp(Have have) {
    if (!have.underway)
        return have;
    (have.underway->makes == Underway::Makes::engine ? have.givenUp : have.layersGivenUp) =
        std::move(have.underway->of);
    have.underway.reset();
    return have;
}

} // namespace pellucid::prepare
