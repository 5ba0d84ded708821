// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/spectrum.h"

namespace pellucid::fourier {

/// The kernels that can read spectra of a layout: its own, which are the widest, and narrower ones.
/// A narrow kernel makes a larger error, but only where it is used: interpolation depends on the
/// cells within half its width.
class KernelsByWidth {
public:
    static constexpr int narrowest = 2;

    /// *Requires*: layout.width() >= narrowest.
    explicit KernelsByWidth(const SpectrumLayout &layout);
    int widest() const { return narrowest + int(m_kernels.size()) - 1; }
    /// By axis. *Requires*: narrowest <= width <= widest().
    const std::array<Kernel, 3> &of(int width) const {
        return m_kernels[std::size_t(width - narrowest)];
    }

private:
    std::vector<std::array<Kernel, 3>> m_kernels;
};

} // namespace pellucid::fourier
