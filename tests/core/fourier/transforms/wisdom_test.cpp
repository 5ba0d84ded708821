// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <complex>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "core/fourier/transforms/transform.h"
#include "core/fourier/transforms/wisdom.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

std::string contents(const std::filesystem::path &file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// A run of the program: plans one length, with the file's wisdom; true if all went well.
bool planInAnotherProcess(const std::filesystem::path &file) {
    const pid_t child = fork();
    if (child == 0) {
        fourier::keepWisdomIn(file);
        const fourier::ForwardTransform1d transform(96);
        alignas(64) float in[96] = {1.0F};
        alignas(64) std::complex<float> out[49];
        transform.run(in, out);
        for (const auto &value : out)
            if (std::abs(value - std::complex<float>(1.0F)) > 1e-6F)
                _exit(1);
        _exit(0);
    }
    int status = 1;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Wisdom, IsKeptFromRunToRun) {
    const test::TemporaryFolder folder;
    const auto file = folder / "wisdom";
    ASSERT_TRUE(planInAnotherProcess(file));
    const std::string first = contents(file);
    EXPECT_NE(first.find("fftwf_wisdom"), std::string::npos);
    // Known plans are not measured again, so nothing is written: the file keeps its time.
    const auto written = std::filesystem::last_write_time(file);
    ASSERT_TRUE(planInAnotherProcess(file));
    EXPECT_EQ(std::filesystem::last_write_time(file), written);
}

TEST(Wisdom, BrokenForeignAndUnwritableFilesAreIgnored) {
    const test::TemporaryFolder folder;
    const auto file = folder / "wisdom";
    ASSERT_TRUE(planInAnotherProcess(file));
    const std::string good = contents(file);
    std::string foreign = good;
    foreign.replace(foreign.find("fftw-3"), 6, "fftw-9");
    for (const std::string &bad : {std::string("garbage"), good.substr(0, good.size() / 2), foreign,
                                   std::string(100, '\0')}) {
        std::ofstream(file, std::ios::binary) << bad;
        EXPECT_TRUE(planInAnotherProcess(file));
        EXPECT_NE(contents(file), bad); // replaced by what was measured
    }
    EXPECT_TRUE(planInAnotherProcess(folder / "no such folder" / "wisdom"));
    EXPECT_TRUE(planInAnotherProcess(folder.path())); // a folder where the file should be
}

} // namespace
} // namespace pellucid
