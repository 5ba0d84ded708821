// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/spectrum_textures.h"

#include <algorithm>
#include <cstring>

#include <tbb/parallel_for.h>

#include "core/task/error.h"
#include "gpu/reasons.h"

namespace pellucid::gpu {

namespace {

// One copy: between copies, the card's thread is free for frames.
constexpr std::size_t bytesAtOnce = std::size_t(8) << 20;
// Free memory on the card that is left for the frames' buffers and other programs.
constexpr std::size_t spareBytes = std::size_t(128) << 20;

std::size_t planeBytes(const TexelLayout &layout, fourier::Storage storage) {
    return std::size_t(layout.columns) * std::size_t(layout.rows) * fourier::bytesPerCell(storage);
}

// Copies planes of cells row by row, out of overlapping columns.
void copyPlanes(const fourier::Spectrum &spectrum, const TexelLayout &layout, int firstPlane,
                int planes, std::byte *to) {
    const fourier::CellLayout &cells = spectrum.cellLayout();
    const std::size_t cell = fourier::bytesPerCell(spectrum.layout().storage);
    const int width = layout.columns, rows = layout.rows;
    const std::size_t rowBytes = std::size_t(width) * cell;
    tbb::parallel_for(0, planes * rows, [&](int n) {
        const int plane = firstPlane + n / rows, row = n % rows;
        std::byte *const line = to + std::size_t(n) * rowBytes;
        for (int column = 0; column < cells.columns; ++column) {
            const int first = column * cells.step;
            if (first >= width)
                break;
            const int count = std::min(fourier::CellLayout::columnCells, width - first);
            std::memcpy(line + std::size_t(first) * cell,
                        spectrum.cells() + cells.line(column, plane, row) *
                                               fourier::CellLayout::columnCells * cell,
                        std::size_t(count) * cell);
        }
    });
}

} // namespace

SpectrumTextures::SpectrumTextures(std::shared_ptr<FramePasses> passes,
                                   render::EngineSpectra spectra, std::size_t maxTextureBytes)
    : m_passes(std::move(passes)), m_spectra(std::move(spectra)) {
    const Capabilities &card = m_passes->device().capabilities();
    const fourier::Spectrum &first = *m_spectra.fields.front();
    const fourier::SpectrumLayout &layout = first.layout();
    const fourier::CellLayout &cells = first.cellLayout();
    const int planes = layout.padded.k + 1 + 2 * cells.halo; // without the unused planes at the end
    m_layout.firstCell = {cells.firstX, cells.firstY, cells.firstZ};
    m_layout.columns = layout.padded.i / 2 + 1 + 2 * cells.halo;
    m_layout.rows = cells.rows;
    m_layout.planes = planes;
    if (std::max(m_layout.columns, m_layout.rows) > card.largest3dTexture)
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::spectrumExceedsTextures(m_layout.columns, m_layout.rows,
                                                                 planes, card.largest3dTexture));
    const int maxPlanes = int(std::min(maxTextureBytes / planeBytes(m_layout, layout.storage),
                                       std::size_t(card.largest3dTexture)));
    m_layout.perPage = std::max(1, maxPlanes / planes);
    const int overlap = layout.width() - 1;
    if (planes > maxPlanes) {
        const int step = std::max(1, maxPlanes - overlap);
        m_layout.slabs = (planes - overlap + step - 1) / step;
        // Equal steps, so that the last slab is not a sliver.
        m_layout.slabStep = (planes - overlap + m_layout.slabs - 1) / m_layout.slabs;
        m_layout.planes = m_layout.slabStep + overlap;
    }
    const std::size_t sources = m_spectra.fields.size() + m_spectra.gradients.size();
    const int pages =
        m_layout.pagesOf(m_spectra.fields.size()) + m_layout.pagesOf(m_spectra.gradients.size());
    const int units = std::min(bindings::maxPages, card.textureUnits);
    if (pages > units || sources > std::size_t(bindings::maxSpectra))
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::tooManySpectraForCard(sources, pages));
}

