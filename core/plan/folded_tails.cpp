// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/folded_tails.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pellucid::plan {

namespace {

// The energy of the worst views of the bench's fields over the expected energy. Noise scatters by
// 1.3. Regular patterns have lines at the edge of the band in some views. A field within one block
// depends on few frequencies.
constexpr double viewMargin = 2.1, pointMargin = 6.0;

// The share of a point's energy more than r pixels away along an image axis, on one side, averaged
// over both sides. The cubic and the quotient fit the integral of the squared response to within a
// fifth. The factor was fitted to noise that fills a sphere: predicted over measured is 0.95 to 1.2
// from 2e-2 down to 2e-6.
double tailEnergy(double rollOff, double r) {
    const double x = rollOff * r;
    const double near = std::max(0.0, 1.0 - x / 2.4);
    return 0.11 / r * (near * near * near + 0.1 / (5.0 + x * x * x * x));
}

// The energy of the tails of a regular pattern. If a line of its spectrum is within the roll-off,
// the tails of all its samples add up in phase. Lengths are in samples of the band. A sample's tail
// has the amplitude E(r), which falls as 1/r, and as 1/r^3 where the roll-off is resolved. It is a
// sum of two waves, with the frequencies at which the roll-off begins and ends; a line is in phase
// with one of them. For samples on a length l, with a share e of the energy,
//   |sum E p|^2 <= e l E^2 (Cauchy-Schwarz),
// and the amplitudes of several lengths add up. In a projection without negative samples a line has
// at most a third of the energy, as in a comb; `roughestView` may be a tighter bound. The factor of
// E was compared with exact sums for combs of 8 to 256 samples at frequencies throughout the
// roll-off, for F = 0.01 to 0.5: below 1e-2 they are 0.2 to 0.95 times this bound. No length counts
// as shorter than `minLength`.
double regularTailEnergy(const field::EnergySpread &spread, double rollOff, double bandMm,
                         double period, double side, double pan, double minLength = 0.0) {
    // The least that second differences pass of a frequency in the roll-off. The minimum is along
    // an axis of the lattice or midway between all three.
    const double f = std::numbers::pi *
                     std::min(0.5, 0.5 * (1.0 - rollOff) * spread.shortestStepMm / bandMm),
                 along = std::pow(std::sin(f), 4),
                 between = 3.0 * std::pow(std::sin(f / std::numbers::sqrt3), 4),
                 share = std::min(1.0, 3.0 * spread.roughestView /
                                           std::max(1e-12, std::min(along, between)));
    const auto squaredTail = [&](double r) {
        const double far = std::max(1.0, r), u = rollOff * far;
        const double envelope = u < 1.09 ? 2.7 : 0.5 / (u * u - 1.0); // equal where they meet
        const double tail = envelope / (std::numbers::pi * far);
        return tail * tail;
    };
    // Numbers of bins of the profiles and of positions in the image.
    constexpr std::size_t bins = 16, places = 8;
    double most = 0.0;
    for (const auto &shares : spread.byDistance) {
        const std::size_t joined = std::max<std::size_t>(1, shares.size() / bins);
        const double length = std::max(minLength, double(joined) * spread.distanceStepMm / bandMm);
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
    // Copies come from both sides and overlap the image over part of the ring, and of the depth
    // over which the response falls.
    const auto tail = [&](double pixels) {
        const double r = std::max(1.0, pixels);
        return tailEnergy(rollOff, r) * side / (side + 2.0 * r) * side / (side + 0.12 * r);
    };
    return 0.5 * (tail(reach - offset) + tail(reach + offset));
}

double foldedTailEnergy(const field::EnergySpread &spread, const scene::ImageDefinition &image,
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
    const double imageTails =
        std::max(margin * most,
                 regularTailEnergy(spread, image.rollOff, pixelMm, period, side, std::abs(pan)));
    // The lattice's own band also ends in a roll-off along each of its axes. There the tail of a
    // point stays in one line, and has the energy of a comb of five samples.
    constexpr double pointLength = 5.0;
    const double scale = pixelMm / spread.longestStepMm;
    const bool isTapered =
        image.reconstruction == scene::Reconstruction::bandLimited && scale < 1.0;
    const double latticeTails =
        isTapered ? regularTailEnergy(spread, image.rollOff, spread.longestStepMm, scale * period,
                                      scale * side, scale * std::abs(pan), pointLength)
                  : 0.0;
    return imageTails + latticeTails +
           2.0 * std::sqrt(imageTails * latticeTails); // amplitudes add up
}

double shareInImage(const scene::Camera &camera, const field::EnergySpread &spread) {
    const double area = double(camera.width) * camera.height * camera.pixelMm * camera.pixelMm;
    return spread.shadowMm2 > area ? area / spread.shadowMm2 : 1.0;
}

double predictFoldedTails(const scene::ImageDefinition &image, const scene::Camera &camera,
                          int columns, int rows, const field::EnergySpread &spread) {
    const glm::dvec2 pan = camera.panMm / camera.pixelMm;
    const double folded =
        foldedTailEnergy(spread, image, camera.pixelMm, columns, camera.width, pan.x) +
        foldedTailEnergy(spread, image, camera.pixelMm, rows, camera.height, pan.y);
    return std::sqrt(folded / shareInImage(camera, spread));
}

} // namespace pellucid::plan
