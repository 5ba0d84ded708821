// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/suites.h"

namespace pellucid::bench {

namespace {

Row measureDefault(const Subject &subject) {
    Measurement how;
    how.scene.camera = scene::defaultCamera(subject.field.values.lattice());
    how.peers = true;
    // The reference takes seconds for large volumes.
    Truth truth(subject, how.scene.camera, subject.field.values.lattice().size().i > 128 ? 2 : 5);
    return measure("quick", "default " + subject.name, subject, truth, how);
}

} // namespace

void runQuickSuite(const Report &report) {
    using phantom::Kind;
    const auto cubed = [](int n) { return phantom::Sampling{.size = volume::GridSize{n, n, n}}; };
    report(measureDefault(noiseSphere(64)));
    report(measureDefault(phantomSubject("head 64", Kind::head, cubed(64))));
    report(measureDefault(phantomSubject("chest cut by the scan 64", Kind::chest, cubed(64))));
    report(measureDefault(phantomSubject("tilted head, thick slices", Kind::head,
                                         {.size = volume::GridSize{128, 128, 28},
                                          .spacingMm = glm::dvec3(1.9, 1.9, 8.0),
                                          .tiltRad = 0.32})));
    report(measureDefault(noiseSphere(128)));
    report(measureDefault(phantomSubject("head 256", Kind::head, cubed(256))));
}

} // namespace pellucid::bench
