// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/couch.h"

#include <algorithm>

#include "core/classify/region_edits.h"

namespace pellucid::classify {

namespace {

bool isOfTheVolume(const TissueClass &tissue) {
    return tissue.segment.empty();
}

bool isOfTheBody(const TissueClass &tissue) {
    return std::any_of(tissue.steps.begin(), tissue.steps.end(), [](const Step &step) {
        return step.kind == StepKind::body || step.kind == StepKind::skin;
    });
}

// The class that shows only the patient, in place of the whole volume.
TissueClass patientClass(const TransferFunction &curve, const FieldWindow &window) {
    TissueClass patient = volumeClass(curve, window);
    patient.name = "Patient";
    patient.steps = {{StepKind::body, {}}};
    return patient;
}

} // namespace

bool isWithoutCouch(const Look &look) {
    return std::any_of(look.classes.begin(), look.classes.end(), isOfTheVolume) &&
           std::all_of(look.classes.begin(), look.classes.end(), [](const TissueClass &tissue) {
               return !isOfTheVolume(tissue) || isOfTheBody(tissue);
           });
}

void removeCouch(Look &look, const FieldWindow &window) {
    if (look.classes.empty())
        look.classes.push_back(patientClass(look.transferFunction, window));
    for (TissueClass &tissue : look.classes) {
        if (!isOfTheVolume(tissue) || isOfTheBody(tissue) || tissue.steps.size() >= maxSteps)
            continue;
        // First of the steps that restrict the region: the others are to find only the patient.
        const auto at =
            std::find_if(tissue.steps.begin(), tissue.steps.end(), [](const Step &step) {
                return describe(step.kind).effect == StepEffect::region;
            });
        tissue.steps.insert(at, {StepKind::body, {}});
    }
}

void restoreCouch(Look &look, const FieldWindow &window) {
    if (look.classes == std::vector{patientClass(look.transferFunction, window)}) {
        look.classes.clear();
        return;
    }
    for (TissueClass &tissue : look.classes)
        if (isOfTheVolume(tissue))
            std::erase_if(tissue.steps,
                          [](const Step &step) { return step.kind == StepKind::body; });
}

} // namespace pellucid::classify
