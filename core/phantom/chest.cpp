// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "core/phantom/anatomy.h"
#include "core/phantom/painter.h"

// A chest in LPS millimetres about its middle: x left, y posterior, z superior. The scan cuts it
// off above and below.

namespace pellucid::phantom {

namespace {

using glm::dvec3;

constexpr double airHu = -1000.0, fatHu = -95.0, muscleHu = 55.0, bloodHu = 45.0, lungHu = -840.0;
constexpr double compactHu = 900.0, spongyHu = 260.0;

class Chest {
public:
    explicit Chest(Painter &painter) : m(painter) {}

    void paint() {
        paintCouch();
        paintBody();
        paintAbdomen();
        paintLungs();
        paintMediastinum();
        paintSpine();
        paintRibs();
        paintShoulders();
    }

private:
    void paintBoth(const Shape &left, double hu) {
        m.paint(left, hu);
        m.paint(mirrored(left), hu);
    }

    void paintBone(const Shape &bone, double wall) {
        m.paint(bone, compactHu);
        m.paint(grown(bone, -wall), spongyHu);
    }
    void paintBoneBoth(const Shape &left, double wall) {
        paintBone(left, wall);
        paintBone(mirrored(left), wall);
    }

    void paintCouch() {
        const auto arc = [](double radius) {
            return Shape{[radius](const dvec3 &p) {
                             const dvec3 q(p.x, p.y + 390.0, 0);
                             return std::max(std::abs(glm::length(q) - 525.0) - radius,
                                             std::abs(p.x) - 190.0);
                         },
                         {-200, 60, -400},
                         {200, 160, 400}};
        };
        m.paint(arc(7.0), -100.0);
        m.paint(arc(5.5), -900.0);
    }

    static double girth(double z) {
        return 1.0 - 0.06 * std::cos(z * 0.012) + (z > 100 ? 0.0008 * (z - 100) : 0.0);
    }

    static Shape trunk(double inset) {
        return {[inset](const dvec3 &p) {
                    const double g = girth(p.z);
                    const double rx = 168.0 * g - inset, ry = 112.0 * g - inset;
                    // A superellipse: flatter front and back than an ellipse.
                    const double r = std::pow(
                        std::pow(std::abs(p.x) / rx, 2.5) + std::pow(std::abs(p.y) / ry, 2.5), 0.4);
                    return (r - 1.0) * std::min(rx, ry);
                },
                {-190, -130, -400},
                {190, 130, 400}};
    }

    void paintBody() {
        const Shape shoulder = ellipsoid({148, 16, 172}, {58, 56, 62});
        const Shape body = united(united(trunk(0), shoulder, 30), mirrored(shoulder), 30);
        m.paint(body, 30.0);
        m.paint(grown(body, -2.0), fatHu);
        m.paint(grown(body, -14.0), [](const dvec3 &p) {
            const double plane =
                std::sin(0.11 * p.x + std::sin(0.05 * p.z)) * std::cos(0.09 * p.z + 0.06 * p.y);
            return plane > 0.72 ? fatHu + 15.0 : muscleHu;
        });
        // Breast and armpit fat.
        paintBoth(ellipsoid({120, -40, 110}, {26, 30, 48}), fatHu);
    }

    static double diaphragmZ(const dvec3 &p) {
        const double cx = p.x < 0 ? -68.0 : 74.0;
        const double dome =
            std::exp(-(std::pow((p.x - cx) / 62.0, 2) + std::pow((p.y + 10.0) / 80.0, 2)));
        return -168.0 + (p.x < 0 ? 92.0 : 78.0) * dome;
    }

    void paintAbdomen() {
        const Shape below{[](const dvec3 &p) { return 0.7 * (p.z - diaphragmZ(p)); },
                          {-190, -130, -400},
                          {190, 130, 0}};
        const Shape abdomen = intersected(trunk(30), below);
        m.paint(abdomen, fatHu + 10);
        m.paint(
            intersected(grown(abdomen, -3), united(ellipsoid({-72, -8, -160}, {82, 78, 88}),
                                                   ellipsoid({10, -40, -140}, {70, 40, 46}), 20)),
            62.0);
        m.paint(intersected(grown(abdomen, -3), ellipsoid({92, 26, -160}, {34, 46, 62})), 52.0);
        m.paint(intersected(grown(abdomen, -3), ellipsoid({62, -36, -146}, {46, 44, 52})), 20.0);
        m.paint(intersected(grown(abdomen, -6), ellipsoid({66, -58, -126}, {30, 22, 22})), airHu);
    }

