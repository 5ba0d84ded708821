// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/bench/look_rows.h"

namespace pellucid::bench {

namespace {

// What Cheng 2007 measured on platform B (Pentium 4 3.0 GHz and its graphics card).
struct Published {
    const char *table;
    volume::GridSize size;
    const char *kernel;
    double padding;
    double preparationSeconds; ///< 0: not given
    double framesPerSecond;
};

constexpr double notGiven = 0.0;

const std::vector<Published> &publishedTables() {
    static const std::vector<Published> tables{
        {"4.1 no filter", {64, 64, 64}, "nearest", 1.0, 0.25, 100.0},
        {"4.1 no filter", {128, 128, 128}, "nearest", 1.0, 3.359, 66.67},
        {"4.1 no filter", {256, 256, 256}, "nearest", 1.0, 33.297, 32.25},
        {"4.2 trilinear", {64, 64, 64}, "trilinear", 1.0, 0.25, 66.67},
        {"4.2 trilinear", {128, 128, 128}, "trilinear", 1.0, 2.578, 62.5},
        {"4.2 trilinear", {256, 256, 256}, "trilinear", 1.0, 35.688, 21.27},
        {"4.3 cubic", {64, 64, 64}, "catmull-rom", 1.0, 0.25, 2.78},
        {"4.3 cubic", {128, 128, 128}, "catmull-rom", 1.0, 3.641, 2.66},
        {"4.3 cubic", {256, 256, 256}, "catmull-rom", 1.0, 37.984, 2.54},
        {"4.4 doubled domain", {64, 64, 64}, "trilinear", 2.0, 3.708, 66.67},
        {"4.4 doubled domain", {128, 128, 128}, "trilinear", 2.0, 35.031, 31.25},
        {"4.5 FFT", {128, 128, 128}, "trilinear", 1.0, notGiven, 62.5},
        {"4.5 FFT", {256, 256, 256}, "trilinear", 1.0, notGiven, 21.276},
        {"4.5 FFT", {512, 512, 256}, "trilinear", 1.0, notGiven, 16.129}};
    return tables;
}

std::string publishedText(double seconds, double framesPerSecond) {
    return fmt::format("published: {}{:.3g} frames/s",
                       seconds > 0.0 ? fmt::format("prepared in {:.3g} s, ", seconds) : "",
                       framesPerSecond);
}

Subject headOf(const volume::GridSize &size) {
    return phantomSubject("head", phantom::Kind::head, {.size = size});
}

// Table 4.6: six basis volumes, a slice of each in every frame; and what the default makes of it.
void measureTransferFunction(const Report &report, int n, double seconds, double framesPerSecond) {
    LookSubject subject(n);
    classify::Look look;
    look.transferFunction.weights = {0.0, 0.5, 2.0, 1.0, 0.5, 2.0};
    const std::string published = publishedText(seconds, framesPerSecond);
    reportLook(report, "thesis", "default six points", subject, look, published);
    subject.scene.interpolation.kernel = fourier::kernelFromName("trilinear");
    subject.scene.interpolation.padding = 1.0;
    reportLook(report, "thesis", "4.6 six points", subject, look, published);
}

} // namespace

void runThesisSuite(const Report &report) {
    volume::GridSize last{0, 0, 0};
    for (const Published &published : publishedTables()) {
        const Subject head = headOf(published.size);
        Measurement how;
        how.scene.camera = squareCamera(head.field.values.lattice(), published.size.i);
        how.transform = false;
        how.peers = true;
        Truth truth(head, how.scene.camera, published.size.i > 128 ? 1 : 3);
        how.scene.interpolation.kernel = fourier::kernelFromName(published.kernel);
        how.scene.interpolation.padding = published.padding;
        how.scene.interpolation.storage = fourier::Storage::float32;
        Row row = measure("thesis", published.table, head, truth, how);
        row.note = publishedText(published.preparationSeconds, published.framesPerSecond);
        report(row);
        if (published.size.i > last.i || published.size.k > last.k) {
            how.scene.interpolation = {};
            report(measure("thesis", "default, the same head", head, truth, how));
            last = published.size;
        }
    }
    measureTransferFunction(report, 64, 1.172, 9.174);
    measureTransferFunction(report, 128, 26.375, 8.0);
    measureTransferFunction(report, 256, 37.984, 0.57);
}

} // namespace pellucid::bench
