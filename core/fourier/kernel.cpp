// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/kernel.h"

#include <array>
#include <cmath>
#include <numbers>

namespace pellucid::fourier {

namespace {

constexpr double pi = std::numbers::pi;

double exponentialSemicircleValue(double t, double width, double b) {
    const double x = 2.0 * t / width;
    return std::exp(b * (std::sqrt(std::max(0.0, 1.0 - x * x)) - 1.0));
}

// Monomial coefficients of the polynomial through the Chebyshev nodes of [-1/2, 1/2]: within a
// small factor of the best uniform fit, and stable at the degrees used here.
std::vector<double> fitPolynomial(int degree, const auto &function) {
    const int count = degree + 1;
    std::vector<double> nodes(count), table(count);
    for (int n = 0; n < count; ++n) {
        nodes[n] = 0.5 * std::cos(pi * (n + 0.5) / count);
        table[n] = function(nodes[n]);
    }
    for (int level = 1; level < count; ++level) // divided differences
        for (int n = count - 1; n >= level; --n)
            table[n] = (table[n] - table[n - 1]) / (nodes[n] - nodes[n - level]);
    std::vector<double> monomials(count, 0.0);
    for (int n = count - 1; n >= 0; --n) { // multiply by (c - nodes[n]), add table[n]
        for (int m = count - 1; m > 0; --m)
            monomials[m] = monomials[m - 1] - nodes[n] * monomials[m];
        monomials[0] = table[n] - nodes[n] * monomials[0];
    }
    return monomials;
}

// Gauss-Legendre on [-1/2, 1/2], 12 points: exact to rounding for the product of a kernel piece and
// a cosine that turns less than half way within a cell.
struct Quadrature {
    std::array<double, 12> at{}, weight{};
    Quadrature() {
        constexpr int n = 12;
        for (int i = 0; i < n; ++i) {
            double x = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1.0;
            for (int step = 0; step < 20; ++step) {
                double p0 = 1.0, p1 = x;
                for (int k = 2; k <= n; ++k) {
                    const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                    p0 = p1;
                    p1 = p2;
                }
                slope = n * (x * p1 - p0) / (x * x - 1.0);
                x -= p1 / slope;
            }
            at[i] = 0.5 * x;
            weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
        }
    }
};

} // namespace

Kernel::Kernel(std::string name, int width, int degree,
               double (*shape)(double t, double width, double b), double b)
    : m_name(std::move(name)), m_width(width), m_degree(degree) {
    for (int k = 0; k < width; ++k) {
        const double middle = k - 0.5 * (width - 1);
        const auto piece =
            fitPolynomial(degree, [&](double c) { return shape(middle + c, width, b); });
        m_coefficients.insert(m_coefficients.end(), piece.begin(), piece.end());
    }
    m_singles.assign(m_coefficients.begin(), m_coefficients.end());
}

Kernel Kernel::exponentialSemicircle(int width, double padding) {
    const double b = 0.976 * pi * width * (1.0 - 1.0 / (2.0 * padding));
    // Degree width + 3 keeps the jump between neighbouring pieces below the ghosts of the kernel.
    return Kernel("ES" + std::to_string(width), width, width + 3, exponentialSemicircleValue, b);
}

double Kernel::value(double t) const {
    const double half = 0.5 * m_width;
    if (std::abs(t) > half)
        return 0.0;
    const int k = std::min(m_width - 1, int(std::floor(t + half)));
    const double c = t - (k - 0.5 * (m_width - 1));
    const double *p = m_coefficients.data() + std::size_t(k) * (m_degree + 1);
    double sum = p[m_degree];
    for (int n = m_degree - 1; n >= 0; --n)
        sum = sum * c + p[n];
    return sum;
}

double Kernel::apodisation(double x, int padded) const {
    static const Quadrature quadrature;
    double sum = 0.0;
    for (int k = 0; k < m_width; ++k)
        for (std::size_t n = 0; n < quadrature.at.size(); ++n) {
            const double t = k - 0.5 * (m_width - 1) + quadrature.at[n];
            sum += quadrature.weight[n] * value(t) * std::cos(2.0 * pi * t * x / padded);
        }
    return sum;
}

} // namespace pellucid::fourier
