// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/dicom/write_series.h"
#include "core/phantom/phantom.h"
#include "tests/cli/cli.h"

namespace pellucid::test {

inline volume::Volume head(int slices, int side = 64) {
    return phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head,
                                {.size = volume::GridSize{side, side, slices}}));
}

class Faults : public Cli {
protected:
    fs::path series(const std::string &name, int slices, int side = 64) {
        dicom::writeCtSeries(folder / name, head(slices, side), {},
                             dicom::TransferSyntax::explicitLittle);
        return folder / name;
    }
};

} // namespace pellucid::test
