// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/picture/projection_image.h"
#include "gpu/device.h"
#include "gpu/frame_block.h"
#include "gpu/texture.h"

namespace pellucid::gpu {

/// How a kernel's cells are read: one by one, or pairs of them by the card's own linear filter,
/// whose weights are coarse.
enum class Fetch { exact, trilinear };

class FramePasses;

/// A projection that lies on the card. Keeps what it lies in from being written again.
class CardPicture {
public:
    int width() const { return m_width; }
    int height() const { return m_height; }
    /// Of the image, 1 or 3; it may be one layer in a colour.
    int channels() const { return m_channels; }
    int layers() const { return m_layers; }
    const std::array<float, 3> &color() const { return m_color; }
    /// The texture, for contexts that share with the device's.
    unsigned texture() const { return m_texture->id(); }
    /// Says that the current context's commands so far read the picture: it is not written again
    /// before they are done.
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
    std::array<float, 3> m_color{1.0F, 1.0F, 1.0F};
};

/// What the passes of a frame are given.
struct FrameCommand {
    scene::Camera camera;
    plan::SliceGrid grid;
    FrameBlock block;            ///< but the tables, which the passes have
    std::vector<unsigned> pages; ///< textures
    int fieldPages = 1, slabs = 1, sums = 1, layers = 1, channels = 1;
    int width = 4, evenTerms = 1, momentTerms = 1;
    bool shaded = false, cued = false, lit = false;
    Fetch fetch = Fetch::exact;
    std::array<float, 3> color{1.0F, 1.0F, 1.0F};
};

/// Where the time of a frame on the card went.
struct CardTimes {
    double sliceMs = 0.0;     ///< by the card's clock; with the first transform where they are one
    double transformMs = 0.0; ///< by the card's clock
    double submitMs = 0.0;    ///< of the processor, to ask for it all
    int dispatches = 0;
};

/// Slice, inverse transform and picture as compute passes, with the buffers they need: one for all
/// engines of a device. Two dispatches make a grey frame: the slice's columns, made and transformed
/// by a work group each, and the rows; colours take one more, and lines that do not fit the card's
/// shared memory a dispatch for every stage of their transform.
class FramePasses : public std::enable_shared_from_this<FramePasses> {
public:
    explicit FramePasses(std::shared_ptr<Device> device);
    ~FramePasses();

    Device &device() const { return *m_device; }
    /// Makes a frame and waits for it. *Throws* Error{noSuchDevice}, Error{outOfMemory}.
    std::shared_ptr<const CardPicture> render(FrameCommand &&command, CardTimes *times = nullptr);
    /// A picture of zeros.
    std::shared_ptr<const CardPicture> empty(const scene::Camera &camera, int channels);

private:
    struct Place;
    friend class CardPicture;
    std::shared_ptr<CardPicture> pictureFor(const scene::Camera &camera, int layers);

    std::shared_ptr<Device> m_device;
    OnDevice<Place> m_place;
    /// Pictures that are shown or may be written again.
    std::vector<std::shared_ptr<CardPicture::Target>> m_targets;
};

} // namespace pellucid::gpu
