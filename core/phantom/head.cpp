// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/phantom/anatomy.h"
#include "core/phantom/painter.h"

// An adult head in LPS millimetres about a point between the ears: x left, y posterior, z superior.
// Dimensions are rounded values from anatomy books.

namespace pellucid::phantom {

namespace {

using glm::dvec3;

constexpr double airHu = -1000.0, fatHu = -90.0, csfHu = 8.0, greyHu = 38.0, whiteHu = 27.0;
constexpr double muscleHu = 55.0, skinHu = 40.0, compactHu = 1250.0, spongyHu = 450.0;
constexpr double enamelHu = 2500.0, dentinHu = 1600.0, fluidHu = 5.0;

class Head {
public:
    explicit Head(Painter &painter) : m(painter) {}

    void paint() {
        paintSoftTissue();
        paintSpineAndNeck();
        paintSkull();
        paintFaceBones();
        paintBrain();
        paintOrbits();
        paintAirways();
        paintTeeth();
    }

private:
    void paintBoth(const Shape &left, double hu) {
        m.paint(left, hu);
        m.paint(mirrored(left), hu);
    }

    void paintSoftTissue() {
        const Shape cranium = ellipsoid({0, 12, 30}, {77, 97, 79});
        const Shape face = ellipsoid({0, -38, -40}, {60, 56, 68});
        const Shape chin = ellipsoid({0, -58, -86}, {36, 34, 24});
        const Shape neck{[](const dvec3 &p) {
                             const dvec3 unit((p.x) / 56.0, (p.y - 24.0) / 58.0, 0.0);
                             return std::max((glm::length(unit) - 1.0) * 56.0, p.z + 20.0);
                         },
                         {-60, -40, -400},
                         {60, 90, -20}};
        const Shape nose = united(
            rod({0, -88, 10}, {0, -106, -20}, 6, 9),
            united(ellipsoid({8, -98, -24}, {6, 8, 6}), ellipsoid({-8, -98, -24}, {6, 8, 6}), 4),
            8);
        const Shape lips =
            united(ellipsoid({0, -91, -50}, {23, 8, 6}), ellipsoid({0, -90, -60}, {20, 8, 6}), 2);
        const Shape brow =
            united(ellipsoid({26, -84, 22}, {26, 8, 8}), ellipsoid({-26, -84, 22}, {26, 8, 8}), 6);
        Shape skin = united(cranium, face, 18);
        skin = united(skin, chin, 14);
        skin = united(skin, neck, 14);
        skin = united(skin, nose, 7);
        skin = united(skin, lips, 5);
        skin = united(skin, brow, 8);
        const auto tilt = glm::angleAxis(glm::radians(14.0), glm::normalize(dvec3(1, 0, 0.4)));
        const Shape auricle = without(ellipsoid({75, 18, -4}, {7, 18, 30}, tilt),
                                      ellipsoid({81, 14, -3}, {6, 11, 19}, tilt));
        m.paint(skin, skinHu);
        m.paint(grown(skin, -2.0), fatHu);
        // There is less fat over the vault than over cheek and neck.
        m.paint(grown(skin, -4.5), [](const dvec3 &p) { return p.z > 10 ? 30.0 : muscleHu; });
        // Fatty planes between the muscles of cheek and neck.
        const Shape muscles =
            intersected(grown(skin, -9.0), roundedBox({0, 0, -80}, {90, 110, 72}, 5));
        m.paint(muscles, [](const dvec3 &p) {
            const double plane = std::sin(p.x * 0.16 + 1.5 * std::sin(p.y * 0.07)) *
                                 std::sin(p.y * 0.13 + 0.6 * std::cos(p.z * 0.06));
            return plane > 0.55 ? fatHu + 20 : muscleHu + 6 * plane;
        });
        paintBoth(auricle, skinHu);
        // Tongue and floor of the mouth.
        m.paint(ellipsoid({0, -50, -62}, {23, 30, 15}), 60.0);
        // Parotid and submandibular glands, great vessels of the neck.
        paintBoth(ellipsoid({46, -2, -42}, {8, 15, 22}), 20.0);
        paintBoth(ellipsoid({26, -38, -92}, {9, 13, 9}), 35.0);
        paintBoth(rod({30, 6, -118}, {26, 0, -40}, 4.5, 3.5), 70.0);
        paintBoth(rod({38, 14, -118}, {34, 8, -40}, 6, 4), 60.0);
    }

