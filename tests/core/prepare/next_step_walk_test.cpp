// SPDX-License-Identifier: GPL-3.0-or-later
// The engine follows the scene: in every state that can be reached, every decision keeps its
// invariants and leads to the wanted engine.
#include <deque>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "core/prepare/next_step.h"
#include "tests/core/prepare/looks.h"

namespace pellucid::prepare {

using namespace test;

namespace {

using enum Occasion;
using enum EngineStage;

// The state of a preparer, its document, jobs and timer. Users, scans and threads make the moves.
struct State {
    Have have;
    Look wanted = plain;
    bool restRuns = false;
};

enum class Move { coarse, full, coarseLayers, layers, stop, rest, scan, scanEnds, again, edit };

int indexOf(const std::optional<PreparedFor> &made) {
    for (int look = 0; made && look < looks; ++look)
        if (*made == madeFor(Look(look)))
            return look;
    return -1;
}

auto keyOf(const State &state) {
    const Have &have = state.have;
    const auto &underway = have.underway;
    return std::tuple(indexOf(have.full), indexOf(have.layers), have.shown ? int(*have.shown) : -1,
                      underway ? int(underway->makes) : -1, underway ? indexOf(underway->of) : -1,
                      underway && underway->isCoarsePending, indexOf(have.givenUp),
                      indexOf(have.layersGivenUp), have.isHeld, int(state.wanted), state.restRuns);
}

// Acts as LookPreparer does, and checks the invariants of each step.
void act(State &state, Occasion occasion) {
    const PreparedFor wanted = madeFor(state.wanted);
    for (int n = 0;; ++n) {
        ASSERT_LT(n, 5) << "a decision comes to its end";
        const Step step = next({wanted, occasion}, state.have);
        if (startsJob(step)) {
            ASSERT_FALSE(state.have.underway) << "never two jobs";
            ASSERT_FALSE(state.have.isHeld) << "a scan is left alone";
            if (step == Step::startLayers)
                ASSERT_FALSE(state.have.layersGivenUp &&
                             state.have.layersGivenUp->hasSameLayersAs(wanted))
                    << "layers that were given up are not started again";
            else
                ASSERT_FALSE(state.have.givenUp == wanted)
                    << "what was given up is not started again";
        }
        if (step == Step::showFull || step == Step::dropLight) {
            ASSERT_TRUE(state.have.full);
        }
        if (step == Step::showLayers) {
            ASSERT_TRUE(state.have.layers && state.have.layers->hasSameLayersAs(wanted));
        }
        if (step == Step::stopJob) {
            ASSERT_TRUE(state.have.underway);
        }
        state.have = afterStep(step, wanted, state.have);
        if (step == Step::hold)
            state.restRuns = false;
        if (step == Step::startFull || step == Step::startCoarseFirst)
            state.restRuns = false;
        if (step == Step::awaitRest || step == Step::startLayers ||
            (step == Step::showLayers && occasion == sceneChanged))
            state.restRuns = true;
        ASSERT_FALSE(state.have.underway && state.have.givenUp &&
                     state.have.underway->makes == Underway::Makes::engine);
        if (!isFollowed(step))
            return;
    }
}

void giveUp(State &state) {
    if (!state.have.underway)
        return;
    const bool madeEngine = state.have.underway->makes == Underway::Makes::engine;
    state.have = afterGivingUp(state.have);
    if (madeEngine)
        act(state, gaveUp);
}

// Makes the move; false if it cannot be made.
bool make(Move move, Look edited, State &state) {
    Have &have = state.have;
    const bool makesEngine = have.underway && have.underway->makes == Underway::Makes::engine;
    const bool makesLayers = have.underway && !makesEngine;
    const PreparedFor of = have.underway ? have.underway->of : PreparedFor();
    switch (move) {
    case Move::coarse:
        if (!makesEngine)
            return false;
        have = afterCoarse(of, have);
        act(state, sceneChanged);
        return true;
    case Move::full: // also of a small volume, which has no coarse one
        if (!makesEngine)
            return false;
        have = afterFull(of, have);
        act(state, fullArrived);
        return true;
    case Move::coarseLayers:
    case Move::layers:
        if (!makesLayers)
            return false;
        have = afterLayers(of, move == Move::layers ? Detail::full : Detail::coarse, have);
        act(state, layersArrived);
        return true;
    case Move::stop:
        if (!have.underway)
            return false;
        giveUp(state);
        return true;
    case Move::rest:
        if (!state.restRuns)
            return false;
        state.restRuns = false;
        act(state, handRested);
        return true;
    case Move::scan:
        if (have.isHeld)
            return false;
        giveUp(state);
        have.isHeld = true;
        return true;
    case Move::scanEnds:
        if (!have.isHeld)
            return false;
        have.isHeld = false;
        [[fallthrough]];
    case Move::again:
        have.givenUp.reset();
        have.layersGivenUp.reset();
        act(state, sceneChanged);
        return true;
    case Move::edit:
        if (edited == state.wanted)
            return false;
        state.wanted = edited;
        act(state, sceneChanged);
        return true;
    }
    return false;
}

// If every job succeeds and nobody touches anything, the wanted engine is made and shown.
void expectReached(State state, bool isLarge) {
    for (int n = 0; n < 8; ++n) {
        if (state.have.full == madeFor(state.wanted) && !state.restRuns && !state.have.underway) {
            EXPECT_TRUE(state.have.shown == full || state.have.shown == settled);
            return;
        }
        std::vector<Move> order{Move::full, Move::layers, Move::rest};
        if (isLarge && state.have.underway && state.have.underway->isCoarsePending)
            order.insert(order.begin(), Move::coarse);
        bool isMoved = false;
        for (const Move move : order)
            if (!isMoved)
                isMoved = make(move, state.wanted, state);
        ASSERT_TRUE(isMoved || testing::Test::HasFatalFailure())
            << "nothing is underway, and what is wanted is not there";
    }
    ADD_FAILURE() << "what is wanted does not come";
}

TEST(NextStep, TheWantedEngineIsReachedFromEveryState) {
    std::set<decltype(keyOf(State()))> seen;
    // Two beginnings: nothing yet, and a study that is loading, whose job makes its first engine.
    std::deque<State> open{State(), State{.have = {.underway = engineOf(plain)}}};
    for (const State &state : open)
        seen.insert(keyOf(state));
    for (; !open.empty() && !HasFailure(); open.pop_front()) {
        const auto follow = [&](Move move, Look edited) {
            State state = open.front();
            if (!make(move, edited, state))
                return;
            if (seen.insert(keyOf(state)).second)
                open.push_back(state);
            // An abandoned job waits until it is requested again.
            if ((move == Move::edit || move == Move::again || move == Move::scanEnds) &&
                !state.have.isHeld && state.have.givenUp != madeFor(state.wanted))
                for (const bool isLarge : {false, true})
                    expectReached(state, isLarge);
        };
        for (int move = 0; move < int(Move::edit); ++move)
            follow(Move(move), plain);
        for (int look = 0; look < looks; ++look)
            follow(Move::edit, Look(look));
    }
    EXPECT_GT(seen.size(), 1000U); // the walk went somewhere
    RecordProperty("combinations", int(seen.size()));
}

} // namespace

} // namespace pellucid::prepare
