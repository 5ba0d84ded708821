// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/body.h"
#include "core/preprocess/filters.h"
#include "core/preprocess/morphology.h"
#include "core/preprocess/parts.h"
#include "core/preprocess/study_content.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "core/phantom/phantom.h"
#include "tests/support/fields.h"

namespace pellucid {
namespace {

using preprocess::Mask;

std::size_t count(const Mask &mask) {
    return std::size_t(std::accumulate(mask.begin(), mask.end(), std::size_t(0)));
}

template <class F> Mask maskOf(const volume::Lattice &lattice, const F &isIn) {
    Mask mask;
    const volume::GridSize n = lattice.size();
    for (int k = 0; k < n.k; ++k)
        for (int j = 0; j < n.j; ++j)
            for (int i = 0; i < n.i; ++i)
                mask.push_back(isIn(lattice.patient(volume::VoxelIndex{i, j, k}).mm));
    return mask;
}

volume::Volume impulse(const volume::Lattice &lattice) {
    std::vector<float> samples(lattice.size().count(), 0.0F);
    const volume::GridSize n = lattice.size();
    samples[(std::size_t(n.k / 2) * n.j + n.j / 2) * n.i + n.i / 2] = 1.0F;
    return {lattice, std::move(samples), volume::ValueUnit::none};
}

TEST(Gaussian, HasItsVarianceInMillimetresAlongEveryAxis) {
    const auto lattice = volume::Lattice::centred({41, 41, 21}, {0.7, 0.7, 2.5});
    const auto smooth = preprocess::gaussian(impulse(lattice), 1.5);
    glm::dvec3 square(0.0);
    double mass = 0.0;
    smooth.visit([&](auto samples) {
        for (std::size_t n = 0; n < samples.size(); ++n) {
            const int i = int(n % 41), j = int(n / 41 % 41), k = int(n / 1681);
            const glm::dvec3 d((i - 20) * 0.7, (j - 20) * 0.7, (k - 10) * 2.5);
            mass += double(samples[n]);
            square += double(samples[n]) * d * d;
        }
    });
    EXPECT_NEAR(mass, 1.0, 1e-5);
    // The discrete Gaussian has the variance asked for; its tails are cut at one in a hundred.
    for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(square[d] / mass, 1.5 * 1.5, 0.08 * 1.5 * 1.5);
}

TEST(Median, RemovesASpeckAndLeavesThickSlicesApart) {
    const auto lattice = volume::Lattice::centred({9, 9, 5}, {0.8, 0.8, 5.0});
    EXPECT_EQ(preprocess::median(impulse(lattice), 1.0).value({4, 4, 2}), 0.0);
    // A slice of ones: the median of one millimetre does not look into its neighbours.
    std::vector<float> samples(lattice.size().count(), 0.0F);
    std::fill(samples.begin() + 2 * 81, samples.begin() + 3 * 81, 1.0F);
    const volume::Volume slice(lattice, samples, volume::ValueUnit::none);
    const auto result = preprocess::median(slice, 1.0);
    EXPECT_EQ(result.value({4, 4, 2}), 1.0);
    EXPECT_EQ(result.value({4, 4, 1}), 0.0);
}

TEST(Diffusion, SmoothsNoiseAndKeepsAStep) {
    const auto noise = test::noiseField(volume::Lattice::centred({24, 24, 24}, {1, 1, 1}));
    std::vector<float> samples;
    for (int n = 0; n < 24 * 24 * 24; ++n)
        samples.push_back(float((n % 24 >= 12 ? 100.0 : 0.0) +
                                4.0 * noise.values.value({n % 24, n / 24 % 24, n / 576})));
    const volume::Volume volume(noise.values.lattice(), samples, volume::ValueUnit::none);
    const auto smooth = preprocess::diffusion(volume, 8, 1.0);
    const auto spread = [](const volume::Volume &v) {
        double sum = 0.0, square = 0.0;
        for (int n = 0; n < 512; ++n) {
            const double value = v.value({2 + n % 8, 8 + n / 8 % 8, 8 + n / 64});
            sum += value;
            square += value * value;
        }
        return std::sqrt(square / 512 - sum * sum / 512 / 512);
    };
    EXPECT_LT(spread(smooth), 0.7 * spread(volume));
    EXPECT_GT(smooth.value({12, 12, 12}) - smooth.value({11, 12, 12}), 80.0);
}

TEST(Filters, NansDoNotSpread) {
    auto lattice = volume::Lattice::centred({9, 9, 9}, {1, 1, 1});
    std::vector<float> samples(729, 1.0F);
    samples[0] = std::numeric_limits<float>::quiet_NaN();
    samples[1] = std::numeric_limits<float>::infinity();
    const volume::Volume volume(lattice, samples, volume::ValueUnit::none);
    for (const auto &result : {preprocess::gaussian(volume, 1.0), preprocess::median(volume, 1.0),
                               preprocess::diffusion(volume, 2, 1.0)}) {
        result.visit([](auto values) {
            for (const auto value : values)
                EXPECT_TRUE(std::isfinite(value));
        });
        // Far from them nothing changes: a Gaussian of one millimetre ends after four.
        EXPECT_NEAR(result.value({8, 8, 8}), 1.0, 1e-5);
    }
}

TEST(Morphology, OpeningKeepsWhatABallFitsIntoAndRemovesThinPlates) {
    const auto lattice = volume::Lattice::centred({60, 60, 24}, {0.5, 0.5, 1.5});
    const auto isBall = [](glm::dvec3 p) { return glm::length(p - glm::dvec3(0, 3, 0)) < 7.0; };
    const auto isPlate = [](glm::dvec3 p) { return std::abs(p.y + 10.0) < 1.1; };
    const Mask mask = maskOf(lattice, [&](glm::dvec3 p) { return isBall(p) || isPlate(p); });
    const Mask opened = preprocess::opening(lattice, mask, 3.0);
    const Mask ball = maskOf(lattice, isBall), plate = maskOf(lattice, isPlate);
    std::size_t ofBall = 0, ofPlate = 0;
    for (std::size_t n = 0; n < mask.size(); ++n) {
        EXPECT_LE(opened[n], mask[n]); // opening only removes
        ofBall += opened[n] & ball[n];
        ofPlate += opened[n] & plate[n];
    }
    // Balls of samples are rounded by the lattice: a part of the rind is lost.
    EXPECT_GT(ofBall, count(ball) * 9 / 10);
    EXPECT_EQ(ofPlate, 0U);
}

TEST(Morphology, ClosingFillsGapsAndOnlyAdds) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1});
    const Mask mask = maskOf(lattice, [](glm::dvec3 p) {
        return glm::length(p) < 15.0 && glm::length(p - glm::dvec3(2, 0, 0)) > 2.6;
    });
    const Mask closed = preprocess::closing(lattice, mask, 4.0);
    for (std::size_t n = 0; n < mask.size(); ++n)
        EXPECT_GE(closed[n], mask[n]);
    EXPECT_EQ(closed[(std::size_t(20) * 40 + 20) * 40 + 22], 1);
    EXPECT_EQ(closed[0], 0);
    // Nothing and everything stay what they are.
    const Mask nothing(mask.size(), 0), all(mask.size(), 1);
    EXPECT_EQ(preprocess::opening(lattice, nothing, 2.0), nothing);
    EXPECT_EQ(preprocess::closing(lattice, all, 2.0), all);
}

