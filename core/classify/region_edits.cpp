// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/region_edits.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace pellucid::classify {

namespace {

bool isRegionStep(const Step &step) {
    return describe(step.kind).effect == StepEffect::region;
}

// Adds a step. The first border that a class gets is soft; the user may choose another.
void append(TissueClass &tissue, const Step &step) {
    if (tissue.edge == 0.0 && std::none_of(tissue.steps.begin(), tissue.steps.end(), isRegionStep))
        tissue.edge = defaultEdge;
    tissue.steps.push_back(step);
}

void showVolume(Look &look, const FieldWindow &window) {
    if (look.classes.empty())
        look.classes.push_back(volumeClass(look.transferFunction, window));
}

template <class F>
void forEdited(Look &look, EditedClass edited, const FieldWindow &window, const F &edit) {
    showVolume(look, window);
    for (std::size_t n = 0; n < look.classes.size(); ++n)
        if (!edited || *edited == n)
            edit(look.classes[n]);
}

// Strokes and cuts in a row share a step.
Step &lastStep(TissueClass &tissue, StepKind kind) {
    if (tissue.steps.empty() || tissue.steps.back().kind != kind)
        append(tissue, {kind});
    return tissue.steps.back();
}

Step combining(StepKind kind, const TissueClass &own) {
    Step step{kind};
    step.operand.own = std::make_shared<const TissueClass>(own);
    return step;
}

std::size_t addShown(Look &look, TissueClass region, const FieldWindow &window) {
    showVolume(look, window);
    region.color = distinctColor(look.classes.size());
    addClass(look, std::move(region));
    return look.classes.size() - 1;
}

// A region with soft borders. Its color is chosen when a look shows it.
TissueClass regionOf(double low, double high) {
    TissueClass region;
    region.name = "Region";
    region.low = low;
    region.high = high;
    region.edge = defaultEdge;
    return region;
}

TissueClass drawnClass() {
    TissueClass drawn = regionOf(lowestValue, highestValue);
    drawn.isDrawn = true;
    return drawn;
}

bool isMark(const Step &step) {
    return step.kind == StepKind::paint || step.kind == StepKind::scissors;
}

// The class without its marks, or nothing if it consists of marks alone.
std::optional<TissueClass> withoutMarks(TissueClass tissue) {
    const bool hadMarks = std::erase_if(tissue.steps, isMark) > 0;
    std::erase_if(tissue.steps, [](Step &step) {
        step.points.clear();
        if (!step.operand.own)
            return false;
        const auto own = withoutMarks(*step.operand.own);
        if (own)
            step.operand.own = std::make_shared<const TissueClass>(*own);
        return !own.has_value();
    });
    // A drawn class is empty unless a step adds to it. A class that only its cuts limited would
    // become the whole volume.
    const bool isEmpty =
        tissue.isDrawn && std::none_of(tissue.steps.begin(), tissue.steps.end(),
                                       [](const Step &s) { return s.kind == StepKind::join; });
    const bool isAll = !tissue.isDrawn && !tissue.hasRange() && tissue.segment.empty() &&
                       tissue.steps.empty() && hadMarks;
    return isEmpty || isAll ? std::nullopt : std::optional(std::move(tissue));
}

bool awaitsPointsWithin(const TissueClass &tissue) {
    return std::any_of(tissue.steps.begin(), tissue.steps.end(), [](const Step &step) {
        return awaitsPoints(step) || (step.operand.own && awaitsPointsWithin(*step.operand.own));
    });
}

} // namespace

TissueClass volumeClass(const TransferFunction &curve, const FieldWindow &window) {
    TissueClass volume;
    volume.name = "Volume";
    volume.low = window.low; // the density is 0 below
    volume.high = highestValue;
    if (!(curve == TransferFunction()))
        volume.transferFunction = curve;
    return volume;
}

TissueClass connectedRegion(volume::PatientPoint point, double low, double high, double leakMm) {
    TissueClass region = regionOf(low, high);
    Step connected{StepKind::connected};
    if (leakMm > 0.0)
        connected.parameters["leak_mm"] = leakMm;
    connected.points = {point};
    region.steps = {connected};
    return region;
}

TissueClass cutRegion(const LassoCut &cut) {
    TissueClass region = regionOf(lowestValue, highestValue);
    Step step{StepKind::scissors};
    step.cuts = {cut};
    step.cuts.front().keeps = true;
    region.steps = {step};
    return region;
}

