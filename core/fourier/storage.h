// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace pellucid::fourier {

/// The representation of a complex number in a spectrum: two floats, or two IEEE binary16 numbers
/// scaled by a power of two so that the largest fits.
enum class Storage { binary16, float32 };

std::size_t bytesPerCell(Storage storage);
/// "f16", "f32". *Throws* Error{usage} for any other name.
Storage storageFromName(const std::string &name);
std::string storageName(Storage storage);

} // namespace pellucid::fourier
