// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "core/phantom/phantom.h"
#include "core/subtraction/difference.h"
#include "core/subtraction/reasons.h"
#include "core/subtraction/rigid_registration.h"
#include "core/task/error.h"

namespace pellucid {
namespace {

using subtraction::RigidTransform;
using volume::GridSize;
using volume::Lattice;
using volume::Volume;
using volume::VoxelIndex;

constexpr double degrees = 180.0 / 3.14159265358979323846;

// The head at the same places of a patient who has moved: its samples are taken at `moved`'s
// points.
Volume headOn(const Lattice &lattice) {
    return phantom::makePhantom(phantom::Kind::head, lattice);
}

Lattice movedLattice(const Lattice &lattice, const RigidTransform &moved) {
    std::array<glm::dvec3, 3> steps;
    for (int d = 0; d < 3; ++d)
        steps[std::size_t(d)] = moved.rotation * lattice.step(d);
    return Lattice::make(lattice.size(), {moved(lattice.origin().mm)}, steps);
}

// The same samples, but said to be on another lattice: the patient has moved between two scans.
Volume claimedOn(const Lattice &lattice, const Volume &volume) {
    return volume.visit([&](auto samples) {
        using T = std::remove_cv_t<typename decltype(samples)::element_type>;
        return Volume(lattice, std::vector<T>(samples.begin(), samples.end()), volume.unit(),
                      volume.notes());
    });
}

TEST(Difference, OfWholeNumbersOnOneLatticeIsExact) {
    const Lattice lattice =
        phantom::phantomLattice(phantom::Kind::chest, {.size = GridSize{40, 36, 20}});
    const Volume a = phantom::makePhantom(phantom::Kind::chest, lattice), b = headOn(lattice);
    const Volume d = subtraction::difference(a, b);
    EXPECT_FALSE(d.isFloat());
    EXPECT_EQ(d.unit(), volume::ValueUnit::none);
    EXPECT_EQ(d.lattice(), lattice);
    for (int k = 0; k < 20; ++k)
        for (int j = 0; j < 36; ++j)
            for (int i = 0; i < 40; ++i)
                ASSERT_EQ(d.value({i, j, k}), a.value({i, j, k}) - b.value({i, j, k}));
}

TEST(Difference, OnAnotherLatticeIsInterpolatedWhereBothAre) {
    const Lattice lattice = Lattice::centred({30, 20, 10}, {1.0, 1.0, 2.0});
    const auto plane = [](const glm::dvec3 &at) { return 3.0 * at.x - 2.0 * at.y + at.z; };
    const auto on = [&](const Lattice &own) {
        std::vector<float> samples(own.size().count());
        const GridSize n = own.size();
        for (int k = 0; k < n.k; ++k)
            for (int j = 0; j < n.j; ++j)
                for (int i = 0; i < n.i; ++i)
                    samples[n.offsetOf(i, j, k)] =
                        float(plane(own.patient(VoxelIndex{i, j, k}).mm));
        return Volume(own, samples, volume::ValueUnit::none);
    };
    const Lattice other = Lattice::make(
        {14, 40, 9}, {glm::dvec3(-10.0, -9.0, -8.0)},
        {glm::dvec3(1.3, 0.2, 0.0), glm::dvec3(-0.1, 0.5, 0.0), glm::dvec3(0.0, 0.4, 1.9)});
    const Volume d = subtraction::difference(on(lattice), on(other));
    int inside = 0;
    for (int k = 0; k < 10; ++k)
        for (int j = 0; j < 20; ++j)
            for (int i = 0; i < 30; ++i) {
                EXPECT_NEAR(d.value({i, j, k}), 0.0, 1e-4);
                const glm::dvec3 v = other.voxel(lattice.patient(VoxelIndex{i, j, k})).v;
                inside += v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x <= 13 && v.y <= 39 && v.z <= 8;
            }
    EXPECT_GT(inside, 500);
    const Lattice far =
        Lattice::make({4, 4, 4}, {glm::dvec3(900.0, 0, 0)},
                      {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)});
    try {
        subtraction::difference(on(lattice), on(far));
        ADD_FAILURE() << "volumes far apart were subtracted";
    } catch (const task::Error &error) {
        EXPECT_EQ(error.reason(), task::because::volumesDoNotOverlap);
    }
}

// To a tenth of a voxel and of a degree, also of thick and tilted slices.
TEST(RigidRegistration, FindsHowThePatientMoved) {
    struct Case {
        glm::dvec3 axis;
        double angleDeg;
        glm::dvec3 shiftMm;
        GridSize size;
        double tilt;
    };
    for (const Case &c : {Case{{0, 0, 1}, 3.0, {2.7, -4.1, 1.3}, {96, 96, 80}, 0.0},
                          Case{{1, 0.5, -0.3}, 5.0, {-6.2, 3.3, 4.9}, {96, 96, 40}, 0.0},
                          Case{{0.2, 1, 0.4}, 2.0, {1.1, 0.4, -2.2}, {96, 96, 48}, 15.0}}) {
        const Lattice lattice = phantom::phantomLattice(
            phantom::Kind::head, {.size = c.size, .tiltRad = c.tilt / degrees});
        RigidTransform moved;
        moved.rotation =
            glm::mat3_cast(glm::angleAxis(c.angleDeg / degrees, glm::normalize(c.axis)));
        moved.centreMm = lattice.center().mm;
        moved.shiftMm = c.shiftMm;
        // Scanned on the moved lattice, the head has the same values at the same indices as a head
        // that moved the other way.
        const Volume fixed = headOn(lattice);
        const Volume moving = claimedOn(lattice, headOn(movedLattice(lattice, moved)));
        const auto found = subtraction::registerRigidly(fixed, moving);
        // Sample n of the moving volume shows the head at moved(x_n): toMoving is the inverse.
        const glm::dmat3 rest = found.toMoving.rotation * moved.rotation;
        RigidTransform turned;
        turned.rotation = rest;
        EXPECT_LT(turned.angleRad() * degrees, 0.1) << c.angleDeg;
        double worst = 0.0;
        for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), glm::dvec3(70, 0, 0), glm::dvec3(0, 80, 0),
                                   glm::dvec3(0, 0, 70), glm::dvec3(-60, -50, -40)}) {
            const glm::dvec3 at = lattice.center().mm + p;
            worst = std::max(worst, glm::length(found.toMoving(moved(at)) - at));
        }
        const double voxel = lattice.shortestStepMm();
        EXPECT_LT(worst, 0.1 * voxel) << c.angleDeg;
        EXPECT_LT(found.residualAfter, 0.6 * found.residualBefore);
        std::printf("moved by %.1f mm and %.1f degrees: %.4f degrees and %.3f mm off (voxel %.2f "
                    "mm), residual %.1f -> %.1f\n",
                    glm::length(c.shiftMm), c.angleDeg, turned.angleRad() * degrees, worst, voxel,
                    found.residualBefore, found.residualAfter);
    }
}

TEST(RigidRegistration, LeavesVolumesThatFitAsTheyAre) {
    const Volume head =
        headOn(phantom::phantomLattice(phantom::Kind::head, {.size = GridSize{48, 48, 32}}));
    const auto found = subtraction::registerRigidly(head, head);
    EXPECT_TRUE(found.toMoving.isIdentity());
    EXPECT_EQ(found.residualAfter, 0.0);
}

TEST(RigidRegistration, StopsWhenCancelledAndRefusesWhatIsApart) {
    const Lattice lattice =
        phantom::phantomLattice(phantom::Kind::head, {.size = GridSize{48, 48, 40}});
    const Volume head = headOn(lattice);
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(subtraction::registerRigidly(head, head, task::Progress(source.get_token())),
                 task::Cancelled);
    RigidTransform away;
    away.shiftMm = {2000.0, 0.0, 0.0};
    EXPECT_THROW(subtraction::registerRigidly(head, claimedOn(movedLattice(lattice, away), head)),
                 task::Error);
}

} // namespace
} // namespace pellucid
