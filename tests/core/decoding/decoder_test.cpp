// SPDX-License-Identifier: GPL-3.0-or-later
// The decoder's process is confined: a file that takes it over costs only itself.
#include "core/decoding/client/decoder.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "core/decoding/client/channel.h"
#include "core/decoding/client/child.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/dicom/write_series.h"
#include "core/phantom/phantom.h"
#include "core/platform/confinement.h"
#include "core/task/error.h"
#include "tests/support/files.h"
#include "tests/support/misbehaving_acts.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::decoding {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::AllOf, testing::HasSubstr, testing::Not;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class TakenOver : public testing::Test {
protected:
    fs::path file(const std::string &word) const {
        test::writeText(m_folder / word, std::string(128, '\0') + "DICM" + word);
        return m_folder / word;
    }
    std::string answerTo(const std::string &word) {
        try {
            m_decoder.header(file(word));
        } catch (const task::Error &error) {
            EXPECT_EQ(error.path(), m_folder / word);
            return error.reason().english();
        }
        return "a header";
    }

    test::TemporaryFolder m_folder;
    Decoder m_decoder{PELLUCID_MISBEHAVING_DECODER};
};

} // namespace

TEST(Decoder, isConfinedHere) {
    if (!test::systemConfines())
        GTEST_SKIP() << "Wine reports no limits to a process";
    EXPECT_EQ(Decoder::shared().confinement() & (platform::limitsHold | platform::callsAreFiltered),
              platform::limitsHold | platform::callsAreFiltered);
}

TEST(Decoder, aMissingProgramIsNamed) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "a.dcm", std::string(128, '\0') + "DICM");
    Decoder none(folder / "pellucid-decode");
    try {
        none.header(folder / "a.dcm");
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::internal);
        EXPECT_THAT(error.what(), HasSubstr("cannot be started"));
    }
}

// A mix of old and new pixels would look like a picture.
TEST(Decoder, aFileThatChangesWhileItIsReadIsRefused) {
    const test::TemporaryFolder folder;
    const auto lattice = volume::Lattice::centred({2048, 2048, 1}, {1, 1, 1});
    std::vector<std::int16_t> noise(lattice.size().count());
    std::uint32_t state = 1;
    for (std::int16_t &value : noise)
        value = std::int16_t((state = state * 1664525U + 1013904223U) >> 20);
    dicom::writeCtSeries(folder.path(),
                         volume::Volume(lattice, std::move(noise), volume::ValueUnit::hounsfield),
                         {}, dicom::TransferSyntax::jpeg2000);
    const fs::path path = folder / "IM0001.dcm";
    EXPECT_NO_THROW(Decoder::shared().image(path));
    std::jthread writer([&](const std::stop_token &stop) { // decoding takes most of a second
        while (!stop.stop_requested()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).put('\0');
        }
    });
    try {
        Decoder::shared().image(path);
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.reason(), task::because::changedWhileRead);
        EXPECT_EQ(error.path(), path);
    }
}

TEST(Decoder, pipesAndDevicesAreRefusedAtOnce) {
    const test::TemporaryFolder folder;
    if (std::system(("mkfifo " + (folder / "pipe").string()).c_str()) != 0)
        GTEST_SKIP() << "this system has no pipes among files";
    for (const fs::path &path : {folder / "pipe", fs::path("/dev/zero"), folder.path()})
        EXPECT_THROW(Decoder::shared().header(path), task::Error) << path;
}

TEST_F(TakenOver, itReachesNothing) {
    if (!test::systemConfines())
        GTEST_SKIP() << "Wine gives every program the user's rights";
    std::ofstream("kept") << "kept";
    for (const auto &[word, answer] : test::forbiddenActs())
        EXPECT_THAT(answerTo(word), AllOf(HasSubstr(answer), Not("went through"))) << word;
    EXPECT_TRUE(fs::remove("kept"));
    EXPECT_FALSE(fs::exists("pwned"));
}

TEST_F(TakenOver, aCrashCostsOneFile) {
    EXPECT_THAT(answerTo("crash"), HasSubstr("the decoder crashed"));
    EXPECT_THAT(answerTo("silence"), HasSubstr("the decoder crashed"));
    EXPECT_THAT(answerTo("killed"), HasSubstr("because memory ran out"));
    EXPECT_EQ(answerTo("well"), "decoded by hand");
    EXPECT_EQ(answerTo("well"), "decoded by hand");
}

TEST_F(TakenOver, itsAnswersAreValidated) {
    for (const char *const word :
         {"large-body", "large-data", "other-kind", "short-message", "empty-header", "no-reason",
          "plain-reason", "cut-reason", "other-reason", "long-reason", "deep-reason", "flood"})
        EXPECT_EQ(answerTo(word), "was decoded to implausible data") << word;
    EXPECT_EQ(answerTo("ask-for-all"), "refused");
    EXPECT_EQ(answerTo("well"), "decoded by hand");
}

