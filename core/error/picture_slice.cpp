// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error/picture_slice.h"

#include <algorithm>
#include <numbers>

#include <tbb/parallel_for.h>

#include "core/fourier/transforms/transform.h"
#include "core/scene/reasons.h"
#include "core/task/error.h"

namespace pellucid::error {

PictureSlice::PictureSlice(const picture::PeriodPicture &period, const task::Progress &progress)
    : m_columns(period.image.width), m_rows(period.image.height), m_stride(m_columns / 2 + 1),
      m_columnPerMm(1.0 / (m_columns * period.camera.pixelMm)),
      m_rowPerMm(1.0 / (m_rows * period.camera.pixelMm)),
      m_firstU(period.camera.panMm.x - 0.5 * (m_columns - 1) * period.camera.pixelMm),
      m_firstV(period.camera.panMm.y + 0.5 * (m_rows - 1) * period.camera.pixelMm),
      m_pixelArea(period.camera.pixelMm * period.camera.pixelMm) {
    const auto channels = std::size_t(period.image.channels);
    for (const float sample : period.image.samples)
        m_wholeEnergy += m_pixelArea * double(sample) * double(sample);
    task::orOutOfMemory(task::because::noMemoryForAnImage, [&] {
        m_values.resize(channels);
        for (std::size_t c = 0; c < channels; ++c) {
            progress.check();
            auto &values = m_values[c];
            values.resize(std::size_t(m_rows) * std::size_t(m_stride));
            tbb::parallel_for(0, m_rows, [&](int row) {
                auto *const to = reinterpret_cast<double *>(
                    values.data() + std::size_t(row) * std::size_t(m_stride));
                const float *const from = period.image.samples.data() +
                                          std::size_t(row) * std::size_t(m_columns) * channels + c;
                for (int column = 0; column < m_columns; ++column)
                    to[column] = double(from[std::size_t(column) * channels]);
            });
            fourier::forwardTransform3d(values.data(), {m_columns, m_rows, 1}, m_stride, m_rows);
        }
        m_energies.resize(std::size_t(m_rows) * std::size_t(m_stride));
        tbb::parallel_for(0, m_rows, [&](int row) {
            for (std::size_t n = 0, at = std::size_t(row) * std::size_t(m_stride);
                 n < std::size_t(m_stride); ++n, ++at) {
                double energy = 0.0;
                for (const auto &values : m_values)
                    energy += std::norm(values[at]);
                m_energies[at] = m_pixelArea * m_pixelArea * energy;
            }
        });
    });
}

std::complex<double> PictureSlice::phaseOf(int column, int row) const {
    const double turns = m_columnPerMm * column * m_firstU - m_rowPerMm * row * m_firstV;
    return std::polar(1.0, -2.0 * std::numbers::pi * turns);
}

double PictureSlice::energyAround(int column, int row) const {
    const auto wrapped = [&](int r) { return r >= m_rows ? r - m_rows : r; };
    double sum = 0.0;
    for (int r = -1; r <= 1; ++r)
        for (int c = -1; c <= 1; ++c)
            // Left of column 0 is the mirror image.
            sum += column + c < 0 ? energy(1, wrapped(-row - r))
                                  : energy(column + c, wrapped(row + r));
    return sum / 9.0;
}

double PictureSlice::energyUnit() const {
    return m_columnPerMm * m_rowPerMm;
}

double PictureSlice::energyInPart(const picture::PeriodPicture &period) {
    const auto channels = std::size_t(period.image.channels);
    double sum = 0.0;
    for (int row = period.top; row < period.top + period.height; ++row) {
        const float *const from =
            period.image.samples.data() +
            (std::size_t(row) * std::size_t(period.image.width) + std::size_t(period.left)) *
                channels;
        for (std::size_t n = 0; n < std::size_t(period.width) * channels; ++n)
            sum += double(from[n]) * double(from[n]);
    }
    return sum * period.camera.pixelMm * period.camera.pixelMm;
}

double PictureSlice::repeatedEnergy(const picture::PeriodPicture &period) {
    const auto timesShown = [](int periodSide, int pictureSide) {
        std::vector<int> times(std::size_t(periodSide), 0);
        const int first = (periodSide - pictureSide) / 2;
        for (int n = first; n < first + pictureSide; ++n)
            ++times[std::size_t((n % periodSide + periodSide) % periodSide)];
        return times;
    };
    const std::vector<int> columns = timesShown(period.image.width, period.pictureWidth),
                           rows = timesShown(period.image.height, period.pictureHeight);
    const float *pixel = period.image.samples.data();
    double sum = 0.0;
    for (const int row : rows)
        for (const int column : columns)
            for (int c = 0; c < period.image.channels; ++c, ++pixel)
                sum += std::max(0, row * column - 1) * double(*pixel) * double(*pixel);
    return sum * period.camera.pixelMm * period.camera.pixelMm;
}

PictureSlice::PartEnergies
PictureSlice::energiesInPart(int channel, const picture::PeriodPicture &period,
                             const std::function<void(const Set &)> &fill) const {
    std::vector<std::complex<double>> errors = m_values[std::size_t(channel)];
    fill([&](int column, int row, const std::complex<double> &exact) {
        const std::complex<double> first = exact * std::conj(phaseOf(column, row)) / m_pixelArea;
        errors[indexOf(column, row)] -= first;
        if (column == 0 && row != 0) // the transform reads both halves of column 0
            errors[indexOf(0, -row)] -= std::conj(first);
    });
    const auto columns = std::size_t(m_columns), rows = std::size_t(m_rows);
    std::vector<double> pixels(rows * columns);
    fourier::InverseTransform2d<double>(m_rows, m_columns).run(errors.data(), pixels.data());
    PartEnergies sum;
    for (int row = period.top; row < period.top + period.height; ++row)
        for (int column = period.left; column < period.left + period.width; ++column) {
            const std::size_t at = std::size_t(row) * columns + std::size_t(column);
            const double error = pixels[at] / (double(m_columns) * m_rows),
                         shown = double(
                             period.image.samples[at * m_values.size() + std::size_t(channel)]);
            sum.error += m_pixelArea * error * error;
            sum.exact += m_pixelArea * (shown - error) * (shown - error);
        }
    return sum;
}

} // namespace pellucid::error