    void paintSpineAndNeck() {
        // C2 to C5, with discs between the bodies and an arch behind.
        for (int level = 0; level < 5; ++level) {
            const double z = -62.0 - 17.0 * level, y = 18.0 + 1.2 * level;
            const Shape body = roundedBox({0, y, z}, {12, 9, 6.5}, 4);
            m.paint(body, compactHu * 0.7);
            m.paint(grown(body, -1.6), spongyHu * 0.6);
            const Shape arch = tube(
                {{13, y + 4, z}, {16, y + 14, z}, {10, y + 24, z - 2}, {0, y + 29, z - 4}}, 3.2);
            paintBoth(arch, compactHu * 0.7);
            paintBoth(rod({14, y + 2, z}, {26, y + 4, z}, 4, 3), compactHu * 0.55);
            m.paint(rod({0, y + 29, z - 4}, {0, y + 43, z - 10}, 3.5, 4), compactHu * 0.65);
            m.paint(ellipsoid({0, y, z - 8.5}, {12, 9, 2}), 90.0);
        }
        // The atlas is a ring around the dens.
        paintBoth(
            tube({{0, 8, -46}, {14, 12, -46}, {22, 24, -46}, {15, 40, -46}, {0, 45, -46}}, 4.2),
            compactHu * 0.75);
        m.paint(rod({0, 17, -60}, {0, 16, -41}, 5.5, 4.5), compactHu * 0.7);
        // The spinal cord in cerebrospinal fluid.
        m.paint(tube({{0, 31, -34}, {0, 33, -60}, {0, 38, -140}}, 8.5), csfHu);
        m.paint(tube({{0, 31, -34}, {0, 33, -60}, {0, 38, -140}}, 5.2), 34.0);
    }

    // The floor of the skull, which steps down from the anterior to the posterior fossa. It rises
    // over the orbits and falls beside the midline, so its lateral view is not a straight line.
    static double floorZ(double x, double y) {
        const auto step = [](double at, double width) {
            return 0.5 * (1.0 + std::tanh(at / width));
        };
        return 2.0 + 5.0 * std::sin(0.1 * std::abs(x)) - 0.0012 * x * x -
               20.0 * step(y + 28.0, 8.0) - 26.0 * step(y - 22.0, 8.0);
    }

    static Shape cavity() {
        const Shape vault = ellipsoid({0, 12, 30}, {63.5, 82, 65});
        return {[=](const dvec3 &p) { return std::max(vault(p), 0.8 * (floorZ(p.x, p.y) - p.z)); },
                vault.low, vault.high};
    }

    void paintSkull() {
        const Shape vault = ellipsoid({0, 12, 30}, {70.5, 90, 72});
        const Shape outer{[=](const dvec3 &p) {
                              return std::max(vault(p), 0.8 * (floorZ(p.x, p.y) - 5.0 - p.z));
                          },
                          vault.low, vault.high};
        const Shape inner = cavity();
        const Shape foramen = rod({0, 33, -70}, {0, 33, -25}, 15, 15);
        const Shape skull = without(without(outer, inner), foramen);
        m.paint(skull, compactHu);
        // Spongy layer between the tables, and sutures.
        m.paint(grown(skull, -2.0), spongyHu);
        // Petrous ridges, occipital protuberance, mastoids, crista and clinoids.
        paintBoth(rod({18, -4, -16}, {58, 16, -19}, 5, 9), compactHu * 0.75);
        paintBoth(ellipsoid({60, 22, -36}, {8, 12, 17}), compactHu * 0.4);
        m.paint(ellipsoid({0, 87, -8}, {7, 5, 6}), compactHu * 0.8);
        m.paint(rod({0, -72, 0}, {0, -64, 10}, 2, 1.5), compactHu * 0.8);
        m.paint(roundedBox({0, -18, -12}, {14, 12, 9}, 4), compactHu * 0.6);
        m.paint(rod({0, -6, -20}, {0, 18, -42}, 9, 6), compactHu * 0.6);
    }

