// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/volume/volume.h"

#include <algorithm>
#include <cassert>

namespace pellucid::volume {

Volume::Volume(Lattice lattice, std::vector<std::int16_t> samples, ValueUnit unit,
               VolumeNotes notes)
    : m_lattice(lattice),
      m_samples(std::make_shared<const std::vector<std::int16_t>>(std::move(samples))),
      m_unit(unit), m_notes(std::make_shared<const VolumeNotes>(std::move(notes))) {
    assert(visit([](auto s) { return s.size(); }) == m_lattice.size().count());
}

Volume::Volume(Lattice lattice, std::vector<float> samples, ValueUnit unit, VolumeNotes notes)
    : m_lattice(lattice), m_samples(std::make_shared<const std::vector<float>>(std::move(samples))),
      m_unit(unit), m_notes(std::make_shared<const VolumeNotes>(std::move(notes))) {
    assert(visit([](auto s) { return s.size(); }) == m_lattice.size().count());
}

std::size_t Volume::bytes() const {
    return visit([](auto samples) { return samples.size_bytes(); });
}

double Volume::value(VoxelIndex n) const {
    assert(m_lattice.contains(n));
    const std::size_t at = m_lattice.size().offsetOf(n.i, n.j, n.k);
    return visit([at](auto samples) { return double(samples[at]); });
}

Volume Volume::cropped(const VoxelBox &box) const {
    const GridSize size = m_lattice.size();
    const GridSize part = box.size();
    return visit([&](auto samples) {
        std::vector<std::remove_const_t<typename decltype(samples)::element_type>> out(
            part.count());
        auto to = out.begin();
        for (int k = box.lo.k; k < box.hi.k; ++k)
            for (int j = box.lo.j; j < box.hi.j; ++j) {
                const auto from = samples.begin() + std::ptrdiff_t(size.offsetOf(box.lo.i, j, k));
                to = std::copy_n(from, part.i, to);
            }
        return Volume(m_lattice.cropped(box), std::move(out), m_unit, *m_notes);
    });
}

Volume Volume::withNotes(VolumeNotes notes) const {
    Volume copy = *this;
    copy.m_notes = std::make_shared<const VolumeNotes>(std::move(notes));
    return copy;
}

} // namespace pellucid::volume
