// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "app/bench/measure.h"

namespace pellucid {

namespace {

std::string nameOf(const testing::TestParamInfo<std::size_t> &info) {
    std::string name = bench::hardSubjects()[info.param].name;
    for (char &c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0)
            c = '_';
    return name;
}

class HardCase : public testing::TestWithParam<std::size_t> {};

// On fields that break projectors, a plan keeps every tolerance that it accepts, and its prediction
// bounds every view of the whole.
TEST_P(HardCase, KeepsTheToleranceItAccepts) {
    const auto &hard = bench::hardSubjects()[GetParam()];
    const bench::Subject subject{hard.name, hard.make()};
    bench::Measurement how;
    how.scene.camera = scene::defaultCamera(subject.field.values.lattice());
    how.views = 1;
    how.transform = false;
    bench::Truth truth(subject, how.scene.camera, 4);
    int accepted = 0;
    for (const bool isUniform : {false, true})
        for (const double tolerance : {1e-2, 1.1e-3, 1e-4, 1e-5}) {
            how.scene.tolerance = tolerance;
            how.scene.interpolation.isUniform = isUniform;
            const bench::Row row = bench::measure("test", subject.name, subject, truth, how);
            SCOPED_TRACE(fmt::format("{}{:.2g}", isUniform ? "uniform, " : "", tolerance));
            if (*row.predictedError <= tolerance) {
                EXPECT_LE(*row.relativeL2, tolerance);
                ++accepted;
            }
            EXPECT_LE(*row.relativeL2, *row.predictedError);
            // The bound holds for every view, and is not far from this one. Where widths spend what
            // it leaves, the error is closer, down to the rounding of floats. An empty field's
            // image is empty.
            constexpr double rounding = std::numeric_limits<float>::epsilon();
            if (*row.relativeL2 > 0.0)
                EXPECT_LE(*row.predictedError,
                          (isUniform ? 200.0 : 100.0) * std::max(rounding, *row.relativeL2));
        }
    EXPECT_GT(accepted, 0);
}

INSTANTIATE_TEST_SUITE_P(Fields, HardCase,
                         testing::Range(std::size_t(0), bench::hardSubjects().size()), nameOf);

} // namespace
} // namespace pellucid