TEST(LargestPart, IsTheOneWithMostSamples) {
    const auto lattice = volume::Lattice::centred({30, 20, 20}, {1, 1, 1});
    const auto small = [](glm::dvec3 p) { return glm::length(p - glm::dvec3(-8, 0, 0)) < 3.0; };
    const auto large = [](glm::dvec3 p) { return glm::length(p - glm::dvec3(6, 0, 0)) < 5.0; };
    const Mask mask = maskOf(lattice, [&](glm::dvec3 p) { return small(p) || large(p); });
    EXPECT_EQ(preprocess::largestPart(lattice, mask), maskOf(lattice, large));
    const Mask nothing(mask.size(), 0);
    EXPECT_EQ(preprocess::largestPart(lattice, nothing), nothing);
}

// The head phantom on a couch: a shell of plastic below it.
TEST(Body, IsThePatientWithoutTheCouchAndWithTheAirInside) {
    const auto head = phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{80, 80, 40}}));
    std::vector<std::int16_t> samples(head.lattice().size().count());
    for (int n = 0; n < int(samples.size()); ++n) {
        const int i = n % 80, j = n / 80 % 80, k = n / 6400;
        samples[std::size_t(n)] = std::int16_t(head.value({i, j, k}));
    }
    const auto at = [](int i, int j, int k) { return (std::size_t(k) * 80 + j) * 80 + i; };
    for (int k = 0; k < 40; ++k)
        for (int i = 0; i < 80; ++i)
            samples[at(i, 78, k)] = 50;
    const volume::Volume volume(head.lattice(), samples, volume::ValueUnit::hounsfield);
    const Mask body = preprocess::body(volume, 0.0);
    for (int k = 0; k < 40; ++k)
        EXPECT_EQ(body[at(40, 78, k)], 0) << k;
    EXPECT_EQ(body[at(40, 40, 20)], 1);
    EXPECT_EQ(body[at(1, 1, 20)], 0);
    std::size_t tissue = 0, missed = 0;
    for (std::size_t n = 0; n < samples.size(); ++n) {
        const bool isTissue = samples[n] > -300 && n / 80 % 80 < 76;
        tissue += isTissue;
        missed += isTissue && body[n] == 0;
    }
    EXPECT_LT(missed, tissue / 50);
}

