// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/kernels_by_width.h"

#include <cassert>

namespace pellucid::fourier {

KernelsByWidth::KernelsByWidth(const SpectrumLayout &layout) {
    assert(layout.width() >= narrowest);
    const auto narrower = [&](int width, int d) {
        return Kernel::narrower(layout.kernels[std::size_t(d)], width,
                                double(layout.padded[d]) / layout.box.size()[d]);
    };
    for (int width = narrowest; width < layout.width(); ++width)
        m_kernels.push_back({narrower(width, 0), narrower(width, 1), narrower(width, 2)});
    m_kernels.push_back(layout.kernels);
}

} // namespace pellucid::fourier
