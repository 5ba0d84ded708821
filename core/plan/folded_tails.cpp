// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/folded_tails.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pellucid::plan {

namespace {

// The worst of some views of the bench's fields over what is expected, as energy: noise scatters by
// 1.3, regular patterns have their lines at the edge of some views' bands; and a field that lies in
// one block, which a few frequencies decide.
constexpr double viewMargin = 2.1, pointMargin = 6.0;

// The part of a point's energy that lies more than r pixels away along an image axis, on one of its
// two sides, averaged over both. The cubic and the quotient fit the integral of the square of the
// response to a fifth; the factor was fitted to noise that fills a sphere: predicted over measured
// is 0.95 to 1.2 from 2e-2 down to 2e-6.
double tailEnergy(double rollOff, double r) {
    const double x = rollOff * r;
    const double near = std::max(0.0, 1.0 - x / 2.4);
    return 0.11 / r * (near * near * near + 0.1 / (5.0 + x * x * x * x));
}

// The energy that the tails of a regular pattern leave. If a line of its spectrum lies within the
// roll-off, the tails of all its samples add up in phase. Lengths are in samples of the band. A
// sample's tail has the amplitude E(r), which falls as 1/r, and as 1/r^3 where the roll-off is
// resolved; it is a sum of two waves, of the frequencies where the roll-off begins and ends, and a
// line is in phase with one of them. Of the samples of a stretch of length l, with a share e of the
// energy,
//   |sum E p|^2 <= e l E^2 (Cauchy and Schwarz),
// and stretches add up in amplitude. A line has a third of the energy of a projection without
// negative samples at most, a comb's; `roughestView` may bound it closer. The factor of E was
// compared with the exact sums of combs of 8 to 256 samples at frequencies all over the roll-off,
// for F = 0.01 to 0.5: as soon as they are below 1e-2, they are 0.2 to 0.95 of what it gives. No
// stretch counts as shorter than `leastLength`.
double regularTailEnergy(const EnergySpread &spread, double rollOff, double bandMm, double period,
                         double side, double pan, double leastLength = 0.0) {
    // The least that second differences pass of a frequency in the roll-off: it lies along an axis
    // of the lattice or midway between all three.
    const double f = std::numbers::pi *
                     std::min(0.5, 0.5 * (1.0 - rollOff) * spread.shortestStepMm / bandMm),
                 along = std::pow(std::sin(f), 4),
                 between = 3.0 * std::pow(std::sin(f / std::numbers::sqrt3), 4),
                 share = std::min(1.0, 3.0 * spread.roughestView /
                                           std::max(1e-12, std::min(along, between)));
    const auto squaredTail = [&](double r) {
        const double far = std::max(1.0, r), u = rollOff * far;
        const double envelope = u < 1.09 ? 2.7 : 0.5 / (u * u - 1.0); // the same where they meet
        const double tail = envelope / (std::numbers::pi * far);
        return tail * tail;
    };
    // Pieces of the profiles, and places in the image.
    constexpr std::size_t bins = 16, places = 8;
    double most = 0.0;
    for (const auto &shares : spread.byDistance) {
        const std::size_t joined = std::max<std::size_t>(1, shares.size() / bins);
        const double length =
            std::max(leastLength, double(joined) * spread.distanceStepMm / bandMm);
        double squares = 0.0;
        for (std::size_t place = 0; place < places; ++place) {
            const double y = pan + side * ((double(place) + 0.5) / places - 0.5);
            double amplitude = 0.0;
            for (std::size_t n = 0; n < shares.size(); n += joined) {
                double energy = 0.0;
                for (std::size_t m = n; m < std::min(n + joined, shares.size()); ++m)
                    energy += shares[m];
                if (energy == 0.0)
                    continue;
                const double x = double(n + joined) * spread.distanceStepMm / bandMm; // outer end
                amplitude += std::sqrt(energy * length *
                                       (squaredTail(period - y - x) + squaredTail(period - y + x)));
            }
            squares += amplitude * amplitude;
        }
        most = std::max(most, squares / places);
    }
    return 0.25 * share * side * 2.0 * most;
}

} // namespace

double tailInImage(double rollOff, int period, int side, double offset) {
    const double reach = period - 0.5 * side;
    // Copies come from both sides, and land within the image: a part of the ring, and of the depth
    // over which the response falls.
    const auto tail = [&](double pixels) {
        const double r = std::max(1.0, pixels);
        return tailEnergy(rollOff, r) * side / (side + 2.0 * r) * side / (side + 0.12 * r);
    };
    return 0.5 * (tail(reach - offset) + tail(reach + offset));
}

double foldedTailEnergy(const EnergySpread &spread, const scene::ImageDefinition &image,
                        double pixelMm, int period, int side, double pan) {
    double most = 0.0;
    for (const auto &shares : spread.byDistance) {
        double sum = 0.0;
        for (std::size_t n = 0; n < shares.size(); ++n)
            if (shares[n] > 0.0) {
                const double x = (double(n) + 0.5) * spread.distanceStepMm / pixelMm;
                sum += shares[n] * tailInImage(image.rollOff, period, side, x + std::abs(pan));
            }
        most = std::max(most, sum);
    }
    const double margin = viewMargin + (pointMargin - viewMargin) * spread.concentration;
    const double ofImage = std::max(margin * most, regularTailEnergy(spread, image.rollOff, pixelMm,
                                                                     period, side, std::abs(pan)));
    // The lattice's own band ends in a roll-off too, along each of its axes: there a point's tail
    // stays in one line, and has the energy of a comb of five samples.
    constexpr double pointLength = 5.0;
    const double scale = pixelMm / spread.longestStepMm;
    const bool isTapered =
        image.reconstruction == scene::Reconstruction::bandLimited && scale < 1.0;
    const double ofLattice =
        isTapered ? regularTailEnergy(spread, image.rollOff, spread.longestStepMm, scale * period,
                                      scale * side, scale * std::abs(pan), pointLength)
                  : 0.0;
    return ofImage + ofLattice + 2.0 * std::sqrt(ofImage * ofLattice); // amplitudes add up
}

double shareInImage(const scene::Camera &camera, const EnergySpread &spread) {
    const double area = double(camera.width) * camera.height * camera.pixelMm * camera.pixelMm;
    return spread.shadowMm2 > area ? area / spread.shadowMm2 : 1.0;
}

double predictFoldedTails(const scene::ImageDefinition &image, const scene::Camera &camera,
                          int columns, int rows, const EnergySpread &spread) {
    const glm::dvec2 pan = camera.panMm / camera.pixelMm;
    const double folded =
        foldedTailEnergy(spread, image, camera.pixelMm, columns, camera.width, pan.x) +
        foldedTailEnergy(spread, image, camera.pixelMm, rows, camera.height, pan.y);
    return std::sqrt(folded / shareInImage(camera, spread));
}

} // namespace pellucid::plan
