// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/classify/density_field.h"
#include "core/render/projection_engine.h"
#include "core/task/progress.h"

namespace pellucid::accuracy {

/// The line integrals of fields of one lattice along its three axes, through every sample.
class AxisProjections {
public:
    /// *Throws* Cancelled.
    void add(const classify::DensityField &field, const task::Progress &progress = {});
    std::size_t count() const { return m_planes.size(); }

private:
    friend class DetailLoss;
    /// *Shape*: rows of the lattice's higher other axis, columns of its lower one.
    struct Plane {
        int across = 0, down = 0, columns = 0, rows = 0;
        std::vector<double> values;
        double &at(int column, int row) { return values[std::size_t(row) * columns + column]; }
        double at(int column, int row) const { return values[std::size_t(row) * columns + column]; }
    };
    /// `beyond`: the number of extra samples on both sides, by axis.
    static Plane emptyPlane(int axis, const volume::Lattice &lattice,
                            const std::array<int, 3> &beyond = {});
    static Plane planeAlong(int axis, const classify::DensityField &field);

    volume::Lattice m_lattice;
    std::vector<std::array<Plane, 3>> m_planes; ///< of each field, by axis
};

/// The error of pictures of coarse fields against pictures of the original fields. It compares the
/// projections of both along the axes of the lattice, on the fine grid and beyond it as far as the
/// footprint of the outermost coarse samples, because a cut face of the volume is blurred to both
/// sides. Only inner products are kept; they give the loss of any weighted sum of the fields.
class DetailLoss {
public:
    /// `fine` and `coarse` hold `fields` densities, then the lengths of their gradients, if any.
    /// *Shape*: as many coarse as fine; the axes of both lattices have the same directions.
    /// *Units*: `stepMm` is the step of the light's differences.
    DetailLoss(const AxisProjections &fine, const AxisProjections &coarse, std::size_t fields,
               double stepMm);

    /// The relative L2 error of a whole coarse picture with these channel weights, this cue and
    /// light: that of the worst axis, with a margin for views between the axes. It applies to
    /// pixels the size of the samples; larger pixels lose less. *Shape*: one weight per field.
    double relativeError(std::span<const render::ChannelWeights> channelWeights,
                         const shading::Shading &shading) const;
    /// The same for a picture that may be a part of the whole: the part is charged with the loss of
    /// the whole.
    double relativeError(const picture::ProjectionImage &picture,
                         std::span<const render::ChannelWeights> channelWeights,
                         const shading::Shading &shading) const;

private:
    using Plane = AxisProjections::Plane;
    static Plane lossOf(const Plane &fine, const Plane &coarse, int axis,
                        const volume::Lattice &fineLattice, const volume::Lattice &coarseLattice);

    /// [a * count + b]: the integral of the product of two projections along an axis, over the
    /// plane.
    struct Products {
        std::vector<double> projections, losses;
        std::vector<double> slopes; ///< of the gradients of the losses, both components
    };
    struct Energies {
        double image = 0.0, error = 0.0;
    };
    Energies energiesAlong(const Products &products,
                           std::span<const render::ChannelWeights> channelWeights,
                           const shading::Shading &shading, int channels) const;
    std::size_t m_fields, m_count; ///< without and with gradients
    double m_stepMm;
    std::array<Products, 3> m_along;
};

} // namespace pellucid::accuracy
