// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>

#include "core/dicom/catalogue.h"

namespace pellucid::ui {

/// The longer side of a thumbnail in pixels: 48 logical pixels on a high-density screen.
inline constexpr int thumbnailPixels = 96;

/// The middle slice with the file's window and square pixels. Null if it cannot be decoded, or if
/// that would require decoding all of a large file. Thread-safe.
QImage makeThumbnail(const dicom::VolumeEntry &entry);
/// The middle slice of a volume.
QImage makeThumbnail(const volume::Volume &volume);

} // namespace pellucid::ui
