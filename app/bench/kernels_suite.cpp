// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/bench/suites.h"

namespace pellucid::bench {

namespace {

std::vector<std::string> kernelNames() {
    std::vector<std::string> names{"nearest", "trilinear", "catmull-rom", "b-spline",
                                   "hamming-sinc"};
    for (const char *family : {"ES", "KB", "LS"})
        for (int width = 2; width <= fourier::Kernel::largestWidth; ++width)
            names.push_back(family + std::to_string(width));
    return names;
}

void measureKernels(const Report &report, const Subject &subject, int views) {
    Measurement how;
    how.scene.camera = scene::defaultCamera(subject.field.values.lattice());
    how.transform = false;
    how.peers = true;
    Truth truth(subject, how.scene.camera, views);
    report(measure("kernels", "default " + subject.name, subject, truth, how));
    // A field of view whose folded roll-off tails hide no kernel's own error.
    how.scene.tolerance = 1e-6;
    for (const std::string &name : kernelNames()) {
        how.scene.interpolation.kernel = fourier::kernelFromName(name);
        for (const double padding : {1.0, 1.25, 1.5, 2.0}) {
            // The least-aliasing kernels need padding.
            if (padding == 1.0 &&
                how.scene.interpolation.kernel->family == fourier::KernelFamily::leastAliasing)
                continue;
            how.scene.interpolation.padding = padding;
            for (const auto storage : {fourier::Storage::binary16, fourier::Storage::float32}) {
                how.scene.interpolation.storage = storage;
                report(measure("kernels", subject.name, subject, truth, how));
            }
        }
    }
}

} // namespace

void runKernelsSuite(const Report &report, const Subject *given) {
    if (given != nullptr) {
        measureKernels(report, *given, 2);
        return;
    }
    using phantom::Kind;
    measureKernels(report, noiseSphere(64), 5);
    measureKernels(
        report, phantomSubject("head 64", Kind::head, {.size = volume::GridSize{64, 64, 64}}), 5);
    measureKernels(report,
                   phantomSubject("chest cut by the scan 64", Kind::chest,
                                  {.size = volume::GridSize{64, 64, 64}}),
                   5);
}

} // namespace pellucid::bench
