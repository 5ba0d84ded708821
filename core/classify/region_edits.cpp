// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/region_edits.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace pellucid::classify {

namespace {

// Colors that stand out from each other and from grey.
constexpr Color regionColors[] = {{1.0, 0.42, 0.35}, {0.36, 0.78, 1.0}, {0.55, 0.9, 0.45},
                                  {1.0, 0.8, 0.3},   {0.8, 0.55, 1.0},  {0.35, 0.9, 0.8}};

void soften(TissueClass &tissue) {
    if (tissue.edge == 0.0)
        tissue.edge = defaultEdge;
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
        tissue.steps.push_back({kind});
    return tissue.steps.back();
}

Step combining(StepKind kind, const TissueClass &own) {
    Step step{kind};
    step.operand.own = std::make_shared<const TissueClass>(own);
    return step;
}

std::size_t addShown(Look &look, TissueClass region, const FieldWindow &window) {
    showVolume(look, window);
    region.color = regionColors[look.classes.size() % std::size(regionColors)];
    addClass(look, std::move(region));
    return look.classes.size() - 1;
}

TissueClass drawnClass() {
    TissueClass drawn;
    drawn.name = "Region";
    drawn.low = lowestValue;
    drawn.high = highestValue;
    drawn.edge = defaultEdge;
    drawn.isDrawn = true;
    return drawn;
}

TissueClass withoutMarks(TissueClass tissue);

bool isMark(const Step &step) {
    return step.kind == StepKind::paint || step.kind == StepKind::scissors;
}

// A region that was made by hand only.
bool isOnlyMarks(const TissueClass &tissue) {
    return tissue.isDrawn && tissue.steps.empty();
}

TissueClass withoutMarks(TissueClass tissue) {
    std::erase_if(tissue.steps, isMark);
    for (Step &step : tissue.steps) {
        step.points.clear();
        if (step.operand.own)
            step.operand.own =
                std::make_shared<const TissueClass>(withoutMarks(*step.operand.own));
    }
    std::erase_if(tissue.steps, [](const Step &step) {
        return step.operand.own != nullptr && isOnlyMarks(*step.operand.own);
    });
    return tissue;
}

bool awaitsPointsWithin(const TissueClass &tissue) {
    return std::any_of(tissue.steps.begin(), tissue.steps.end(), [](const Step &step) {
        return awaitsPoints(step) || (step.operand.own && awaitsPointsWithin(*step.operand.own));
    });
}

} // namespace

TissueClass volumeClass(const TransferFunction &curve, const FieldWindow &window) {
    constexpr double highest = 32767.0; // of 16 bits
    TissueClass volume;
    volume.name = "Volume";
    volume.low = window.low;
    volume.high = std::max(highest, window.high);
    if (!(curve == TransferFunction()))
        volume.transferFunction = curve;
    return volume;
}

TissueClass connectedRegion(volume::PatientPoint point, double low, double high, double leakMm) {
    TissueClass region;
    region.name = "Region";
    region.low = low;
    region.high = high;
    region.edge = defaultEdge;
    Step connected{StepKind::connected};
    if (leakMm > 0.0)
        connected.parameters["leak_mm"] = leakMm;
    connected.points = {point};
    region.steps = {connected};
    return region;
}

TissueClass cutRegion(const LassoCut &cut) {
    TissueClass region;
    region.name = "Region";
    region.low = lowestValue;
    region.high = highestValue;
    region.edge = defaultEdge;
    Step step{StepKind::scissors};
    step.cuts = {cut};
    step.cuts.front().keeps = true;
    region.steps = {step};
    return region;
}

TissueClass boneRegion(const volume::Lattice &lattice, volume::PatientPoint point, double low) {
    // Wider than the pores of spongy bone, narrower than the gaps between bones and vessels.
    constexpr double marrowMm = 3.0, leastRimMm = 1.0, slightlyMore = 1.01;
    const double rimMm = std::max(leastRimMm, slightlyMore * lattice.shortestStepMm());
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
            tissue.steps.push_back(combining(use == RegionUse::keep ? StepKind::intersection
                                                                    : StepKind::difference,
                                             region));
            soften(tissue);
        });
        break;
    }
    return edited;
}

void cutClasses(Look &look, const LassoCut &cut, EditedClass edited, const FieldWindow &window) {
    forEdited(look, edited, window, [&](TissueClass &tissue) {
        lastStep(tissue, StepKind::scissors).cuts.push_back(cut);
        soften(tissue);
    });
}

EditedClass paintClass(Look &look, const Stroke &stroke, EditedClass edited,
                       const FieldWindow &window) {
    if (!edited && !stroke.erases)
        edited = addShown(look, drawnClass(), window);
    forEdited(look, edited, window, [&](TissueClass &tissue) {
        lastStep(tissue, StepKind::paint).strokes.push_back(stroke);
        soften(tissue);
    });
    return edited;
}

void addStep(Look &look, const Step &step, std::size_t edited) {
    TissueClass &tissue = look.classes[edited];
    tissue.steps.push_back(step);
    soften(tissue);
}

std::optional<std::size_t> awaitingClass(const Look &look) {
    const auto found =
        std::find_if(look.classes.begin(), look.classes.end(), awaitsPointsWithin);
    return found == look.classes.end()
               ? std::nullopt
               : std::optional(std::size_t(found - look.classes.begin()));
}

bool addPoint(TissueClass &tissue, volume::PatientPoint point) {
    // The one that waits; else the last.
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

Look withoutMarks(const Look &look) {
    Look plain = look;
    for (TissueClass &tissue : plain.classes)
        tissue = withoutMarks(tissue);
    for (std::size_t n = plain.classes.size(); n-- > 0;)
        if (isOnlyMarks(plain.classes[n])) {
            removeClass(plain, n);
            for (TissueClass &tissue : plain.classes)
                tissue = withoutMarks(tissue); // its users have it as their own now
        }
    return plain;
}

} // namespace pellucid::classify
