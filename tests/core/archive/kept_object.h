// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/archive/object_folder.h"
#include "core/platform/file.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::archive::test {

using namespace pellucid::test;

inline const std::string root = "1.2.826.0.1.3680043.8.498.";
inline const network::Arrival announced{
    "1.2.840.10008.5.1.4.1.1.2", root + "1.1", "1.2.840.10008.1.2.1", {}};

/// An object whose samples have this value.
inline std::string objectWith(int value) {
    const TemporaryFolder folder;
    SeriesKnobs knobs;
    knobs.value = [value](int, int, int) { return value; };
    sliceOf(knobs, 0).write(folder / "object.dcm");
    return readText(folder / "object.dcm");
}

/// Keeps what has arrived.
inline StoredObject keep(const ObjectFolder &folder, const std::string &bytes,
                         const std::vector<ObjectFolder::Place> &places = {}) {
    const auto file = folder.open(announced);
    platform::writeAll(file->view(), std::as_bytes(std::span(bytes)));
    return folder.keep(*file, announced, bytes.size(), places);
}

} // namespace pellucid::archive::test
