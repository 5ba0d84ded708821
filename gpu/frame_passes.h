// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/picture/projection_image.h"
#include "gpu/device.h"
#include "gpu/frame_block.h"
#include "gpu/texture.h"

namespace pellucid::gpu {

class FramePasses;

/// A projection on the card. While it exists, its texture is not reused for another frame.
class CardPicture {
public:
    int width() const { return m_width; }
    int height() const { return m_height; }
    double pixelMm() const { return m_pixelMm; }
    /// Channels of the picture, 1 or 3, and the images that they are mixed from.
    int channels() const { return m_channels; }
    int layers() const { return m_layers; }
    using Colors = render::FrameInputs::ImageColors;
    const Colors &colors() const { return m_colors; }
    /// The texture, for contexts that share with the device's.
    unsigned texture() const { return m_texture->id(); }
    /// Marks the current context's commands so far as readers of the picture: its texture is not
    /// reused before they finish.
    void markDrawn() const;
    /// Reads it back. *Throws* Error{noSuchDevice}, Error{outOfMemory}.
    picture::ProjectionImage download() const;

private:
    friend class FramePasses;
    struct Target;
    std::shared_ptr<FramePasses> m_passes;
    std::shared_ptr<Target> m_target;
    const PixelTexture *m_texture = nullptr;
    int m_width = 0, m_height = 0, m_channels = 1, m_layers = 1;
    double m_pixelMm = 1.0;
    Colors m_colors = white;
    // A single grey image has no color of its own.
    static constexpr Colors white{{{1.0F, 1.0F, 1.0F}}};
};

/// The input of a frame's passes.
struct FrameCommand {
    scene::Camera camera;
    plan::SliceGrid grid;
    FrameBlock block;                     ///< without the transform members, which the passes set
    std::vector<std::int32_t> tileWidths; ///< of widths::WidthMap; empty: `width` reads everything
    std::vector<unsigned> pages;          ///< texture names
    int fieldPages = 1, slabs = 1, sums = 1, layers = 1, channels = 1;
    int width = 4, evenTerms = 1, momentTerms = 1;
    bool shaded = false, cued = false, lit = false;
    CardPicture::Colors colors{};
};

/// The times of a frame on the card.
struct CardTimes {
    double sliceMs = 0.0;     ///< card time; includes the first transform if they are fused
    double transformMs = 0.0; ///< card time
    double submitMs = 0.0;    ///< processor time to submit the commands
    int dispatches = 0;
    widths::WidthMap::Shares widthShares{}; ///< see picture::FrameTimes
};

/// Slice, inverse transform and picture as compute passes, with their buffers; all engines of a
/// device share one object. A grey frame takes two dispatches: one in which each work group
/// computes and transforms a column of the slice, and one for the rows. Colors take one more.
/// Lines that do not fit the card's shared memory take a dispatch for each stage of their
/// transform.
class FramePasses : public std::enable_shared_from_this<FramePasses> {
public:
    explicit FramePasses(std::shared_ptr<Device> device);
    ~FramePasses();

    Device &device() const { return *m_device; }
    /// Renders a frame and waits for it. *Throws* Error{noSuchDevice}, Error{outOfMemory}.
    std::shared_ptr<const CardPicture> render(FrameCommand &&command, CardTimes *times = nullptr);
    /// A picture of zeros.
    std::shared_ptr<const CardPicture> empty(const scene::Camera &camera, int channels);

private:
    struct Resources;
    friend class CardPicture;
    std::shared_ptr<CardPicture> pictureFor(const scene::Camera &camera, int layers);

    std::shared_ptr<Device> m_device;
    OnDevice<Resources> m_resources;
    /// Targets that are in use or can be reused.
    std::vector<std::shared_ptr<CardPicture::Target>> m_targets;
};

} // namespace pellucid::gpu