std::shared_ptr<const SpectrumTextures>
SpectrumTextures::upload(std::shared_ptr<FramePasses> passes, render::EngineSpectra spectra,
                         const task::Progress &progress, std::size_t maxTextureBytes) {
    const std::shared_ptr<SpectrumTextures> textures(
        new SpectrumTextures(std::move(passes), std::move(spectra), maxTextureBytes));
    const auto &fields = textures->m_spectra.fields, &gradients = textures->m_spectra.gradients;
    std::optional<std::size_t> free;
    textures->m_passes->device().run([&] { free = freeCardBytes(); });
    const std::size_t needed = textures->bytes();
    if (free && needed + spareBytes > *free)
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::spectraExceedCard(needed >> 20, *free >> 20));
    const double share = double(fields.size()) / double(fields.size() + gradients.size());
    textures->m_fields = textures->uploadAll(fields, progress.part(0.0, share));
    textures->m_gradients = textures->uploadAll(gradients, progress.part(share, 1.0));
    return textures;
}

SpectrumTextures::Pages SpectrumTextures::uploadAll(const render::EngineSpectra::Spectra &spectra,
                                                    const task::Progress &progress) const {
    if (spectra.empty())
        return {};
    Device &device = m_passes->device();
    const fourier::Storage storage = spectra.front()->layout().storage;
    const std::size_t bytes = planeBytes(m_layout, storage);
    const int atOnce = int(std::clamp<std::size_t>(bytesAtOnce / bytes, 1, 64));
    const int spectrumPlanes = spectra.front()->cellLayout().planes;
    std::vector<std::byte> staging(std::size_t(atOnce) * bytes);
    std::vector<std::shared_ptr<ComplexTexture>> pages;
    const int count = int(spectra.size());
    for (int first = 0; first < count; first += m_layout.perPage)
        for (int slab = 0; slab < m_layout.slabs; ++slab)
            device.run([&] {
                const int inPage = std::min(m_layout.perPage, count - first);
                // Deleted on the device's thread, whichever thread releases it.
                pages.push_back(std::shared_ptr<ComplexTexture>(
                    new ComplexTexture({m_layout.columns, m_layout.rows, inPage * m_layout.planes},
                                       storage),
                    [passes = m_passes](ComplexTexture *texture) {
                        passes->device().post([texture] { delete texture; });
                    }));
            });
    for (int n = 0; n < count; ++n) {
        const task::Progress part = progress.part(double(n) / count, double(n + 1) / count);
        const std::array<int, 2> place = m_layout.placeOf(std::size_t(n));
        const int page = place[0], firstPlane = place[1];
        for (int slab = 0; slab < m_layout.slabs; ++slab)
            for (int plane = 0; plane < m_layout.planes; plane += atOnce) {
                part.check();
                const int from = slab * m_layout.slabStep + plane;
                // The last slab may end beyond the spectrum.
                const int size = std::min({atOnce, m_layout.planes - plane, spectrumPlanes - from});
                if (size <= 0)
                    break;
                copyPlanes(*spectra[std::size_t(n)], m_layout, from, size, staging.data());
                device.run([&] {
                    pages[std::size_t(page + slab)]->upload(firstPlane + plane, size,
                                                            staging.data());
                });
                part.report((slab + double(plane + size) / m_layout.planes) / m_layout.slabs);
            }
    }
    return {pages.begin(), pages.end()};
}

std::shared_ptr<const SpectrumTextures> SpectrumTextures::withoutLight() const {
    auto unlit = std::shared_ptr<SpectrumTextures>(new SpectrumTextures(*this));
    unlit->m_spectra.gradients.clear();
    unlit->m_gradients.clear();
    return unlit;
}

std::vector<unsigned> SpectrumTextures::pages(bool withGradients) const {
    std::vector<unsigned> names;
    for (const auto &page : m_fields)
        names.push_back(page->id());
    for (const auto &page : m_gradients)
        if (withGradients)
            names.push_back(page->id());
    return names;
}

std::size_t SpectrumTextures::bytes() const {
    return (m_spectra.fields.size() + m_spectra.gradients.size()) * std::size_t(m_layout.slabs) *
           std::size_t(m_layout.planes) *
           planeBytes(m_layout, m_spectra.fields.front()->layout().storage);
}

} // namespace pellucid::gpu
