// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error/shown_rows.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/classify/color_basis.h"

namespace pellucid::error {

namespace {

// The cue is read from a table by linear interpolation. A curve's fastest cosine makes 1.75 turns
// over the depths, so that its error there is below 1e-8.
constexpr int cueSteps = 1 << 16;

using Rgb = std::array<double, 3>;

volume::VoxelBox boxOf(std::span<const classify::DensityField> fields, int beyond) {
    volume::VoxelBox box = fields.front().support;
    for (const classify::DensityField &field : fields)
        box = volume::united(box, field.support);
    return {{box.lo.i - beyond, box.lo.j - beyond, box.lo.k - beyond},
            {box.hi.i + beyond, box.hi.j + beyond, box.hi.k + beyond}};
}

} // namespace

ShownRows::ShownRows(std::span<const classify::DensityField> fields,
                     std::span<const Rgb> channelWeights, const shading::Shading &shading,
                     const glm::dmat3 &axes, const shading::ShadingScale &scale)
    : m_fields(fields), m_isLit(shading.isLit()), m_ambient(shading.ambient) {
    m_box = boxOf(fields, m_isLit ? 1 : 0);
    if (std::all_of(channelWeights.begin(), channelWeights.end(),
                    [](const Rgb &weight) { return weight == Rgb{}; }))
        return;
    classify::ColorBasis basis = classify::colorBasis(channelWeights);
    // Light is not linear in the fields: each channel has its own, unless they differ by a factor.
    if (m_isLit && (basis.colors.size() > 1 || !shading.isGrey()))
        basis = {{classify::ColorBasis::primaries.begin(), classify::ColorBasis::primaries.end()},
                 {channelWeights.begin(), channelWeights.end()}};
    m_images.resize(basis.colors.size());
    for (std::size_t n = 0; n < m_images.size(); ++n) {
        m_images[n].color = basis.colors[n];
        for (const auto &amounts : basis.amounts)
            m_images[n].weights.push_back(amounts[n]);
    }
    const volume::Lattice &lattice = this->lattice();
    if (m_isLit) {
        // g = stepMm sum_d b_d (f[n+1] - f[n-1])/2, b_d the rows of the steps' inverse.
        const glm::dmat3 inverse = glm::transpose(
            glm::inverse(glm::dmat3(lattice.step(0), lattice.step(1), lattice.step(2))));
        for (int d = 0; d < 3; ++d)
            m_gradientAxes[std::size_t(d)] = 0.5 * scale.stepMm * inverse[d];
        for (const shading::Light &light : shading.lights) {
            const glm::dvec3 along = glm::normalize(light.direction),
                             towards =
                                 light.frame == shading::LightFrame::viewer ? axes * along : along;
            const Rgb color{light.color.red, light.color.green, light.color.blue};
            for (std::size_t n = 0; n < m_images.size(); ++n) {
                const double half = 0.5 * light.strength * color[n]; // one image: grey light
                m_images[n].length += half;
                for (int d = 0; d < 3; ++d)
                    m_images[n].gradient[d] -=
                        half * glm::dot(m_gradientAxes[std::size_t(d)], towards);
            }
        }
    }
    if (!shading.cue.isActive())
        return;
    const glm::dvec3 fromCenter =
        lattice.patient(volume::VoxelIndex{0, 0, 0}).mm - lattice.center().mm;
    m_originDepth = glm::dot(axes[2], fromCenter) / scale.radiusMm;
    double low = m_originDepth, high = m_originDepth;
    const glm::dvec3 from(m_box.lo.i, m_box.lo.j, m_box.lo.k),
        to(m_box.hi.i - 1, m_box.hi.j - 1, m_box.hi.k - 1);
    for (int d = 0; d < 3; ++d) {
        m_depthPerSample[d] = glm::dot(axes[2], lattice.step(d)) / scale.radiusMm;
        low += std::min(from[d] * m_depthPerSample[d], to[d] * m_depthPerSample[d]);
        high += std::max(from[d] * m_depthPerSample[d], to[d] * m_depthPerSample[d]);
    }
    m_firstDepth = low;
    m_stepsPerDepth = cueSteps / std::max(high - low, 1e-9);
    const auto cue = shading::cueFunction(shading.cue);
    for (int n = 0; n < cueSteps + 2; ++n) // the last depth may round up
        m_cue.push_back(float(cue(low + n / m_stepsPerDepth)));
}

void ShownRows::read(int j, int k, Buffers &buffers, const std::array<float *, 3> &rows) const {
    for (std::size_t n = 0; n < m_images.size(); ++n) {
        readMixed(m_images[n], j, k, buffers, rows[n]);
        if (m_isLit)
            light(m_images[n], j, k, buffers, rows[n]);
        if (!m_cue.empty())
            applyCue(j, k, rows[n]);
    }
}

// Zero beyond the lattice.
void ShownRows::readMixed(const Image &image, int j, int k, Buffers &buffers, float *to) const {
    const int count = m_box.size().i;
    const volume::GridSize size = lattice().size();
    std::fill_n(to, count, 0.0F);
    if (j < 0 || k < 0 || j >= size.j || k >= size.k)
        return;
    const int first = std::max(0, m_box.lo.i), last = std::min(size.i, m_box.hi.i);
    buffers.field.resize(std::size_t(count));
    float *const inside = to + (first - m_box.lo.i);
    for (std::size_t f = 0; f < m_fields.size(); ++f) {
        const auto weight = float(image.weights[f]);
        if (weight == 0.0F)
            continue;
        const float *const row =
            m_fields[f].values.row({first, j, k}, last - first, buffers.field.data());
        for (int i = 0; i < last - first; ++i)
            inside[i] += weight * row[i];
    }
}

void ShownRows::light(const Image &image, int j, int k, Buffers &buffers, float *row) const {
    const int count = m_box.size().i;
    for (auto &neighbour : buffers.around)
        neighbour.resize(std::size_t(count));
    auto &[above, below, behind, before] = buffers.around;
    readMixed(image, j - 1, k, buffers, above.data());
    readMixed(image, j + 1, k, buffers, below.data());
    readMixed(image, j, k - 1, buffers, behind.data());
    readMixed(image, j, k + 1, buffers, before.data());
    // The field is zero at the ends of the box, and beyond them.
    buffers.other.assign(row, row + count);
    const float *const f = buffers.other.data();
    const glm::vec3 a(m_gradientAxes[0]), b(m_gradientAxes[1]), c(m_gradientAxes[2]),
        g(image.gradient);
    const auto length = float(image.length), ambient = float(m_ambient);
    const auto lit = [&](int i, float left, float right) {
        const float x = right - left, y = below[std::size_t(i)] - above[std::size_t(i)],
                    z = before[std::size_t(i)] - behind[std::size_t(i)];
        const float u = a.x * x + b.x * y + c.x * z, v = a.y * x + b.y * y + c.y * z,
                    w = a.z * x + b.z * y + c.z * z;
        return ambient * f[i] + length * std::sqrt(u * u + v * v + w * w) + g.x * x + g.y * y +
               g.z * z;
    };
    row[0] = lit(0, 0.0F, f[1]);
    for (int i = 1; i < count - 1; ++i)
        row[i] = lit(i, f[i - 1], f[i + 1]);
    row[count - 1] = lit(count - 1, f[count - 2], 0.0F);
}

void ShownRows::applyCue(int j, int k, float *row) const {
    const int count = m_box.size().i;
    const double first = (m_originDepth + m_box.lo.i * m_depthPerSample.x + j * m_depthPerSample.y +
                          k * m_depthPerSample.z - m_firstDepth) *
                         m_stepsPerDepth,
                 step = m_depthPerSample.x * m_stepsPerDepth;
    const float *const cue = m_cue.data();
    for (int i = 0; i < count; ++i) {
        const double at = std::max(0.0, first + i * step);
        const int below = std::min(int(at), cueSteps);
        const auto part = float(at - below);
        row[i] *= cue[below] + part * (cue[below + 1] - cue[below]);
    }
}

} // namespace pellucid::error
