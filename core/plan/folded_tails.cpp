// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/folded_tails.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pellucid::plan {

namespace {

// A bound on the energy of folded tails along one axis, averaged over phases. Lengths are in
// samples of the band. The response of a band that rolls off over its share F is
//   h(r) = sin(pi (1 - F/2) r) cos(pi F r/2) / (pi r (1 - (F r)^2)),
// at most E(r) = min(1, 1/|(F r)^2 - 1|) / (pi r). For samples on a length l with a share e of the
// energy, |sum E p|^2 <= e l E^2 (Cauchy-Schwarz), and the amplitudes of several lengths and of the
// copies on both sides add up: so they do if a line of a regular pattern's spectrum lies in the
// roll-off. On average over the phases of sine and cosine, a quarter of that is left. Only
// frequencies in the roll-off have tails; `roughestView` bounds their share.
double tailEnergy(const field::EnergySpread &spread, double rollOff, double bandMm, double period,
                  double side, double pan) {
    // The least that second differences pass of a frequency in the roll-off. The minimum is along
    // an axis of the lattice or midway between all three.
    const double f = std::numbers::pi *
                     std::min(0.5, 0.5 * (1.0 - rollOff) * spread.shortestStepMm / bandMm),
                 along = std::pow(std::sin(f), 4),
                 between = 3.0 * std::pow(std::sin(f / std::numbers::sqrt3), 4),
                 share =
                     std::min(1.0, spread.roughestView / std::max(1e-12, std::min(along, between)));
    const auto tail = [&](double r) {
        const double far = std::max(1.0, r), u = rollOff * far;
        return 1.0 / (std::numbers::pi * far * std::max(1.0, u * u - 1.0));
    };
    // The tails of two samples, at x and -x.
    const auto tails = [&](double r, double x) {
        return std::sqrt(tail(r - x) * tail(r - x) + tail(r + x) * tail(r + x));
    };
    constexpr std::size_t bins = 16; // of the profiles
    double most = 0.0;
    for (const auto &shares : spread.byDistance) {
        const std::size_t joined = (shares.size() + bins - 1) / bins;
        const double length = std::max(1.0, double(joined) * spread.distanceStepMm / bandMm);
        std::array<double, bins> amplitudes{};
        for (std::size_t n = 0; n < shares.size(); ++n)
            amplitudes[n / joined] += length * shares[n];
        for (double &amplitude : amplitudes)
            amplitude = std::sqrt(amplitude);
        // From the edge next to a copy to the middle, in ever wider parts. In each, and in each bin
        // of the profile, the nearest point counts.
        double sum = 0.0;
        for (double from = 0.0, width = 1.0; from < 0.5 * side; from += width, width *= 1.5) {
            const double y = 0.5 * side - from;
            double amplitude = 0.0;
            for (std::size_t n = 0; n < amplitudes.size(); ++n)
                if (amplitudes[n] > 0.0) {
                    const double x = double((n + 1) * joined) * spread.distanceStepMm / bandMm;
                    amplitude +=
                        amplitudes[n] * (tails(period - pan - y, x) + tails(period - pan + y, x));
                }
            sum += std::min(width, 0.5 * side - from) * amplitude * amplitude;
        }
        most = std::max(most, 2.0 * sum);
    }
    return 0.25 * share * most;
}

} // namespace

double foldedTailEnergy(const field::EnergySpread &spread, const scene::ImageDefinition &image,
                        double pixelMm, int period, int side, double pan) {
    const double imageTails =
        tailEnergy(spread, image.rollOff, pixelMm, period, side, std::abs(pan));
    // The lattice's own band also ends in a roll-off along each of its axes.
    const double scale = pixelMm / spread.longestStepMm;
    const bool isTapered =
        image.reconstruction == scene::Reconstruction::bandLimited && scale <= 1.0;
    const double latticeTails =
        isTapered ? tailEnergy(spread, image.rollOff, spread.longestStepMm, scale * period,
                               scale * side, scale * std::abs(pan))
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