    static Shape lung(double side) {
        const dvec3 center(side * 76.0, 2.0, -10.0);
        const Shape sac = ellipsoid(center, {64, 88, 172});
        return {[=](const dvec3 &p) {
                    const double mediastinum =
                        (side > 0 ? 44.0 : 30.0) - 10.0 * std::clamp((p.z - 20.0) / 80.0, 0.0, 1.0);
                    const double medial = mediastinum - side * p.x;
                    return std::max({sac(p), 0.9 * medial, 0.7 * (diaphragmZ(p) + 3.0 - p.z)});
                },
                sac.low, sac.high};
    }

    // Vessels branch from the hilum and become thinner.
    void branch(const Shape &within, dvec3 from, dvec3 direction, double length, double radius,
                int depth, std::uint32_t seed) {
        const dvec3 to = from + length * direction;
        const Shape vessel = rod(from, to, radius, radius * 0.82);
        m.paint(depth > 0 ? vessel : intersected(vessel, within), bloodHu);
        if (depth == 0)
            return;
        for (int child = 0; child < 3; ++child) {
            seed = seed * 1664525U + 1013904223U;
            const double a = double(seed >> 8) / double(1U << 24),
                         b = double((seed * 2654435761U) >> 8) / double(1U << 24);
            const double angle = 6.2831853 * (child / 3.0 + 0.3 * a), spread = 0.35 + 0.45 * b;
            const dvec3 helper = std::abs(direction.z) < 0.8 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
            const dvec3 e = glm::normalize(glm::cross(direction, helper)),
                        f = glm::cross(direction, e);
            const dvec3 next =
                glm::normalize(direction + spread * (std::cos(angle) * e + std::sin(angle) * f));
            const dvec3 end = to + length * 0.8 * next;
            if (within(end) < -4.0)
                branch(within, to, next, length * 0.8, radius * 0.72, depth - 1,
                       seed + 97U * std::uint32_t(child));
        }
    }

    void paintLungs() {
        for (const double side : {-1.0, 1.0}) {
            const Shape sac = lung(side);
            m.paint(sac, [](const dvec3 &p) {
                return lungHu + 0.35 * p.y +
                       14.0 * std::sin(0.35 * p.x) * std::sin(0.31 * p.y) * std::sin(0.27 * p.z);
            });
            // The oblique fissure.
            m.paint(intersected(sac, {[](const dvec3 &p) {
                                          return std::abs(0.7 * p.y + 0.7 * p.z + 8.0) - 0.5;
                                      },
                                      {-150, -100, -180},
                                      {150, 100, 180}}),
                    -700.0);
            const dvec3 hilum(side * 42.0, 6.0, 18.0);
            std::uint32_t seed = side > 0 ? 11U : 23U;
            for (const dvec3 &out : {dvec3(side * 0.8, -0.3, 0.7), dvec3(side * 0.9, 0.4, 0.2),
                                     dvec3(side * 0.6, 0.5, -0.8), dvec3(side * 0.7, -0.5, -0.6),
                                     dvec3(side * 0.5, 0.2, 0.95)}) {
                seed += 131U;
                branch(sac, hilum, glm::normalize(out), 34.0, 6.0, 5, seed);
            }
        }
        // A nodule in the right upper lobe.
        m.paint(ellipsoid({-82, -22, 84}, {8, 7, 8}), 40.0);
    }

    void paintMediastinum() {
        const auto tilt = glm::angleAxis(glm::radians(-38.0), glm::normalize(dvec3(0.2, 1, 0.2)));
        const Shape heart = ellipsoid({30, -34, -44}, {54, 48, 68}, tilt);
        m.paint(grown(heart, 5), fatHu);
        m.paint(heart, 48.0);
        m.paint(ellipsoid({34, -34, -56}, {20, 22, 34}, tilt), bloodHu - 5);
        m.paint(tube({{6, -34, 6},
                      {-8, -34, 44},
                      {-8, -22, 70},
                      {4, 0, 82},
                      {18, 26, 74},
                      {26, 44, 48},
                      {24, 50, -20},
                      {14, 52, -240}},
                     13.0),
                bloodHu);
        m.paint(tube({{14, -44, 8}, {14, -32, 36}, {30, -8, 36}}, 12.0), bloodHu);
        m.paint(rod({-26, -20, 0}, {-24, -14, 120}, 10, 9), bloodHu);
        m.paint(tube({{-8, -26, 78}, {-16, -22, 110}, {-20, -10, 240}}, 6.0), bloodHu);
        m.paint(tube({{8, -16, 82}, {18, -12, 120}, {22, -6, 240}}, 5.0), bloodHu);
        // Trachea and main bronchi, oesophagus.
        m.paint(tube({{0, 6, 240}, {0, 12, 60}}, 10.5), 90.0);
        paintBoth(tube({{0, 12, 60}, {20, 12, 38}, {44, 8, 18}}, 7.5), 80.0);
        m.paint(tube({{0, 6, 240}, {0, 12, 60}}, 8.8), airHu);
        paintBoth(tube({{0, 12, 60}, {20, 12, 38}, {44, 8, 18}, {60, 10, -6}}, 5.6), airHu);
        m.paint(tube({{4, 26, 240}, {4, 34, 40}, {12, 36, -180}}, 7.0), 40.0);
    }

