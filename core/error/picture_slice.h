// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include "core/picture/projector.h"
#include "core/task/progress.h"

namespace pellucid::error {

/// The slice that a picture was made from, read back from a whole period of it: by a transform in
/// double precision, so that whatever happened to the picture is in it.
class PictureSlice {
public:
    /// *Throws* Error{outOfMemory}, Cancelled.
    explicit PictureSlice(const picture::PeriodPicture &period,
                          const task::Progress &progress = {});

    int columns() const { return m_columns; }
    int rows() const { return m_rows; }
    int channels() const { return int(m_values.size()); }
    /// The steps of the slice's grid, cycles per mm.
    double columnPerMm() const { return m_columnPerMm; }
    double rowPerMm() const { return m_rowPerMm; }
    /// Calls use(column, row, weight, radius) for each frequency of half the plane: the weight is 2
    /// if its mirror image is another one; the radius 1 at the end of the band.
    template <class F> void forEach(const F &use) const {
        for (int row = -m_rows / 2 + 1; row <= m_rows / 2; ++row)
            for (int column = 0; column <= m_columns / 2; ++column) {
                const bool isEdge = column == 0 || column == m_columns / 2;
                if (isEdge && row < 0)
                    continue; // its mirror image is there
                const bool isOwnMirror = isEdge && (row == 0 || row == m_rows / 2);
                const double x = 2.0 * column / m_columns, y = 2.0 * row / m_rows;
                use(column, row, isOwnMirror ? 1.0 : 2.0, std::sqrt(x * x + y * y));
            }
    }
    /// P at a column and a row, which run along U and against V. *Units*: of the picture, times
    /// mm^2. *Requires*: 0 <= column <= columns/2, |row| <= rows/2.
    std::complex<double> value(int channel, int column, int row) const {
        return m_pixelArea * m_values[std::size_t(channel)][indexOf(column, row)] *
               phaseOf(column, row);
    }
    /// |P|^2 of all channels together.
    double energy(int column, int row) const { return m_energies[indexOf(column, row)]; }
    /// The mean of `energy` over a frequency and its eight neighbours.
    double energyAround(int column, int row) const;
    /// The energy of a picture over that of its frequencies (Parseval), 1/(mm^2).
    double energyUnit() const;
    /// The energy of all of a period. *Units*: as below.
    double wholeEnergy() const { return m_wholeEnergy; }
    /// The energy of the shown part of a period. *Units*: of the picture squared, times mm^2.
    static double energyInPart(const picture::PeriodPicture &period);
    /// The energy of the pixels beyond one period, which repeat others: all of it is error.
    /// *Units*: as above.
    static double repeatedEnergy(const picture::PeriodPicture &period);
    /// The energies of the error and of P in the shown part, *units* as above, if P is known at
    /// every frequency of the band: `fill` passes all of them to `set(column, row, P)`. Beyond the
    /// band, P is 0.
    struct PartEnergies {
        double error = 0.0, exact = 0.0;
    };
    using Set = std::function<void(int column, int row, const std::complex<double> &exact)>;
    PartEnergies energiesInPart(int channel, const picture::PeriodPicture &period,
                                const std::function<void(const Set &)> &fill) const;

private:
    std::size_t indexOf(int column, int row) const {
        return std::size_t(row < 0 ? row + m_rows : row) * std::size_t(m_stride) +
               std::size_t(column);
    }
    /// From the first pixel, where the transform begins, to the center of rotation.
    std::complex<double> phaseOf(int column, int row) const;

    int m_columns, m_rows, m_stride;
    double m_columnPerMm, m_rowPerMm;
    double m_firstU, m_firstV; ///< of the first pixel, mm
    double m_pixelArea, m_wholeEnergy = 0.0;
    std::vector<std::vector<std::complex<double>>> m_values; ///< by channel
    std::vector<double> m_energies;                          ///< of all channels
};

} // namespace pellucid::error