TissueClass boneRegion(const volume::Lattice &lattice, volume::PatientPoint point, double low) {
    // Wider than the pores of spongy bone, narrower than the gaps between bones and vessels.
    constexpr double marrowMm = 3.0, minRimMm = 1.0, slightlyMore = 1.01;
    const StepParameter &distance = describe(StepKind::grow).parameters.front();
    const double rimMm =
        std::clamp(slightlyMore * lattice.shortestStepMm(), minRimMm, distance.maximum);
    TissueClass bone = connectedRegion(point, low, highestValue, 0.0);
    bone.name = "Bone";
    bone.steps.push_back({StepKind::closing, {{"radius_mm", marrowMm}}});
    bone.steps.push_back({StepKind::fill});
    bone.steps.push_back({StepKind::grow, {{"mm", rimMm}}});
    return bone;
}

EditedClass useRegion(Look &look, const TissueClass &region, RegionUse use, EditedClass edited,
                      const FieldWindow &window) {
    switch (use) {
    case RegionUse::newClass:
        return addShown(look, region, window);
    case RegionUse::add:
        addStep(look, combining(StepKind::join, region), *edited);
        break;
    case RegionUse::keep:
    case RegionUse::remove:
        forEdited(look, edited, window, [&](TissueClass &tissue) {
            const Step step = combining(
                use == RegionUse::keep ? StepKind::intersection : StepKind::difference, region);
            // A second click at the same place changes nothing.
            if (std::find(tissue.steps.begin(), tissue.steps.end(), step) == tissue.steps.end())
                append(tissue, step);
        });
        break;
    }
    return edited;
}

void cutClasses(Look &look, const LassoCut &cut, EditedClass edited, const FieldWindow &window) {
    forEdited(look, edited, window, [&](TissueClass &tissue) {
        lastStep(tissue, StepKind::scissors).cuts.push_back(cut);
    });
}

EditedClass paintClass(Look &look, const std::vector<Stroke> &strokes, EditedClass edited,
                       const FieldWindow &window) {
    if (!edited && !strokes.front().erases)
        edited = addShown(look, drawnClass(), window);
    forEdited(look, edited, window, [&](TissueClass &tissue) {
        std::vector<Stroke> &all = lastStep(tissue, StepKind::paint).strokes;
        all.insert(all.end(), strokes.begin(), strokes.end());
    });
    return edited;
}

void addStep(Look &look, const Step &step, std::size_t edited) {
    append(look.classes[edited], step);
}

std::optional<std::size_t> awaitingClass(const Look &look) {
    const auto found = std::find_if(look.classes.begin(), look.classes.end(), awaitsPointsWithin);
    return found == look.classes.end() ? std::nullopt
                                       : std::optional(std::size_t(found - look.classes.begin()));
}

bool addPoint(TissueClass &tissue, volume::PatientPoint point) {
    // The step that waits, or else the last one that takes points.
    Step *chosen = nullptr;
    for (Step &step : tissue.steps) {
        if (describe(step.kind).input == StepInput::points &&
            (chosen == nullptr || !awaitsPoints(*chosen)))
            chosen = &step;
        if (step.operand.own && awaitsPointsWithin(*step.operand.own) &&
            (chosen == nullptr || !awaitsPoints(*chosen))) {
            TissueClass own = *step.operand.own;
            addPoint(own, point);
            step.operand.own = std::make_shared<const TissueClass>(std::move(own));
            return true;
        }
    }
    if (chosen == nullptr)
        return false;
    chosen->points.push_back(point);
    return true;
}

bool takesPoints(const TissueClass &tissue) {
    return std::any_of(tissue.steps.begin(), tissue.steps.end(), [](const Step &step) {
        return describe(step.kind).input == StepInput::points ||
               (step.operand.own && awaitsPointsWithin(*step.operand.own));
    });
}

Look withoutMarks(const Look &look) {
    Look plain = look;
    for (std::size_t n = 0; n < plain.classes.size();) {
        if (auto remaining = withoutMarks(plain.classes[n])) {
            plain.classes[n++] = *std::move(remaining);
            continue;
        }
        removeClass(plain, n);
        n = 0; // its users have it as their own now
    }
    return plain;
}

} // namespace pellucid::classify
