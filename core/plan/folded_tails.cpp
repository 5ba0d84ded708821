// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/folded_tails.h"

#include <algorithm>
#include <cmath>

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

double foldedTailEnergy(const EnergySpread &spread, double rollOff, double pixelMm, int period,
                        int side, double pan) {
    double most = 0.0;
    for (const auto &shares : spread.byDistance) {
        double sum = 0.0;
        for (std::size_t n = 0; n < shares.size(); ++n)
            if (shares[n] > 0.0) {
                const double x = (double(n) + 0.5) * spread.distanceStepMm / pixelMm;
                sum += shares[n] * tailInImage(rollOff, period, side, x + std::abs(pan));
            }
        most = std::max(most, sum);
    }
    const double margin = viewMargin + (pointMargin - viewMargin) * spread.concentration;
    return margin * most;
}

double shareInImage(const scene::Camera &camera, const EnergySpread &spread) {
    const double area = double(camera.width) * camera.height * camera.pixelMm * camera.pixelMm;
    return spread.shadowMm2 > area ? area / spread.shadowMm2 : 1.0;
}

double predictFoldedTails(const scene::ImageDefinition &image, const scene::Camera &camera,
                          int columns, int rows, const EnergySpread &spread) {
    const glm::dvec2 pan = camera.panMm / camera.pixelMm;
    const double folded =
        foldedTailEnergy(spread, image.rollOff, camera.pixelMm, columns, camera.width, pan.x) +
        foldedTailEnergy(spread, image.rollOff, camera.pixelMm, rows, camera.height, pan.y);
    return std::sqrt(folded / shareInImage(camera, spread));
}

} // namespace pellucid::plan