// The sum of what several ask for must not wrap, whatever each asks for and whenever.
TEST_F(TakenOver, severalTogetherGetNoMoreMemory) {
    constexpr int threads = 8, rounds = 200;
    std::array<std::atomic<int>, 3> answers{}; // refused, granted, others
    const std::array<fs::path, 2> files{file("ask-beyond-the-end"), file("ask-to-the-end")};
    {
        std::vector<std::jthread> all;
        for (int n = 0; n < threads; ++n)
            all.emplace_back([&, path = files[std::size_t(n) % 2]] {
                for (int round = 0; round < rounds; ++round)
                    try {
                        m_decoder.header(path);
                        ++answers[2];
                    } catch (const task::Error &error) {
                        const std::string answer = error.reason().english();
                        ++answers[answer == "refused" ? 0 : answer == "granted" ? 1 : 2];
                    }
            });
    }
    EXPECT_EQ(answers[0], threads * rounds);
    EXPECT_EQ(answers[1], 0);
    EXPECT_EQ(answers[2], 0);
    // What was refused is not counted: an honest decoder gets memory.
    const test::TemporaryFolder folder;
    const auto lattice = volume::Lattice::centred({1024, 1024, 1}, {1, 1, 1});
    dicom::writeCtSeries(folder.path(),
                         volume::Volume(lattice, std::vector<std::int16_t>(lattice.size().count()),
                                        volume::ValueUnit::hounsfield),
                         {}, dicom::TransferSyntax::explicitLittle);
    EXPECT_NO_THROW(Decoder::shared().image(folder / "IM0001.dcm"));
}

TEST_F(TakenOver, aRefusalIsOfTwoKinds) {
    const std::map<std::string, task::ErrorCode> words{{"well", task::ErrorCode::unusable},
                                                       {"lack", task::ErrorCode::outOfMemory},
                                                       {"other-code", task::ErrorCode::unusable}};
    for (const auto &[word, code] : words)
        try {
            m_decoder.header(file(word));
            ADD_FAILURE() << word;
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), code) << word;
            EXPECT_EQ(error.reason().english(), "decoded by hand") << word;
        }
}

TEST_F(TakenOver, itsSamplesAreCounted) {
    const SampleRange wanted{4096, 2, false, false, false};
    const std::map<std::string, std::uint64_t> lies{
        {"more-samples", 0},  {"half-a-sample", 0},    {"no-samples", 0},
        {"fewer-samples", 0}, {"samples-twice", 4096}, {"half-the-samples", 2048}};
    for (const auto &[word, believed] : lies) {
        std::uint64_t taken = 0;
        try {
            m_decoder.samples(file(word), wanted,
                              [&](std::span<const std::byte> part) { taken += part.size(); });
            ADD_FAILURE() << word;
        } catch (const task::Error &error) {
            EXPECT_EQ(error.reason(), task::because::implausibleAnswer) << word;
            EXPECT_EQ(error.path(), m_folder / word);
        }
        EXPECT_EQ(taken, believed) << word;
    }
    EXPECT_EQ(answerTo("well"), "decoded by hand");
}

#ifndef PELLUCID_SANITIZED
TEST_F(TakenOver, itsMemoryIsLimited) {
    if (!test::systemConfines())
        GTEST_SKIP() << "Wine lets a process have more memory than its job";
    const std::string had = answerTo("memory");
    ASSERT_THAT(had, HasSubstr("had "));
    EXPECT_LT(std::atoi(had.c_str() + 4), 1000);
}
#endif

TEST_F(TakenOver, cancellingDoesNotWaitForIt) {
    const fs::path hanging = file("hang");
    std::stop_source stop;
    std::jthread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        stop.request_stop();
    });
    const auto start = Clock::now();
    EXPECT_THROW(m_decoder.header(hanging, task::Progress(stop.get_token())), task::Cancelled);
    EXPECT_LT(secondsSince(start), 2.0); // 20 seconds are allowed to decode
    EXPECT_EQ(answerTo("well"), "decoded by hand");
}

// A decoder that never answers is ended by its own clock, or by ours if it has stopped that one.
TEST_F(TakenOver, aHangIsEndedByTheClock) {
    if (std::getenv("PELLUCID_LONG_TESTS") == nullptr)
        GTEST_SKIP() << "takes twenty seconds, with the long tests";
    const double own = decodingSeconds({Message::Kind::header, 0, 0, 0}),
                 ours = waitingSeconds({Message::Kind::header, 0, 0, 0});
    std::array<double, 2> seconds{};
    {
        std::vector<std::jthread> both;
        for (const std::size_t n : {0U, 1U}) {
            const fs::path path = file(n == 0 ? "dawdle" : "hang");
            both.emplace_back([&, n, path] {
                const auto start = Clock::now();
                try {
                    m_decoder.header(path);
                    ADD_FAILURE() << path << " was read";
                } catch (const task::Error &error) {
                    EXPECT_EQ(error.reason(), task::because::takesTooLong);
                }
                seconds[n] = secondsSince(start);
            });
        }
    }
    EXPECT_GT(seconds[0], own - 1.0);
    EXPECT_LT(seconds[0], ours - 0.5); // not ours: two programs share the processor with others
    EXPECT_GE(seconds[1], ours);
    EXPECT_LT(seconds[1], ours + 6.0);
    EXPECT_EQ(answerTo("well"), "decoded by hand");
}

