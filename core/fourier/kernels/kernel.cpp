// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/kernels/kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace pellucid::fourier {

namespace {

constexpr double pi = std::numbers::pi;

// The monomial coefficients of the polynomial through the Chebyshev nodes of [-1/2, 1/2]: within a
// small factor of the best uniform fit, and numerically stable at the degrees used here.
std::vector<double> fitPolynomial(int degree, const std::function<double(double)> &function) {
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

} // namespace

Kernel::Kernel(std::string name, std::vector<std::vector<double>> pieces)
    : m_name(std::move(name)), m_shape(std::move(pieces), Parity::even) {
    assert(width() >= 1 && width() <= largestWidth && terms() <= largestTerms);
}

Kernel Kernel::fitted(std::string name, int width, int degree,
                      const std::function<double(double)> &shape) {
    std::vector<std::vector<double>> pieces(width);
    for (int k = 0; k < (width + 1) / 2; ++k) {
        const double middle = k - 0.5 * (width - 1);
        pieces[k] = fitPolynomial(degree, [&](double c) { return shape(middle + c); });
        if (2 * k == width - 1)
            for (int n = 1; n <= degree; n += 2)
                pieces[k][n] = 0.0;
        pieces[width - 1 - k] = pieces[k];
        for (int n = 1; n <= degree; n += 2)
            pieces[width - 1 - k][n] = -pieces[k][n];
    }
    return Kernel(std::move(name), std::move(pieces));
}

Kernel Kernel::nearest() {
    return fitted("nearest", 1, 0, [](double) { return 1.0; });
}

Kernel Kernel::trilinear() {
    return fitted("trilinear", 2, 1, [](double t) { return 1.0 - std::abs(t); });
}

Kernel Kernel::catmullRom() {
    return fitted("catmull-rom", 4, 3, [](double t) {
        const double a = std::abs(t);
        return a < 1.0 ? (1.5 * a - 2.5) * a * a + 1.0 : ((2.5 - 0.5 * a) * a - 4.0) * a + 2.0;
    });
}

Kernel Kernel::cubicBSpline() {
    return fitted("b-spline", 4, 3, [](double t) {
        const double a = std::abs(t);
        return a < 1.0 ? 2.0 / 3.0 - a * a * (1.0 - 0.5 * a)
                       : (2.0 - a) * (2.0 - a) * (2.0 - a) / 6.0;
    });
}

Kernel Kernel::hammingSinc() {
    return fitted("hamming-sinc", 5, 9, [](double t) {
        const double window = 25.0 / 46.0 + 21.0 / 46.0 * std::cos(2.0 * pi * t / 5.0);
        return window * (std::abs(t) < 1e-9 ? 1.0 : std::sin(pi * t) / (pi * t));
    });
}

Kernel Kernel::exponentialSemicircle(int width, double padding) {
    const double b = 0.976 * pi * width * (1.0 - 1.0 / (2.0 * padding));
    // Degree width + 3 keeps the jump between adjacent pieces below the aliases of the kernel.
    return fitted("ES" + std::to_string(width), width, width + 3, [&](double t) {
        const double x = 2.0 * t / width;
        return std::exp(b * (std::sqrt(std::max(0.0, 1.0 - x * x)) - 1.0));
    });
}

Kernel Kernel::kaiserBessel(int width, double padding) {
    const double a = width / padding * (padding - 0.5);
    // For width 2 the radicand is negative below a padding of 0.91.
    const double b = pi * std::sqrt(std::max(0.0, a * a - 0.8));
    const double peak = std::cyl_bessel_i(0.0, b);
    return fitted("KB" + std::to_string(width), width, width + 3, [&](double t) {
        const double x = 2.0 * t / width;
        return std::cyl_bessel_i(0.0, b * std::sqrt(std::max(0.0, 1.0 - x * x))) / peak;
    });
}

} // namespace pellucid::fourier