    void paintFaceBones() {
        // Orbital rims, zygoma, arches, maxilla, palate, nasal bones, mandible.
        std::vector<dvec3> rim;
        for (int n = 0; n <= 16; ++n) {
            const double angle = n * 2.0 * 3.14159265 / 16.0;
            rim.emplace_back(32 + 21 * std::cos(angle),
                             -76 + 5 * std::abs(std::cos(angle)) +
                                 (std::cos(angle) > 0 ? 7 * std::cos(angle) : 0),
                             4 + 18 * std::sin(angle));
        }
        paintBoth(tube(rim, 3.6), compactHu * 0.6);
        paintBoth(tube({{40, -72, -20}, {56, -58, -18}, {66, -36, -17}, {67, -6, -15}}, 3.0),
                  compactHu * 0.6);
        paintBoth(ellipsoid({46, -66, -18}, {12, 9, 10}), compactHu * 0.75);
        const Shape maxilla = united(ellipsoid({22, -62, -24}, {20, 22, 22}),
                                     roundedBox({12, -66, -40}, {14, 20, 8}, 5), 6);
        const auto maxillaHu = [](const dvec3 &p) { return p.z < -34 ? 600.0 : 480.0; };
        m.paint(grown(maxilla, 1.0), compactHu * 0.8);
        m.paint(grown(mirrored(maxilla), 1.0), compactHu * 0.8);
        m.paint(grown(maxilla, -1.5), maxillaHu);
        m.paint(grown(mirrored(maxilla), -1.5), maxillaHu);
        m.paint(roundedBox({0, -58, -41}, {20, 24, 1.8}, 1.5), compactHu * 0.55);
        paintBoth(rod({4, -90, 8}, {6, -97, -8}, 3, 2.2), compactHu * 0.7);
        // Thin plates: pterygoid, orbital floor and medial wall.
        paintBoth(roundedBox({16, -26, -30}, {2, 9, 15}, 1), compactHu * 0.6);
        paintBoth(roundedBox({11.5, -58, 4}, {0.8, 20, 13}, 0.5), 500.0);
        const Shape jaw = united(
            tube({{51, -4, -18}, {50, -6, -40}, {47, -14, -72}}, 6.0),
            tube({{47, -14, -72}, {42, -38, -80}, {31, -64, -86}, {17, -80, -89}, {0, -85, -90}},
                 7.5),
            6);
        const Shape ridge =
            tube({{38, -34, -72}, {30, -58, -76}, {18, -75, -78}, {0, -82, -79}}, 6.0);
        paintBoth(united(jaw, ridge, 5), compactHu * 1.1);
        paintBoth(grown(united(jaw, ridge, 5), -3.0), spongyHu);
        paintBoth(rod({46, -28, -40}, {46, -24, -60}, 3, 6), compactHu * 0.9);
        m.paint(tube({{-18, -44, -104},
                      {-12, -58, -106},
                      {0, -63, -106},
                      {12, -58, -106},
                      {18, -44, -104}},
                     2.4),
                compactHu * 0.6);
    }

    static double gyri(const dvec3 &p) {
        // A warped gyroid: folded sheets about a centimetre apart, like sulci.
        const dvec3 q = 0.30 * p + 0.9 * dvec3(std::sin(0.11 * p.y), std::sin(0.12 * p.z + 1.0),
                                               std::sin(0.10 * p.x + 2.0));
        return std::sin(q.x) * std::cos(q.y) + std::sin(q.y) * std::cos(q.z) +
               std::sin(q.z) * std::cos(q.x);
    }