// The slice that takes over the decoder is named; the others form a volume.
TEST_F(TakenOver, aSeriesLosesOneSlice) {
    const auto lattice =
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{32, 32, 20}});
    dicom::writeCtSeries(m_folder / "series", phantom::makePhantom(phantom::Kind::head, lattice),
                         {}, dicom::TransferSyntax::explicitLittle);
    // Sequences nested until the stack would overflow.
    std::string nested = test::readText(m_folder / "series/IM0007.dcm").substr(0, 132);
    nested += std::string("\x02\0\x10\0UI\x14\0"
                          "1.2.840.10008.1.2.1\0",
                          28);
    for (int n = 0; n < 200000; ++n)
        nested +=
            std::string("\x08\0\x40\x11SQ\0\0\xFF\xFF\xFF\xFF\xFE\xFF\0\xE0\xFF\xFF\xFF\xFF", 20);
    test::writeText(m_folder / "series/deep.dcm", nested);
    const auto catalogue = dicom::scan({m_folder / "series"});
    ASSERT_EQ(catalogue.skipped.size(), 1U);
    EXPECT_EQ(catalogue.skipped[0].path, m_folder / "series/deep.dcm");
    EXPECT_EQ(catalogue.skipped[0].reason, task::because::isNestedTooDeeply);
    EXPECT_EQ(dicom::defaultSelection(catalogue).volume->geometry.lattice.size().k, 20);
}

// Decoding in another process gives the same samples as in this one.
TEST(Decoder, givesTheSameSamples) {
    const auto lattice =
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{96, 64, 3}});
    const auto volume = phantom::makePhantom(phantom::Kind::head, lattice);
    for (const auto syntax : {dicom::TransferSyntax::explicitLittle,
                              dicom::TransferSyntax::jpeg2000, dicom::TransferSyntax::rle}) {
        const test::TemporaryFolder folder;
        dicom::writeCtSeries(folder.path(), volume, {}, syntax);
        const fs::path path = folder / "IM0002.dcm";
        const DecodedImage here = decoding::process::decodeImage(test::readBytes(path));
        const DecodedFile there = Decoder::shared().image(path);
        EXPECT_TRUE(std::equal(here.samples.begin(), here.samples.end(), there.samples.begin(),
                               there.samples.end()));
        EXPECT_EQ(pack(here.header), pack(there.header));
    }
}

// The other process costs little of a series' load, cold decoders included. The figures are
// printed; the bound leaves room for a busy machine.
TEST(Decoder, costsLittleOfALoad) {
    const bool isLong = std::getenv("PELLUCID_LONG_TESTS") != nullptr;
    const int slices = isLong ? 300 : 40;
    const auto lattice =
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{512, 512, slices}});
    const auto volume = phantom::makePhantom(phantom::Kind::head, lattice);
    for (const auto syntax :
         {dicom::TransferSyntax::explicitLittle, dicom::TransferSyntax::jpegLs}) {
        const test::TemporaryFolder folder;
        dicom::writeCtSeries(folder.path(), volume, {}, syntax);
        std::vector<fs::path> files;
        for (const auto &entry : fs::directory_iterator(folder.path()))
            files.push_back(entry.path());
        const auto seconds = [&](const auto &work) {
            const auto start = Clock::now();
            tbb::parallel_for(std::size_t(0), files.size(), [&](std::size_t n) { work(files[n]); });
            return secondsSince(start);
        };
        std::vector<double> here, there, whole, starts;
        for (int round = 0; round < 5; ++round) {
            here.push_back(seconds([](const fs::path &path) {
                const auto bytes = test::readBytes(path);
                decoding::process::parseHeader(bytes);
                decoding::process::decodeImage(bytes);
            }));
            Decoder cold(PELLUCID_DECODE);
            there.push_back(seconds([&](const fs::path &path) {
                cold.header(path);
                cold.image(path);
            }));
            const auto before = Clock::now();
            Decoder(PELLUCID_DECODE).header(files.front());
            starts.push_back(secondsSince(before));
            const auto start = Clock::now();
            const auto catalogue = dicom::scan({folder.path()});
            dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
            whole.push_back(secondsSince(start));
        }
        const auto median = [](std::vector<double> v) {
            std::nth_element(v.begin(), v.begin() + 2, v.end());
            return v[2];
        };
        const double more = median(there) - median(here);
        // A decoder is started once for all slices, so only a long load has to pay for it.
        const double start = median(starts);
        std::cout << slices << " slices: start " << 1e3 * start << " ms, here "
                  << 1e3 * median(here) << " ms, confined " << 1e3 * median(there)
                  << " ms, whole load " << 1e3 * median(whole) << " ms; isolation is "
                  << 100.0 * more / (median(whole) - more) << " % of a load without it\n";
        if (isLong)
            EXPECT_LT(more, 0.25 * median(whole));
        else
            EXPECT_LT(more - start, 0.4 * median(whole));
    }
}

} // namespace pellucid::decoding
