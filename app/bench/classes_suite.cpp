// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/look_rows.h"

namespace pellucid::bench {

void runClassesSuite(const Report &report) {
    for (const int side : {128, 256}) {
        const LookSubject subject(side);
        reportLook(report, "classes", "default plain density", subject, {}, "");
        classify::Look bent;
        bent.transferFunction.weights = {0.0, 0.5, 2.0, 1.0, 0.5, 2.0};
        reportLook(report, "classes", "default six points", subject, bent, "");
        classify::Look classes;
        for (std::size_t n = 0; n < 8; ++n) {
            classes.classes.push_back(classify::standardClasses()[n]);
            classes.classes.back().weight = 0.4 + 0.1 * double(n);
        }
        reportLook(report, "classes", "default eight classes", subject, classes, "");
    }
}

} // namespace pellucid::bench
