// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/bench/look_rows.h"

namespace pellucid::bench {

namespace {

// What Cheng 2007 measured on platform A (Sempron 2800+ 1.6 GHz, Radeon Xpress 200) and platform B
// (Pentium 4 3.0 GHz, Radeon X850 Pro).
struct Times {
    double preparationSeconds = 0.0, framesPerSecond = 0.0; ///< 0: not given
};
struct Published {
    const char *table;
    volume::GridSize size;
    const char *kernel;
    double padding;
    Times b, a;
};

// The thesis's cubic filter, Catmull-Rom of trilinear samples: not Keys' of the reconstruction.
constexpr const char *cubicName = "4.3 cubic of trilinear samples";

const std::vector<Published> &publishedTables() {
    static const std::vector<Published> tables{
        {"4.1 no filter", {64, 64, 64}, "nearest", 1.0, {0.25, 100.0}, {0.813, 66.67}},
        {"4.1 no filter", {128, 128, 128}, "nearest", 1.0, {3.359, 66.67}, {8.015, 62.25}},
        {"4.1 no filter", {256, 256, 256}, "nearest", 1.0, {33.297, 32.25}, {104.407, 16.129}},
        {"4.2 trilinear", {64, 64, 64}, "trilinear", 1.0, {0.25, 66.67}, {0.704, 32.25}},
        {"4.2 trilinear", {128, 128, 128}, "trilinear", 1.0, {2.578, 62.5}, {7.656, 21.73}},
        {"4.2 trilinear", {256, 256, 256}, "trilinear", 1.0, {35.688, 21.27}, {111.266, 12.82}},
        {cubicName, {64, 64, 64}, "catmull-rom", 1.0, {0.25, 2.78}, {0.828, 2.67}},
        {cubicName, {128, 128, 128}, "catmull-rom", 1.0, {3.641, 2.66}, {7.485, 2.132}},
        {cubicName, {256, 256, 256}, "catmull-rom", 1.0, {37.984, 2.54}, {100.0, 1.27}},
        {"4.4 doubled domain", {64, 64, 64}, "trilinear", 2.0, {3.708, 66.67}, {7.594, 31.25}},
        {"4.4 doubled domain", {128, 128, 128}, "trilinear", 2.0, {35.031, 31.25}, {101.0, 12.82}},
        {"4.5 FFTW", {128, 128, 128}, "trilinear", 1.0, {0.0, 62.5}, {}},
        {"4.5 FFT on the card", {128, 128, 128}, "trilinear", 1.0, {0.0, 21.132}, {}},
        {"4.5 FFTW", {256, 256, 256}, "trilinear", 1.0, {0.0, 21.276}, {}},
        {"4.5 FFT on the card", {256, 256, 256}, "trilinear", 1.0, {0.0, 21.132}, {}},
        {"4.5 FFTW", {512, 512, 256}, "trilinear", 1.0, {0.0, 8.0}, {}},
        {"4.5 FFT on the card", {512, 512, 256}, "trilinear", 1.0, {0.0, 16.129}, {}}};
    return tables;
}

std::string timesText(const Times &times) {
    return fmt::format("{}{:.3g} frames/s",
                       times.preparationSeconds > 0.0
                           ? fmt::format("prepared in {:.3g} s, ", times.preparationSeconds)
                           : "",
                       times.framesPerSecond);
}

std::string publishedText(const Times &b, const Times &a) {
    std::string text = "published: B " + timesText(b);
    if (a.framesPerSecond > 0.0)
        text += "; A " + timesText(a);
    return text;
}

Subject headOf(const volume::GridSize &size) {
    return phantomSubject("head", phantom::Kind::head, {.size = size});
}

// Table 4.6: six basis volumes, a slice of each in every frame; and what the default makes of it.
void measureTransferFunction(const Report &report, int n, const Times &b, const Times &a) {
    LookSubject subject(n);
    classify::Look look;
    look.transferFunction.weights = {0.0, 0.5, 2.0, 1.0, 0.5, 2.0};
    const std::string published = publishedText(b, a);
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
        Truth truth(head, how.scene.camera,
                    published.size.i > 256   ? 1
                    : published.size.i > 128 ? 2
                                             : 4);
        how.scene.interpolation.kernel = fourier::kernelFromName(published.kernel);
        how.scene.interpolation.padding = published.padding;
        how.scene.interpolation.storage = fourier::Storage::float32;
        Row row = measure("thesis", published.table, head, truth, how);
        row.note = publishedText(published.b, published.a);
        report(row);
        if (published.size.i > last.i || published.size.k > last.k) {
            how.scene.interpolation = {};
            report(measure("thesis", "default, the same head", head, truth, how));
            last = published.size;
        }
    }
    measureTransferFunction(report, 64, {1.172, 9.174}, {4.234, 7.09});
    measureTransferFunction(report, 128, {26.375, 8.0}, {44.485, 7.09});
    // The preparation of B is a copying error of the source: see REFERENCES.md.
    measureTransferFunction(report, 256, {37.984, 0.57}, {640.016, 0.39});
}

} // namespace pellucid::bench