namespace {

// A trunk of two bodies' width in a finer lattice than the body is found in, with arms beside it,
// on the hollow shell of a couch with a board below.
struct TrunkOnCouch {
    TrunkOnCouch() {
        const auto arm = [](glm::dvec3 p) {
            return glm::length(glm::dvec2(std::abs(p.x) - 215.0, p.y - 20.0)) < 35.0;
        };
        const auto trunk = [](glm::dvec3 p) {
            return glm::length(glm::dvec2(p.x / 165.0, p.y / 110.0)) < 1.0;
        };
        const auto lung = [](glm::dvec3 p) {
            return glm::length(glm::dvec2((std::abs(p.x) - 75.0) / 50.0, p.y / 70.0)) < 1.0;
        };
        const auto couch = [](glm::dvec3 p) {
            const double y = p.y - 0.0004 * p.x * p.x;
            return std::abs(p.x) < 240.0 && ((y > 115.0 && y < 118.0) || (y > 150.0 && y < 153.0));
        };
        const auto board = [](glm::dvec3 p) {
            return std::abs(p.x) < 200.0 && p.y > 200.0 && p.y < 215.0;
        };
        for (int k = 0; k < lattice.size().k; ++k)
            for (int j = 0; j < lattice.size().j; ++j)
                for (int i = 0; i < lattice.size().i; ++i) {
                    const glm::dvec3 p = lattice.patient(volume::VoxelIndex{i, j, k}).mm;
                    isPatient.push_back(trunk(p) || arm(p));
                    isCouch.push_back(isPatient.back() == 0 && (couch(p) || board(p)));
                    samples.push_back(isPatient.back() != 0 ? (lung(p) && trunk(p) ? -850 : 40)
                                      : isCouch.back() != 0 ? 100
                                                            : -1000);
                }
    }
    volume::Volume volume() const { return {lattice, samples, volume::ValueUnit::hounsfield}; }
    volume::Volume withoutCouch() const {
        std::vector<std::int16_t> alone = samples;
        for (std::size_t n = 0; n < alone.size(); ++n)
            if (isCouch[n] != 0)
                alone[n] = -1000;
        return {lattice, alone, volume::ValueUnit::hounsfield};
    }

