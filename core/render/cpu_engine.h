// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/fourier/spectrum.h"
#include "core/render/projection_image.h"
#include "core/render/render_plan.h"

namespace pellucid::render {

/// How much of red, green and blue a field has in a picture.
using ChannelShares = std::array<double, 3>;

/// Whether all channels are alike, hence one is enough.
bool areGrey(std::span<const ChannelShares> shares);

/// Makes projections of prepared fields. Engines are interchangeable: under the same plan they
/// give the same image within a stated rounding bound.
class ProjectionEngine {
public:
    virtual ~ProjectionEngine() = default;
    /// The engine and what it runs on, one line.
    virtual std::string description() const = 0;
    /// Not safe to call from two threads at once. *Throws* Error{outOfMemory}.
    virtual ProjectionImage render(const Camera &camera, const ImageDefinition &image,
                                   FrameTimes *times = nullptr) = 0;
};

/// The projection-slice theorem on the processor: interpolates the central slice of the half
/// spectrum strip by strip, multiplies by the reconstruction and the roll-off, and transforms each
/// strip back while it is in the cache. The same bits for any number of threads; between
/// instruction sets images differ by less than 2e-6 of their largest value.
///
/// Several spectra are shown as their weighted sum: weights and places of the kernel are worked out
/// once for all, and each channel is transformed once, whatever the number of spectra. A picture
/// has one channel if all shares are alike, else three; a spectrum without a share costs nothing.
/// *Source*: Cheng 2007, eq. 32 and 36.
class CpuEngine final : public ProjectionEngine {
public:
    /// `room`: the plan's; without one the spectrum's box is taken to be full. `threads`: 0 for as
    /// many as oneTBB may use.
    explicit CpuEngine(std::shared_ptr<const fourier::Spectrum> spectrum,
                       const std::optional<SliceRoom> &room = std::nullopt, int threads = 0);
    /// *Shape*: all spectra have one layout. Their shares are 1 until set.
    CpuEngine(std::vector<std::shared_ptr<const fourier::Spectrum>> spectra, const SliceRoom &room,
              int threads = 0);
    ~CpuEngine() override;

    /// *Shape*: one each spectrum.
    void setShares(std::vector<ChannelShares> shares);
    std::size_t spectrumCount() const { return m_spectra.size(); }
    /// Bytes of all spectra.
    std::size_t bytes() const;

    std::string description() const override;
    ProjectionImage render(const Camera &camera, const ImageDefinition &image,
                           FrameTimes *times = nullptr) override;

private:
    struct Workplace;

    std::vector<std::shared_ptr<const fourier::Spectrum>> m_spectra;
    std::vector<ChannelShares> m_shares;
    std::unique_ptr<Workplace> m_workplace;
    SliceRoom m_room;
};

} // namespace pellucid::render
