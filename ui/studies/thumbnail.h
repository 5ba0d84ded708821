// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>

#include "core/dicom/catalogue.h"

namespace pellucid::ui {

/// Pixels of a thumbnail's longer side: 48 on a screen of twice the density.
inline constexpr int thumbnailPixels = 96;

/// The middle slice as its file shows it, round where the patient is round. Null where nothing can
/// be decoded or where decoding would take the whole of a large file. Thread-safe.
QImage makeThumbnail(const dicom::VolumeEntry &entry);
/// The middle slice of a volume.
QImage makeThumbnail(const volume::Volume &volume);

} // namespace pellucid::ui
