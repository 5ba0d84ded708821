// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace pellucid::fourier {

/// An interpolation kernel on the frequency grid: even, of a whole width, a polynomial on every
/// unit interval. The polynomials are the kernel: the de-apodisation is computed from them, so the
/// fit costs no accuracy.
///
/// Taps: for a coordinate g, tap k = 0..width-1 lies at grid index first(g) + k, at the distance
/// t_k = c + k - (width-1)/2 from g with c = first(g) - g + width/2 - 1/2 in [-1/2, 1/2).
class Kernel {
public:
    /// ES: exp(b (sqrt(1 - (2t/w)^2) - 1)), b = 0.976 pi w (1 - 1/(2 padding)).
    /// *Source*: Barnett, Magland, af Klinteberg 2019.
    static Kernel exponentialSemicircle(int width, double padding);

    const std::string &name() const { return m_name; }
    int width() const { return m_width; }
    int degree() const { return m_degree; }
    /// H(t); zero for |t| > width/2. *Units*: t in grid cells.
    double value(double t) const;
    /// The weights of all taps for a centred offset c in [-1/2, 1/2].
    void weights(float c, float *out) const {
        for (int k = 0; k < m_width; ++k) {
            const float *p = m_singles.data() + k * (m_degree + 1);
            float sum = p[m_degree];
            for (int n = m_degree - 1; n >= 0; --n)
                sum = sum * c + p[n];
            out[k] = sum;
        }
    }
    /// h(x) = integral of H(t) cos(2 pi t x / padded) dt: how the kernel darkens the volume at a
    /// distance of x voxels from the wrap voxel.
    double apodisation(double x, int padded) const;

private:
    Kernel(std::string name, int width, int degree,
           double (*shape)(double t, double width, double b), double b);

    std::string m_name;
    int m_width;
    int m_degree;
    // Coefficients by tap, ascending powers of c.
    std::vector<double> m_coefficients;
    std::vector<float> m_singles;
};

} // namespace pellucid::fourier
