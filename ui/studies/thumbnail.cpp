// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/studies/thumbnail.h"

#include <algorithm>
#include <cmath>

#include "core/dicom/load_volume.h"
#include "core/task/error.h"
#include "ui/studies/window_presets.h"

namespace pellucid::ui {

namespace {

// The middle slice of a volume file cannot be read separately.
constexpr std::size_t maxVoxelsRead = std::size_t(64) << 20;

} // namespace

QImage makeThumbnail(const volume::Volume &volume) {
    const volume::Lattice &lattice = volume.lattice();
    const int columns = lattice.size().i, rows = lattice.size().j, slices = lattice.size().k;
    const volume::ValueWindow window = initialWindow(volume);
    QImage picture(columns, rows, QImage::Format_Grayscale8);
    volume.visit([&](const auto &samples) {
        const auto *in = samples.data() + std::size_t(columns) * rows * std::size_t(slices / 2);
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x, ++in) {
                const double grey = window.greyOf(double(*in));
                // NaN is as dark as the outside of the volume.
                picture.scanLine(y)[x] = uchar(std::isnan(grey) ? 0 : std::lround(255.0 * grey));
            }
    });
    const double width = columns * lattice.spacingMm(0), height = rows * lattice.spacingMm(1);
    const double scale = thumbnailPixels / std::max(width, height);
    return picture.scaled(std::max(1, int(std::lround(width * scale))),
                          std::max(1, int(std::lround(height * scale))), Qt::IgnoreAspectRatio,
                          Qt::SmoothTransformation);
}

QImage makeThumbnail(const dicom::VolumeEntry &entry) {
    try {
        if (!entry.volumeFile.empty())
            return entry.voxels() > maxVoxelsRead ? QImage()
                                                  : makeThumbnail(dicom::loadVolume(entry).volume);
        const volume::Lattice &lattice = entry.geometry.lattice;
        dicom::VolumeEntry one = entry;
        one.frames = {entry.frames.at(entry.frames.size() / 2)};
        one.geometry = {volume::Lattice::make({lattice.size().i, lattice.size().j, 1},
                                              lattice.origin(),
                                              {lattice.step(0), lattice.step(1), lattice.step(2)}),
                        {}};
        return makeThumbnail(dicom::loadVolume(one).volume);
    } catch (const task::Error &) {
        return {}; // opening it reports the reason
    }
}

} // namespace pellucid::ui