    volume::Lattice lattice = volume::Lattice::centred({500, 440, 12}, {1.0, 1.0, 5.0});
    std::vector<std::uint8_t> isPatient, isCouch;
    std::vector<std::int16_t> samples;
};

} // namespace

TEST(Body, KeepsArmsAndLeavesACouch) {
    const TrunkOnCouch scan;
    const Mask body = preprocess::body(scan.volume(), 2.0);
    std::size_t lost = 0, left = 0;
    for (std::size_t n = 0; n < body.size(); ++n) {
        lost += scan.isPatient[n] != 0 && body[n] == 0 ? 1 : 0;
        left += scan.isCouch[n] != 0 && body[n] != 0 ? 1 : 0;
    }
    EXPECT_EQ(lost, 0U);
    EXPECT_EQ(left, 0U);
    EXPECT_TRUE(preprocess::contentOf(scan.volume()).hasCouch);
    EXPECT_FALSE(preprocess::contentOf(scan.withoutCouch()).hasCouch);
}

// Not a voxel of a patient is lost, lungs and airways included.
TEST(Body, LosesNothingOfThePhantoms) {
    for (const phantom::Kind kind : {phantom::Kind::head, phantom::Kind::chest}) {
        const volume::Volume volume = phantom::makePhantom(
            kind, phantom::phantomLattice(kind, {.size = volume::GridSize{160, 160, 64}}));
        const Mask body = preprocess::body(volume, 2.0);
        std::size_t tissue = 0, lost = 0;
        volume.visit([&](auto samples) {
            for (std::size_t n = 0; n < body.size(); ++n) {
                tissue += double(samples[n]) > -400.0 ? 1 : 0;
                lost += double(samples[n]) > -400.0 && body[n] == 0 ? 1 : 0;
            }
        });
        EXPECT_GT(tissue, body.size() / 10);
        EXPECT_EQ(lost, 0U);
        EXPECT_FALSE(preprocess::contentOf(volume).hasCouch);
    }
}

// Two lungs that no airway joins, and a bubble.
TEST(LargestPart, KeepsThoseThatAreNotMuchSmaller) {
    const auto lattice = volume::Lattice::centred({40, 20, 20}, {1, 1, 1});
    const auto right = [](glm::dvec3 p) { return glm::length(p - glm::dvec3(9, 0, 0)) < 6.0; };
    const auto left = [](glm::dvec3 p) { return glm::length(p - glm::dvec3(-9, 0, 0)) < 5.0; };
    const auto bubble = [](glm::dvec3 p) { return glm::length(p - glm::dvec3(0, 8, 0)) < 1.5; };
    const Mask mask =
        maskOf(lattice, [&](glm::dvec3 p) { return right(p) || left(p) || bubble(p); });
    EXPECT_EQ(preprocess::largestPart(lattice, mask, 0.1),
              maskOf(lattice, [&](glm::dvec3 p) { return right(p) || left(p); }));
    EXPECT_EQ(preprocess::largestPart(lattice, mask, 0.001), mask);
    EXPECT_EQ(preprocess::largestPart(lattice, mask), maskOf(lattice, right));
}