    void paintBrain() {
        const Shape inside = cavity();
        m.paint(inside, csfHu);
        const Shape cerebrum = intersected(
            grown(inside, -2.2),
            // The cerebrum rests on the tentorium posteriorly, and fills the fossae of the base
            // anteriorly.
            {[](const dvec3 &p) {
                 const double behind = std::clamp((p.y - 8.0) / 14.0, 0.0, 1.0);
                 return 0.8 * (-60.0 + 46.0 * behind + 0.35 * std::max(0.0, p.y - 20.0) - p.z);
             },
             {-80, -90, -60},
             {80, 110, 110}});
        const auto tissue = [cerebrum](const dvec3 &p) {
            const double depth = -cerebrum(p);
            const double fold =
                std::abs(gyri(p)) * 4.6; // approximate distance in mm from the middle of a sulcus
            const double reach = std::clamp((22.0 - depth) / 6.0, 0.0, 1.0);
            if (reach > 0.0 && fold < 1.1 * reach)
                return csfHu + 4.0;
            if (depth < 3.2 || (reach > 0.0 && fold < 1.1 * reach + 3.0))
                return greyHu;
            return whiteHu;
        };
        m.paint(cerebrum, tissue);
        // Longitudinal fissure with the falx; the tentorium below.
        m.paint(intersected(roundedBox({0, 8, 60}, {1.6, 84, 52}, 0.5), inside), csfHu);
        m.paint(intersected(roundedBox({0, 12, 68}, {0.7, 84, 42}, 0.3), inside), 58.0);
        // Corpus callosum, thalami, lentiform and caudate nuclei.
        m.paint(tube({{0, -22, 22}, {0, -16, 33}, {0, 8, 39}, {0, 30, 33}, {0, 36, 24}}, 4.5),
                whiteHu - 1);
        paintBoth(ellipsoid({11, 8, 18}, {8, 14, 9}), greyHu + 2);
        paintBoth(ellipsoid({24, -6, 16}, {7, 16, 9}), greyHu + 3);
        paintBoth(tube({{13, -24, 22}, {15, -8, 30}, {17, 12, 32}}, 4.5), greyHu + 2);
        // Lateral ventricles: frontal horn, body, atrium, occipital and temporal horns.
        paintBoth(tube({{8, -34, 18}, {9, -22, 26}, {10, 0, 32}, {14, 20, 30}, {22, 36, 20}}, 5.2),
                  fluidHu);
        paintBoth(tube({{22, 36, 20}, {21, 52, 16}, {19, 62, 14}}, 4.0), fluidHu);
        paintBoth(tube({{22, 36, 20}, {30, 28, 4}, {33, 10, -4}, {31, -6, -6}}, 3.0), fluidHu);
        m.paint(roundedBox({0, -4, 14}, {2.2, 16, 9}, 1.5), fluidHu);
        paintBoth(ellipsoid({22, 36, 22}, {2.5, 5, 4}), 90.0); // choroid plexus, slightly calcified
        m.paint(ellipsoid({0, 26, 14}, {2.5, 3, 2.5}), 180.0); // pineal
        // Cerebellum with its folia, brain stem, fourth ventricle.
        const Shape cerebellum =
            intersected(grown(inside, -2.0), united(ellipsoid({26, 56, -22}, {32, 30, 22}),
                                                    ellipsoid({-26, 56, -22}, {32, 30, 22}), 8));
        m.paint(cerebellum, [](const dvec3 &p) {
            const double leaf = std::sin(1.5 * (p.z + 0.25 * p.y + 2.0 * std::sin(0.12 * p.x)));
            return leaf > 0.82 ? csfHu + 6.0 : leaf < -0.35 ? whiteHu + 2 : greyHu;
        });
        m.paint(rod({0, 14, 4}, {0, 30, -44}, 13, 7), whiteHu + 3);
        m.paint(ellipsoid({0, 17, -16}, {15, 12, 12}), whiteHu + 3);
        m.paint(ellipsoid({0, 33, -18}, {6, 4, 9}), fluidHu);
        // Basilar artery and circle of Willis.
        m.paint(rod({0, 2, -28}, {0, 0, -4}, 2, 2), 60.0);
        paintBoth(tube({{0, -10, -2}, {10, -14, -2}, {24, -14, -1}, {38, -10, 2}}, 1.8), 60.0);
    }

    void paintOrbits() {
        const Shape orbit = united(ellipsoid({32, -74, 4}, {18, 13, 15.5}),
                                   rod({31, -66, 4}, {16, -36, 2}, 14, 4), 6);
        paintBoth(orbit, fatHu);
        paintBoth(ellipsoid({32, -80, 4}, {12.3, 12.3, 12.0}), 38.0);
        paintBoth(ellipsoid({32, -80, 4}, {11.2, 11.2, 11.0}), 12.0);
        paintBoth(ellipsoid({32, -88, 4}, {4.8, 2.2, 4.8}), 75.0);
        paintBoth(tube({{31, -68, 4}, {27, -58, 5}, {17, -38, 3}}, 2.4), 38.0);
        paintBoth(rod({44, -78, 4}, {17, -38, 2}, 2.2, 1.5), muscleHu);
        paintBoth(rod({20, -78, 4}, {15, -40, 2}, 2.2, 1.5), muscleHu);
        paintBoth(rod({32, -74, 16}, {17, -38, 5}, 2.0, 1.5), muscleHu);
        paintBoth(rod({32, -74, -8}, {17, -38, 0}, 2.0, 1.5), muscleHu);
    }

