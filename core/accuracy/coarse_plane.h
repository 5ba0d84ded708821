// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <glm/vec2.hpp>

namespace pellucid::accuracy {

/// A periodic picture with pixels about as large as the blocks of coarse fields.
class CoarsePlane {
public:
    /// *Shape*: one period; at most 128 pixels a side.
    CoarsePlane(glm::dvec2 periodMm, double pixelMm);

    /// Adds an amount at a point, shared between the nearest four pixels.
    void add(double u, double v, double amount);

    /// The integral, over a window around a point, of the square of the sums in the pixels.
    double energyIn(glm::dvec2 centreMm, glm::dvec2 sizeMm) const;

    /// Whether an offset is, modulo the period, within a window of this size centred on 0.
    static bool isWithin(double off, double period, double size);

private:
    double &at(int column, int row) { return m_sums[std::size_t(row) * m_columns + column]; }

    int m_columns, m_rows;
    double m_columnMm, m_rowMm;
    std::vector<double> m_sums;
};

} // namespace pellucid::accuracy