// A head with ears of 3 mm and a nose lies in a head rest of 4 mm, which touches it.
TEST(Body, KeepsEarsAndLeavesTheHeadRest) {
    const auto lattice = volume::Lattice::centred({110, 120, 60}, {2.0, 2.0, 3.0});
    const auto head = [](glm::dvec3 p) {
        return glm::length(p / glm::dvec3(75.0, 95.0, 110.0)) < 1.0;
    };
    const auto ear = [](glm::dvec3 p) {
        return std::abs(p.x) > 70.0 && std::abs(p.x) < 98.0 && std::abs(p.y - 10.0) < 2.0 &&
               std::abs(p.z) < 30.0;
    };
    const auto nose = [](glm::dvec3 p) {
        return std::abs(p.x) < 3.0 && p.y < -85.0 && p.y > -112.0 && std::abs(p.z + 20.0) < 12.0;
    };
    const auto rest = [](glm::dvec3 p) {
        const double r = glm::length(glm::dvec2(p.x, p.y) / glm::dvec2(79.0, 99.0));
        return p.y > 40.0 && r > 1.0 && r < 1.04;
    };
    std::vector<std::int16_t> samples(lattice.size().count(), -1000);
    std::vector<std::uint8_t> isPatient(samples.size()), isRest(samples.size());
    for (int k = 0, n = 0; k < lattice.size().k; ++k)
        for (int j = 0; j < lattice.size().j; ++j)
            for (int i = 0; i < lattice.size().i; ++i, ++n) {
                const glm::dvec3 p = lattice.patient(volume::VoxelIndex{i, j, k}).mm;
                isPatient[std::size_t(n)] = head(p) || ear(p) || nose(p);
                isRest[std::size_t(n)] = rest(p) && isPatient[std::size_t(n)] == 0;
                if (isPatient[std::size_t(n)] != 0 || isRest[std::size_t(n)] != 0)
                    samples[std::size_t(n)] = 40;
            }
    const volume::Volume volume(lattice, samples, volume::ValueUnit::hounsfield);
    const Mask body = preprocess::body(volume, 0.0);
    std::size_t lost = 0, left = 0, ofRest = 0;
    for (std::size_t n = 0; n < body.size(); ++n) {
        lost += isPatient[n] != 0 && body[n] == 0;
        left += isRest[n] != 0 && body[n] != 0;
        ofRest += isRest[n];
    }
    EXPECT_EQ(lost, 0U);
    // The part of the rest within the roughness of the skin cannot be told from it.
    EXPECT_LT(left, ofRest / 5);
}

// Both ears are pressed against the dense walls of a head rest.
TEST(Body, LosesADenseShellThatTouchesIt) {
    const auto lattice = volume::Lattice::centred({110, 120, 60}, {2.0, 2.0, 3.0});
    const auto head = [](glm::dvec3 p) {
        return glm::length(p / glm::dvec3(75.0, 95.0, 110.0)) < 1.0;
    };
    const auto ear = [](glm::dvec3 p) {
        return std::abs(p.x) > 70.0 && std::abs(p.x) < 98.0 && std::abs(p.y - 10.0) < 5.0 &&
               std::abs(p.z) < 30.0;
    };
    const auto skull = [](glm::dvec3 p) {
        const double r = glm::length(p / glm::dvec3(75.0, 95.0, 110.0));
        return r > 0.85 && r < 0.92;
    };
    const auto wall = [](glm::dvec3 p) {
        return std::abs(p.x) >= 98.0 && std::abs(p.x) < 102.0 && std::abs(p.y) < 60.0;
    };
    std::vector<std::int16_t> samples(lattice.size().count(), -1000);
    std::vector<std::uint8_t> isPatient(samples.size()), isWall(samples.size());
    for (int k = 0, n = 0; k < lattice.size().k; ++k)
        for (int j = 0; j < lattice.size().j; ++j)
            for (int i = 0; i < lattice.size().i; ++i, ++n) {
                const glm::dvec3 p = lattice.patient(volume::VoxelIndex{i, j, k}).mm;
                isPatient[std::size_t(n)] = head(p) || ear(p);
                isWall[std::size_t(n)] = wall(p);
                if (isPatient[std::size_t(n)] != 0)
                    samples[std::size_t(n)] = skull(p) ? 900 : 40;
                if (isWall[std::size_t(n)] != 0)
                    samples[std::size_t(n)] = 400;
            }
    for (const double margin : {0.0, 2.0}) {
        const Mask body =
            preprocess::body({lattice, samples, volume::ValueUnit::hounsfield}, margin);
        std::size_t lost = 0, left = 0;
        for (std::size_t n = 0; n < body.size(); ++n) {
            lost += isPatient[n] != 0 && body[n] == 0;
            left += isWall[n] != 0 && body[n] != 0;
        }
        EXPECT_EQ(lost, 0U) << margin;
        EXPECT_EQ(left, 0U) << margin;
    }
}

} // namespace
} // namespace pellucid