    void paintAirways() {
        // Nasal cavity with septum and turbinates.
        const Shape nasal = united(roundedBox({0, -62, -22}, {11, 26, 15}, 8),
                                   rod({0, -86, -26}, {0, -99, -30}, 8, 6), 4);
        m.paint(nasal, airHu);
        m.paint(intersected(roundedBox({0, -66, -18}, {1.1, 34, 20}, 0.6), grown(nasal, 0.5)),
                120.0);
        paintBoth(rod({8, -78, -30}, {8, -44, -30}, 3.6, 3.2), 50.0);
        paintBoth(rod({7, -74, -17}, {7, -46, -18}, 3.0, 2.6), 50.0);
        paintBoth(rod({9, -78, -30}, {9, -44, -30}, 1.0, 0.8), 350.0);
        // Sinuses.
        paintBoth(without(ellipsoid({28, -58, -22}, {13, 17, 15}),
                          rod({28, -58, -44}, {28, -58, -36}, 8, 8)),
                  airHu);
        paintBoth(ellipsoid({11, -80, 30}, {10, 3.6, 11}), airHu);
        paintBoth(ellipsoid({26, -77, 25}, {8, 3, 5}), airHu);
        paintBoth(ellipsoid({6.5, -20, -10}, {6, 9, 6.5}), airHu);
        for (int row = 0; row < 4; ++row)
            for (int level = 0; level < 3; ++level)
                paintBoth(ellipsoid({6.2, -67 + 11.0 * row + 3.0 * (level % 2),
                                     7.6 * level - 3.5 + 1.5 * (row % 2)},
                                    {3.4 + 0.5 * (row % 2), 4.9, 3.5}),
                          airHu);
        // Mastoid cells, ear canals, tympanic cavity.
        for (int n = 0; n < 14; ++n)
            paintBoth(ellipsoid({59.0 + 4.5 * std::sin(2.1 * n), 24.0 + 7.0 * std::cos(1.3 * n),
                                 -46.0 + 2.3 * n},
                                {2.6, 2.8, 2.4}),
                      airHu);
        paintBoth(tube({{54, 4, -15}, {66, 6, -14}, {84, 12, -10}}, 3.0), airHu);
        paintBoth(ellipsoid({50, 4, -15}, {3, 5, 6}), airHu);
        // Pharynx, mouth, larynx, trachea.
        m.paint(tube({{0, -32, -24}, {0, -22, -36}, {0, -14, -60}, {0, -12, -90}}, 7.0), airHu);
        m.paint(ellipsoid({0, -62, -49}, {20, 24, 2.5}), airHu);
        m.paint(rod({0, -16, -96}, {0, -14, -140}, 9.5, 9), 130.0);
        m.paint(rod({0, -16, -86}, {0, -14, -140}, 7.5, 7.5), airHu);
        m.paint(ellipsoid({0, -22, -84}, {9, 2, 8}), 70.0); // epiglottis
    }

    void paintTeeth() {
        // Widths from the central incisor to the second molar, along the dental arches.
        const std::initializer_list<double> widths{8.2, 6.8, 7.6, 7.0, 6.8, 9.6, 9.4};
        for (const bool upper : {true, false}) {
            double along = 0.0;
            int number = 0;
            for (const double width : widths) {
                const double scale = upper ? 1.0 : 0.92;
                const double at = (along + 0.5 * width) * scale;
                along += width;
                // The arch: a parabola, parametrised by arc length.
                const double curve = 0.028;
                double x = 0.0;
                for (double length = 0.0; length < at; x += 0.1)
                    length += 0.1 * std::sqrt(1.0 + 4.0 * curve * curve * x * x);
                const double y = (upper ? -87.0 : -84.0) + curve * x * x;
                const bool molar = number >= 5, premolar = number >= 3 && !molar;
                const double thick = (molar ? 0.48 : premolar ? 0.42 : 0.36) * width * scale;
                const double bite = upper ? -57.0 : -58.5, up = upper ? 1.0 : -1.0;
                const double crown = molar ? 6.0 : 8.0, root = number == 2 ? 18.0 : 13.0;
                const dvec3 tip(x, y, bite), neck(x, y + 1.0, bite + up * crown);
                const dvec3 end(x, y + 4.0, bite + up * (crown + root));
                if (molar) {
                    paintBoth(rod(neck + dvec3(2.2, 1, 0), end + dvec3(2.5, 1, -up * 3), 2.6, 1.2),
                              dentinHu);
                    paintBoth(
                        rod(neck + dvec3(-2.2, -1, 0), end + dvec3(-2.5, -1, -up * 3), 2.6, 1.2),
                        dentinHu);
                } else {
                    paintBoth(rod(neck, end, 0.36 * width, 1.2), dentinHu);
                }
                paintBoth(rod(tip + dvec3(0, 0, up * thick), neck, thick, thick * 0.95), enamelHu);
                paintBoth(
                    rod(tip + dvec3(0, 0, up * (thick + 2.0)), neck, thick - 1.3, thick - 1.2),
                    dentinHu);
                ++number;
            }
        }
        // One filling, so that the brightest object in the head is small, as in patients.
        m.paint(ellipsoid({-28.5, -64, -56}, {2.0, 2.2, 1.6}), 3000.0);
    }

    Painter &m;
};

} // namespace

volume::Volume makeHead(const volume::Lattice &lattice, const task::Progress &progress) {
    Painter painter(lattice, airHu, progress);
    Head(painter).paint();
    return painter.finish(
        7.0, 3, phantomNotes("Head phantom", {{40.0, 100.0, "Brain"}, {300.0, 1500.0, "Bone"}}));
}

} // namespace pellucid::phantom
