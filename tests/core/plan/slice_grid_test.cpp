// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/plan/slice_grid.h"
#include "core/task/error.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

struct Setting {
    volume::Lattice lattice = volume::Lattice::centred({60, 60, 60}, {1, 1, 1});
    plan::FieldOfView fieldOfView = plan::fieldOfViewOf(lattice, lattice.bounds());
    scene::Camera camera = scene::defaultCamera(lattice);
    plan::SliceGrid grid() const { return plan::sliceGrid(camera, fieldOfView, lattice, {}); }
};

TEST(SliceGrid, SmallerAliasingLimitsTakeLargerGridsUpToTheLargest) {
    Setting s;
    int before = 0;
    for (const double tails : {1e-1, 1e-3, 1e-4, 1e-5}) {
        s.fieldOfView.aliasingLimit = tails;
        const plan::SliceGrid grid = s.grid();
        EXPECT_GE(grid.columns, before);
        EXPECT_GE(grid.columns, 52 + s.camera.width / 2); // half a diagonal beside half the image
        EXPECT_LE(plan::predictFoldedTails({}, s.camera, grid.columns, grid.rows,
                                           *s.fieldOfView.spreads.front()),
                  tails);
        before = grid.columns;
    }
    s.fieldOfView.aliasingLimit =
        0.0; // cannot be had: three times the cells, or 2048, are the most
    EXPECT_EQ(s.grid().columns, 2048);
}

TEST(SliceGrid, APanOfEitherSignTakesTheSameRoom) {
    Setting s;
    s.camera.panMm = {30.0, 0.0};
    const auto right = s.grid();
    s.camera.panMm = {-30.0, 0.0};
    EXPECT_EQ(right, s.grid());
    EXPECT_GE(right.columns, right.rows + 20);
}

TEST(SliceGrid, HugeGridsAreRefusedOrStayWithinTheLimit) {
    Setting s;
    s.camera.pixelMm = 1e-4;
    EXPECT_THROW(s.grid(), task::Error);
    s.camera.pixelMm = 1.0;
    s.camera.panMm = {1e9, 0.0};
    EXPECT_THROW(s.grid(), task::Error);
    s.camera.panMm = {40000.0, 0.0};
    s.fieldOfView.aliasingLimit = 0.0;
    EXPECT_LE(s.grid().columns, 65536);
}

// Of a crop the tails come from the whole projection: relative to its own energy they are more.
TEST(FoldedTails, ACropHasMoreOfThem) {
    const Setting s;
    scene::Camera crop = s.camera;
    crop.width = crop.height = 16;
    EXPECT_EQ(plan::shareInImage(s.camera, *s.fieldOfView.spreads.front()), 1.0);
    // A cube's mean shadow is a quarter of its surface.
    EXPECT_NEAR(plan::shareInImage(crop, *s.fieldOfView.spreads.front()), 256.0 / (1.5 * 3600.0),
                1e-12);
}

} // namespace
} // namespace pellucid
