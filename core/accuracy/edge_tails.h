// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include <glm/vec2.hpp>

#include "core/accuracy/slice_energies.h"

namespace pellucid::accuracy {

/// A picture and the period of its slice grid.
struct PeriodicWindow {
    glm::dvec2 windowMm{0.0}, periodMm{0.0};
    double pixelMm = 1.0;
};

/// Where the energy of a projection is, by coarse places within a period from the middle of the
/// picture.
class ProjectedPlaces {
public:
    struct Place {
        double energy = 0.0;
        glm::dvec2 momentMm{0.0};
    };

    void add(glm::dvec2 atMm, glm::dvec2 periodMm, double energy);
    const auto &places() const { return m_places; }

private:
    static constexpr int side = 32;
    std::array<Place, std::size_t(side) * side> m_places{};
};

/// The energy of the roll-off's tails that come back into the picture after a period. The response
/// of the band's disc to a point falls as r^-3/2, and faster where the roll-off is resolved. Its
/// part in a direction comes from the frequencies at the edge of the disc in that direction; thick
/// slices dim most of the edge and have tails in few directions. Places share these frequencies in
/// proportion to their energy. *Shape*: `edge`: see SliceEnergies. *Source*: stationary phase.
double edgeTails(const ProjectedPlaces &places, const PeriodicWindow &window, double rollOff,
                 const std::array<double, SliceEnergies::directions> &edge);

} // namespace pellucid::accuracy
