// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/coarse_plane.h"

#include <algorithm>
#include <cmath>

namespace pellucid::accuracy {

CoarsePlane::CoarsePlane(glm::dvec2 periodMm, double pixelMm)
    : m_columns(std::clamp(int(periodMm.x / pixelMm), 1, 128)),
      m_rows(std::clamp(int(periodMm.y / pixelMm), 1, 128)), m_columnMm(periodMm.x / m_columns),
      m_rowMm(periodMm.y / m_rows), m_sums(std::size_t(m_columns) * m_rows) {}

void CoarsePlane::add(double u, double v, double amount) {
    const double x = u / m_columnMm, y = v / m_rowMm;
    const double column = std::floor(x), row = std::floor(y), right = x - column, up = y - row;
    const auto wrap = [](double n, int count) {
        return std::min(count - 1, int(n - count * std::floor(n / count)));
    };
    const int c0 = wrap(column, m_columns), c1 = wrap(column + 1.0, m_columns),
              r0 = wrap(row, m_rows), r1 = wrap(row + 1.0, m_rows);
    at(c0, r0) += amount * (1.0 - right) * (1.0 - up);
    at(c1, r0) += amount * right * (1.0 - up);
    at(c0, r1) += amount * (1.0 - right) * up;
    at(c1, r1) += amount * right * up;
}

double CoarsePlane::energyIn(glm::dvec2 centreMm, glm::dvec2 sizeMm) const {
    double sum = 0.0;
    for (int row = 0; row < m_rows; ++row)
        for (int column = 0; column < m_columns; ++column)
            if (isWithin(column * m_columnMm - centreMm.x, m_columns * m_columnMm, sizeMm.x) &&
                isWithin(row * m_rowMm - centreMm.y, m_rows * m_rowMm, sizeMm.y)) {
                const double value = m_sums[std::size_t(row) * m_columns + column];
                sum += value * value;
            }
    return sum / (m_columnMm * m_rowMm);
}

bool CoarsePlane::isWithin(double off, double period, double size) {
    const double near = off - period * std::round(off / period);
    return std::abs(near) <= 0.5 * size;
}

} // namespace pellucid::accuracy
