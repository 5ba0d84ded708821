// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>

#include "app/bench/suites.h"

namespace pellucid::bench {

void runHardSuite(const Report &report) {
    for (const HardSubject &hard : hardSubjects()) {
        const Subject subject{hard.name, hard.make()};
        Measurement how;
        how.scene.camera = scene::defaultCamera(subject.field.values.lattice());
        how.views = 4; // the speed does not matter here
        how.transform = false;
        Truth truth(subject, how.scene.camera, 6);
        for (const double tolerance : {1e-2, scene::Scene().tolerance, 1e-4, 1e-5}) {
            how.scene.tolerance = tolerance;
            const bool isDefault = tolerance == scene::Scene().tolerance;
            Row row = measure(
                "hard",
                fmt::format("{}{}, {:.2g}", isDefault ? "default " : "", subject.name, tolerance),
                subject, truth, how);
            row.note = *row.relativeL2 == 0.0            ? "exact"
                       : *row.predictedError > tolerance ? "flagged: the tolerance cannot be met"
                       : *row.relativeL2 > tolerance
                           ? "MISSED"
                           : fmt::format("predicted {:.2g} times the measured error",
                                         *row.predictedError / std::max(1e-30, *row.relativeL2));
            report(row);
        }
    }
}

} // namespace pellucid::bench
