// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/storage.h"

#include <complex>
#include <cstdint>

#include "core/fourier/reasons.h"
#include "core/task/error.h"

namespace pellucid::fourier {

std::size_t bytesPerCell(Storage storage) {
    return storage == Storage::binary16 ? 2 * sizeof(std::uint16_t) : sizeof(std::complex<float>);
}

Storage storageFromName(const std::string &name) {
    if (name == "f16")
        return Storage::binary16;
    if (name == "f32")
        return Storage::float32;
    throw task::Error(task::ErrorCode::usage, task::because::isNoStorage(name));
}

std::string storageName(Storage storage) {
    return storage == Storage::binary16 ? "f16" : "f32";
}

} // namespace pellucid::fourier
