// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/kernels/piecewise_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fourier/kernels/quadrature.h"

namespace pellucid::fourier {

namespace {

double horner(const std::vector<double> &p, double c) {
    double sum = 0.0;
    for (auto it = p.rbegin(); it != p.rend(); ++it)
        sum = sum * c + *it;
    return sum;
}

} // namespace

PiecewiseKernel::PiecewiseKernel(std::vector<std::vector<double>> pieces, Parity parity)
    : m_parity(parity), m_pieces(std::move(pieces)) {
    const int width = int(m_pieces.size());
    std::size_t most = 1;
    for (const auto &p : m_pieces)
        most = std::max(most, p.size());
    m_terms = int(most + 1) / 2;
    for (int k = 0; k < (width + 1) / 2; ++k)
        for (const std::size_t odd : {std::size_t(0), std::size_t(1)})
            for (int n = 0; n < m_terms; ++n) {
                const std::size_t power = 2 * std::size_t(n) + odd;
                m_pairs.push_back(power < m_pieces[k].size() ? float(m_pieces[k][power]) : 0.0F);
            }
    // Sixteen points per cell integrate the cosine of an alias five periods away to rounding.
    static const GaussLegendre<double> quadrature(16);
    for (int k = width / 2; k < width; ++k)
        for (std::size_t n = 0; n < quadrature.at.size(); ++n) {
            const double t = k - 0.5 * (width - 1) + quadrature.at[n];
            const bool middle = 2 * k == width - 1; // its negative half is integrated, too
            m_nodes.push_back(2.0 * std::numbers::pi * t);
            const double value = horner(m_pieces[k], quadrature.at[n]);
            const double weight = (middle ? 1.0 : 2.0) * quadrature.weight[n];
            m_weighted.push_back(weight * value);
            m_energy += weight * value * value;
        }
}

double PiecewiseKernel::value(double t) const {
    const double half = 0.5 * width();
    if (std::abs(t) > half)
        return 0.0;
    const int k = std::min(width() - 1, int(std::floor(t + half)));
    return horner(m_pieces[k], t - (k - 0.5 * (width() - 1)));
}

double PiecewiseKernel::transform(double x) const {
    double sum = 0.0;
    if (m_parity == Parity::even)
        for (std::size_t n = 0; n < m_nodes.size(); ++n)
            sum += m_weighted[n] * std::cos(m_nodes[n] * x);
    else
        for (std::size_t n = 0; n < m_nodes.size(); ++n)
            sum += m_weighted[n] * std::sin(m_nodes[n] * x);
    return sum;
}

} // namespace pellucid::fourier