    void paintSpine() {
        for (int level = -8; level <= 8; ++level) {
            const double z = 24.0 * level, y = 66.0 - 0.0006 * z * z;
            m.paint(ellipsoid({0, y, z + 12.0}, {17, 14, 3.0}), 85.0);
            const Shape body{
                [=](const dvec3 &p) {
                    const dvec3 q((p.x) / 17.5, (p.y - y) / 15.0, 0);
                    const double waist = 1.0 - 0.1 * (1.0 - std::pow((p.z - z) / 9.5, 2));
                    return std::max((glm::length(q) - waist) * 15.0, std::abs(p.z - z) - 9.5);
                },
                {-19, y - 17, z - 11},
                {19, y + 17, z + 11}};
            paintBone(body, 1.4);
            m.paint(rod({0, y + 24, z - 12}, {0, y + 24, z + 12}, 8, 8), 10.0);
            m.paint(rod({0, y + 24, z - 12}, {0, y + 24, z + 12}, 5, 5), 35.0);
            paintBoneBoth(
                tube({{11, y + 12, z + 2}, {13, y + 22, z + 2}, {8, y + 32, z}, {0, y + 36, z - 4}},
                     4.0),
                1.6);
            paintBoneBoth(rod({12, y + 24, z + 2}, {34, y + 32, z + 6}, 4.5, 4.0), 1.4);
            paintBone(rod({0, y + 36, z - 4}, {0, y + 50, z - 22}, 3.6, 3.0), 1.2);
        }
    }

    void paintRibs() {
        for (int rib = 0; rib < 11; ++rib) {
            const double z0 = 186.0 - 30.0 * rib;
            const double size = 0.62 + 0.38 * std::min(1.0, (rib + 0.4) / 5.0);
            const double rx = 141.0 * size, ry = 97.0 * std::min(1.0, size + 0.06),
                         drop = 44.0 + 5.0 * rib;
            const double reach = rib > 8 ? 0.62 : 0.88;
            std::vector<dvec3> path;
            for (int n = 0; n <= 22; ++n) {
                const double t = reach * n / 22.0; // 0 at the spine, 1 at the sternum
                const double angle = 3.14159265 * t;
                path.emplace_back(16.0 * (1 - t) + rx * std::sin(angle),
                                  -2.0 + ry * std::cos(angle) - 12.0 * (1 - t),
                                  z0 + 8.0 - drop * t);
            }
            paintBoneBoth(tube(path, 5.4), 1.6);
            // Costal cartilage to the sternum.
            if (rib < 8) {
                const dvec3 end = path.back();
                paintBoth(tube({end,
                                {0.55 * end.x, -94, end.z + 4.0 + 1.5 * rib},
                                {14, -97, std::max(-40.0, end.z + 8.0 + 4.0 * rib)}},
                               5.0),
                          110.0);
            }
        }
        paintBone(roundedBox({0, -99, 116}, {24, 6, 22}, 5), 1.6);
        paintBone(roundedBox({0, -99, 36}, {15, 5.5, 58}, 5), 1.6);
    }

    void paintShoulders() {
        paintBoneBoth(tube({{14, -84, 142}, {50, -82, 156}, {92, -50, 166}, {128, -10, 172}}, 6.0),
                      1.8);
        const auto blade = glm::angleAxis(glm::radians(-32.0), dvec3(0, 0, 1)) *
                           glm::angleAxis(glm::radians(12.0), dvec3(0, 1, 0));
        paintBoneBoth(ellipsoid({104, 74, 96}, {38, 4.2, 70}, blade), 1.3);
        paintBoneBoth(tube({{78, 88, 140}, {112, 74, 154}, {142, 30, 168}}, 5.0), 1.5);
        paintBoneBoth(ellipsoid({158, 8, 158}, {22, 22, 24}), 2.0);
    }

    Painter &m;
};

} // namespace

volume::Volume makeChest(const volume::Lattice &lattice, const task::Progress &progress) {
    Painter painter(lattice, airHu, progress);
    Chest(painter).paint();
    return painter.finish(
        12.0, 5,
        phantomNotes("Chest phantom", {{25.0, 350.0, "Mediastinum"}, {-500.0, 1400.0, "Lung"}}));
}

} // namespace pellucid::phantom
