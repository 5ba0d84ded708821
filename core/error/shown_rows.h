// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/classify/density_field.h"
#include "core/shading/slice_shading.h"

namespace pellucid::error {

/// The samples whose projections make a picture, as `scene::ImageDefinition` and
/// `shading::Shading` define it, row by row: fields of one lattice, weighted, cued and lit. They
/// are computed as they are read; nothing of the size of the volume is held.
class ShownRows {
public:
    /// *Shape*: one entry of `channelWeights` for each field, red, green and blue; axes [U V W].
    /// *Units*: as of `shading::ShadingScale`. *Requires*: the fields outlive this object.
    ShownRows(std::span<const classify::DensityField> fields,
              std::span<const std::array<double, 3>> channelWeights,
              const shading::Shading &shading, const glm::dmat3 &axes,
              const shading::ShadingScale &scale);

    /// The images that are summed separately, at most three, and the share of each in a channel of
    /// the picture: red, green and blue, which are equal in a grey one.
    int images() const { return int(m_images.size()); }
    double share(int image, int channel) const {
        return m_images[std::size_t(image)].color[std::size_t(channel)];
    }
    /// The box that contains all samples that are not zero; it may exceed the lattice by one sample
    /// on every side, where only the gradient is not zero.
    const volume::VoxelBox &box() const { return m_box; }
    const volume::Lattice &lattice() const { return m_fields.front().values.lattice(); }

    /// Memory for the rows that are read at a time; each thread has its own.
    struct Buffers {
        std::vector<float> field, other;
        std::array<std::vector<float>, 4> around;
    };
    /// The samples of a row of the box in each image. *Shape*: `rows`: one of the box's length for
    /// each image.
    void read(int j, int k, Buffers &buffers, const std::array<float *, 3> &rows) const;

private:
    /// One image: how it is mixed from the fields, and its light.
    struct Image {
        std::vector<double> weights;   ///< of each field
        std::array<double, 3> color{}; ///< its share in red, green and blue
        double length = 0.0;           ///< the factor of |g|
        glm::dvec3 gradient{0.0};      ///< of the central differences along the axes
    };
    void readMixed(const Image &image, int j, int k, Buffers &buffers, float *to) const;
    void light(const Image &image, int j, int k, Buffers &buffers, float *row) const;
    void applyCue(int j, int k, float *row) const;

    std::span<const classify::DensityField> m_fields;
    volume::VoxelBox m_box;
    std::vector<Image> m_images;
    bool m_isLit = false;
    double m_ambient = 1.0;
    std::array<glm::dvec3, 3> m_gradientAxes{}; ///< g per central difference along each axis
    /// The cue at even steps over the depths of the box; empty: none.
    std::vector<float> m_cue;
    double m_firstDepth = 0.0, m_stepsPerDepth = 0.0;
    glm::dvec3 m_depthPerSample{0.0};
    double m_originDepth = 0.0; ///< of sample (0, 0, 0)
};

} // namespace pellucid::error
