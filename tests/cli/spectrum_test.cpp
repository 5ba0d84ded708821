// SPDX-License-Identifier: GPL-3.0-or-later
// The slice of the spectrum that a view takes, as a picture and as decibels.
#include "tests/cli/cli.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/classify/shown_fields.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/reference/wide_kernel.h"
#include "tests/support/files.h"

namespace pellucid {

namespace {

using namespace test;
using nlohmann::json;

classify::TissueClass standard(const std::string &name, double weight, const char *color) {
    classify::TissueClass tissue;
    for (const classify::TissueClass &one : classify::standardClasses())
        if (one.name == name)
            tissue = one;
    tissue.weight = weight;
    tissue.color = classify::colorFromText(color);
    return tissue;
}

// Thick slices of a tilted head, whose spectrum repeats itself within the band of the picture.
TEST_F(Cli, TheSpectrumHoldsTheDecibelsThatTheExactReferenceConfirms) {
    const fs::path series =
                       phantomFolder("--kind head --size 60x64x20 --spacing 4,3.8,12 --tilt 25"),
                   out = folder / "spectrum.npy";
    const auto catalogue = dicom::scan({series});
    const auto volume = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
    const auto window = classify::defaultFieldWindow(volume);
    const struct {
        std::string options;
        classify::Look look;
    } cases[] = {{"", {}},
                 {"--class bone", {{}, {standard("bone", 1.0, "#ffffff")}}},
                 {"--class bone=1:#ff8000 --class fat=0.5",
                  {{}, {standard("bone", 1.0, "#ff8000"), standard("fat", 0.5, "#ffffff")}}}};
    for (const auto &c : cases) {
        const auto r = cli("volume " + quoted(series) + " -o " + quoted(out) +
                           " --spectrum --json --view left --azimuth 20 --elevation 15 --size 30x48"
                           " --pixel-mm 4 --kernel KB7 --padding 2 --storage f32 " +
                           c.options);
        ASSERT_EQ(r.exitCode, 0) << r.error;
        int height = 0, width = 0;
        const auto decibels = readNpy(out, height, width);
        ASSERT_EQ(height, 48); // the longer side
        ASSERT_EQ(width, 48);
        const json report = json::parse(r.out);
        const double step = report["step_per_mm"];
        EXPECT_DOUBLE_EQ(step, 1.0 / (48 * 4.0));
        EXPECT_DOUBLE_EQ(report["limit_per_mm"].get<double>(), 0.125);
        EXPECT_EQ(report["plan"]["kernel"], "KB7");
        // The truth at the same frequencies: the mean of red, green and blue where there are three.
        const glm::dmat3 axes =
            glm::mat3_cast(scene::viewOrientation(scene::StandardView::left, {20.0, 15.0, 0.0}));
        std::vector<glm::dvec3> frequencies{glm::dvec3(0.0)};
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column)
                frequencies.push_back(step *
                                      (double(column - 24) * axes[0] - double(row - 24) * axes[1]));
        std::vector<std::complex<double>> truth(frequencies.size()), one(frequencies.size());
        const auto fields = classify::shownFields(volume, window, c.look, nullptr);
        for (std::size_t channel = 0; channel < fields.channels.size(); ++channel) {
            const auto &field = fields.channels[channel];
            const classify::Color &color = fields.colors[channel];
            reference::WideKernel(field.values, field.support).sample(frequencies, one);
            for (std::size_t n = 0; n < one.size(); ++n)
                truth[n] += (color.red + color.green + color.blue) * one[n];
        }
        int compared = 0;
        for (std::size_t n = 0; n < decibels.size(); ++n) {
            const double ratio = std::abs(truth[n + 1]) / std::abs(truth[0]);
            if (ratio < 1e-3)
                continue;
            ++compared;
            // 8.7 dB for a factor of e; the kernel and floats leave 1e-6 of what the field sums to.
            ASSERT_NEAR(decibels[n], 20.0 * std::log10(ratio), 8.7e-6 / ratio + 1e-5)
                << c.options << " " << n;
        }
        EXPECT_GT(compared, 300) << c.options;
    }
}

TEST_F(Cli, TheSpectrumPictureHasTheReportedSize) {
    const fs::path series = phantomFolder("--kind head --size 32x32x32"), out = folder / "s.png";
    const auto r = cli("volume " + quoted(series) + " -o " + quoted(out) +
                       " --spectrum --edges --size 40x40 --json");
    ASSERT_EQ(r.exitCode, 0) << r.error;
    EXPECT_EQ(json::parse(r.out)["size"], json({40, 40}));
    EXPECT_EQ(json::parse(r.out)["black_decibels"], -100.0);
    const std::string png = test::readText(out);
    ASSERT_GT(png.size(), 24U);
    EXPECT_EQ(png[19], 40); // width and height of the header
    EXPECT_EQ(png[23], 40);
}

TEST_F(Cli, OptionsThatASpectrumCannotTakeAreRefused) {
    const fs::path series = phantomFolder("--kind head --size 16x16x16");
    const auto refused = [&](const char *out, const std::string &options, int code,
                             const std::string &part) {
        const fs::path path = folder / out;
        expectOneLine(cli("volume " + quoted(series) + " -o " + quoted(path) + " " + options), code,
                      part);
        EXPECT_FALSE(fs::exists(path)) << options;
    };
    refused("o.nrrd", "--spectrum", 2, "must end in .png or .npy with --spectrum");
    refused("o.png", "--spectrum --light 1,0,0", 2, "--light: --spectrum shows the fields without");
    refused("o.png", "--spectrum --depth-cue linear:1", 2, "--depth-cue: --spectrum shows");
    refused("o.png", "--spectrum --field", 2, "--field");
    refused("o.png", "--spectrum --gzip", 2, "--gzip");
    refused("o.png", "--spectrum --edges --class bone=1", 2, "--edges");
    refused("o.nrrd", "--view left", 2, "--spectrum");
    refused("o.nrrd", "--json", 2, "--spectrum");
    refused("o.nrrd", "--class bone --class fat", 2, "only one class can be written");
    // No part of the head is that dense.
    refused("o.png", "--spectrum --window 20000,30000", 3, "the field is empty");
}

} // namespace

} // namespace pellucid
