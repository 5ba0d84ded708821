// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/fourier/spectrum.h"
#include "core/picture/projection_image.h"
#include "core/plan/render_plan.h"
#include "core/shading/slice_shading.h"
#include "core/task/reason.h"

namespace pellucid::render {

/// How much of red, green and blue a field has in a picture.
using ChannelShares = std::array<double, 3>;

/// Whether all channels are alike, hence one is enough.
bool areGrey(std::span<const ChannelShares> shares);

/// The spectra that an engine slices, of one layout.
struct EngineSpectra {
    using Spectra = std::vector<std::shared_ptr<const fourier::Spectrum>>;
    Spectra fields;
    Spectra gradients; ///< of the |g| of each field, for light; or none
    shading::ShadingScale scale;
};

/// What an engine makes its pictures of; another engine makes the same of it.
struct EngineParts {
    EngineSpectra spectra;
    std::vector<ChannelShares> shares; ///< one each field
    plan::SliceRoom room;
};

/// Makes projections of prepared fields. Engines are interchangeable: under the same plan they
/// give the same image within a stated rounding bound.
class ProjectionEngine {
public:
    virtual ~ProjectionEngine() = default;
    /// The engine and what it runs on, one line.
    virtual task::Reason description() const = 0;
    /// Not safe to call from two threads at once. Lights shine only on what was prepared for them.
    /// *Throws* Error{outOfMemory}.
    virtual picture::ProjectionImage render(const scene::Camera &camera,
                                            const scene::ImageDefinition &image,
                                            const shading::Shading &shading = {},
                                            picture::FrameTimes *times = nullptr) = 0;
    virtual EngineParts parts() const = 0;
};

/// The projection-slice theorem on the processor: interpolates the central slice of the half
/// spectrum strip by strip, multiplies by the reconstruction and the roll-off, and transforms each
/// strip back while it is in the cache. The same bits for any number of threads; between
/// instruction sets images differ by less than 2e-6 of their largest value.
///
/// Several spectra are shown as their weighted sum: weights and places of the kernel are worked out
/// once for all, and each channel is transformed once, whatever the number of spectra. A picture
/// has one channel if all shares are alike and all lights are grey, else three; a spectrum without
/// a share costs nothing. *Source*: Cheng 2007, eq. 32 and 36.
///
/// Cue and light are applied to the slice (`shading::SliceShading`): a linear cue reads moments
/// from the cells that are read anyway; light needs one more slice whatever the number of lights.
class CpuEngine final : public ProjectionEngine {
public:
    /// `room`: the plan's; without one the spectrum's box is taken to be full. `threads`: 0 for as
    /// many as oneTBB may use.
    explicit CpuEngine(std::shared_ptr<const fourier::Spectrum> spectrum,
                       const std::optional<plan::SliceRoom> &room = std::nullopt, int threads = 0);
    /// The shares of the fields are 1 until set.
    CpuEngine(EngineSpectra spectra, const plan::SliceRoom &room, int threads = 0);
    ~CpuEngine() override;

    /// *Shape*: one each field.
    void setShares(std::vector<ChannelShares> shares);
    std::size_t fieldCount() const { return m_spectra.fields.size(); }
    /// Bytes of all spectra.
    std::size_t bytes() const;
    /// Whether lights have what they shine on.
    bool takesLight() const { return !m_spectra.gradients.empty(); }

    task::Reason description() const override;
    /// *Shape*: not while the shares are set.
    EngineParts parts() const override { return {m_spectra, m_shares, m_room}; }
    const EngineSpectra &spectra() const { return m_spectra; }
    const plan::SliceRoom &room() const { return m_room; }
    picture::ProjectionImage render(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading = {},
                                    picture::FrameTimes *times = nullptr) override;

private:
    struct Workplace;

    EngineSpectra m_spectra;
    std::vector<ChannelShares> m_shares;
    std::unique_ptr<Workplace> m_workplace;
    plan::SliceRoom m_room;
};

} // namespace pellucid::render
