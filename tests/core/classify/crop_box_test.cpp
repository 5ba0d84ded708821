// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/crop_box.h"

#include <gtest/gtest.h>

#include "core/task/error.h"

namespace pellucid::classify {

namespace {

DensityField counted() {
    const auto lattice = volume::Lattice::centred({6, 5, 4}, {1.0, 2.0, 3.0});
    std::vector<float> samples(120);
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] = float(n + 1);
    return fieldOf(volume::Volume(lattice, std::vector<float>(120, 0.0F), volume::ValueUnit::none),
                   samples);
}

} // namespace

TEST(CropBox, keepsSamplesWhoseCentresLieInside) {
    // Centres of six samples: 1/12, 3/12, ...
    const CropBox box{{0.25, 0.0, 0.3}, {0.74, 1.0, 0.9}};
    const auto in = samplesIn(box, {6, 5, 4});
    EXPECT_EQ(in, (volume::VoxelBox{{1, 0, 1}, {4, 5, 4}}));
    const DensityField field = counted(), kept = cropped(field, box);
    EXPECT_EQ(kept.support, in);
    EXPECT_EQ(kept.values.lattice(), field.values.lattice()); // views do not move
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 5; ++j)
            for (int i = 0; i < 6; ++i) {
                const bool isIn = i >= 1 && i < 4 && k >= 1;
                EXPECT_EQ(kept.values.value({i, j, k}), isIn ? field.values.value({i, j, k}) : 0.0);
            }
}

TEST(CropBox, theWholeIsNoCopyAndFacesComeBackFromShares) {
    const DensityField field = counted();
    EXPECT_EQ(cropped(field, {}).support, field.support);
    // A face between samples 3 and 4 of 7, as share and back, whatever its rounding.
    for (int count : {7, 49, 333, 1023})
        for (int face = 1; face < count; ++face) {
            const double share = double(face) / count;
            EXPECT_EQ(samplesIn({{share, 0, 0}, {1, 1, 1}}, {count, 1, 1}).lo.i, face);
            EXPECT_EQ(samplesIn({{0, 0, 0}, {share, 1, 1}}, {count, 1, 1}).hi.i, face);
        }
    EXPECT_EQ(samplesIn({{0.5, 0.5, 0.5}, {0.501, 0.501, 0.501}}, {2, 2, 2}).size().count(), 1U);
}

TEST(CropBox, refusesWhatIsNoBox) {
    for (const CropBox &bad : {CropBox{{0.5, 0, 0}, {0.5, 1, 1}}, CropBox{{-0.1, 0, 0}, {1, 1, 1}},
                               CropBox{{0, 0, 0}, {1, 1, 1.5}}, CropBox{{0, NAN, 0}, {1, 1, 1}}})
        EXPECT_THROW(validate(bad), task::Error);
    EXPECT_NO_THROW(validate(CropBox()));
}

} // namespace pellucid::classify
