// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "core/decoding/client/attribute.h"
#include "core/decoding/client/instance.h"
#include "core/decoding/client/segmentation_file.h"
#include "core/decoding/client/volume_layout.h"
#include "core/platform/handle.h"
#include "core/task/progress.h"

namespace pellucid::decoding {

class Child;

/// The process that holds what it has decoded. It reads no other file while this object exists.
class HeldDecoder {
public:
    HeldDecoder(std::unique_ptr<Child> child, class Decoder &decoder);
    ~HeldDecoder();
    HeldDecoder(HeldDecoder &&other) noexcept;

private:
    std::unique_ptr<Child> m_child;
    class Decoder *m_decoder;
};

/// A decoded file.
struct DecodedFile {
    InstanceHeader header;
    /// As in DecodedImage. A compromised decoder may change them while they are read, so read each
    /// sample only once.
    std::span<const std::uint16_t> samples;
    std::optional<HeldDecoder> decoder; ///< none if the samples are held elsewhere
};

/// A decoded segmentation.
struct DecodedSegmentation {
    SegmentationHeader header;
    /// *Shape*: frames x rows x columns, of a binary segmentation a bit each, the lowest of a byte
    /// first, without a gap between rows or frames; of others 16-bit values. A compromised decoder
    /// may change them while they are read.
    std::span<const std::byte> pixels;
    HeldDecoder decoder;
};

/// A file with uncompressed pixels. A compromised decoder may change the bytes while they are read.
struct UncompressedFile {
    std::span<const std::byte> bytes;
    HeldDecoder decoder;
};

/// An RT structure set. *Shape* of the points: of every contour of every structure, in order.
struct DecodedStructureSet {
    StructureSetHeader header;
    std::vector<glm::dvec3> points; ///< in patient space, mm
};

/// The contents of an archive, file by file; `data` comes in parts, the last with `isLast`.
struct ArchivePart {
    const ArchiveFile &file;
    std::span<const std::byte> data;
    bool isFirst, isLast;
    bool isDamaged; ///< in the last part: `data` is a packed reason, and the earlier parts are not
                    ///< the file
};

/// Reads untrusted files in separate processes (`pellucid-decode`) that can only compute: no file,
/// no network, no process. Their answers are validated. A file whose decoder crashes, hangs or asks
/// for too much memory is reported, and the next file gets a new decoder. Thread-safe; each call
/// uses a decoder of its own, which is kept for the next call.
class Decoder {
public:
    /// `program`: the executable. Does not throw if it is missing; the calls do.
    explicit Decoder(std::filesystem::path program);
    ~Decoder();
    Decoder(const Decoder &) = delete;
    Decoder &operator=(const Decoder &) = delete;

    /// The decoder of this program: `pellucid-decode` next to it or where packages install it, or
    /// the value of PELLUCID_DECODER.
    static Decoder &shared();

    /// All *throw* Error{unusable} with path and reason, Error{outOfMemory}, Error{internal} if
    /// there is no decoder, Cancelled.
    InstanceHeader header(const std::filesystem::path &path, const task::Progress &progress = {});
    DecodedFile image(const std::filesystem::path &path, const task::Progress &progress = {});
    DecodedSegmentation segmentation(const std::filesystem::path &path,
                                     const task::Progress &progress = {});
    DecodedStructureSet structureSet(const std::filesystem::path &path,
                                     const task::Progress &progress = {});
    AttributeList attributes(const std::filesystem::path &path,
                             const task::Progress &progress = {});
    /// The same file with uncompressed pixels in Explicit or, if not `isExplicit`, Implicit VR
    /// Little Endian. Images in color are refused.
    UncompressedFile uncompressed(const std::filesystem::path &path, bool isExplicit,
                                  const task::Progress &progress = {});
    DirectoryFile directory(const std::filesystem::path &path, const task::Progress &progress = {});
    /// Calls `announce` with the names and sizes of all files first, then passes on their data.
    /// Callbacks may throw.
    void archive(const std::filesystem::path &path,
                 const std::function<void(const ArchiveFile &)> &announce,
                 const std::function<void(const ArchivePart &)> &take,
                 const task::Progress &progress = {});

    /// The layout of a file for which `volume::isVolumeFile` is true.
    VolumeLayout layout(const std::filesystem::path &path, const task::Progress &progress = {});
    /// Reads exactly this range, in parts of whole samples. True if the file has more. The callback
    /// may throw.
    bool samples(const std::filesystem::path &path, const SampleRange &samples,
                 const std::function<void(std::span<const std::byte>)> &take,
                 const task::Progress &progress = {});

    /// Called before files from another source are opened: decoders that have read earlier files
    /// are not used for them. A compromised decoder could give wrong headers and pixels for the
    /// files that it reads next.
    void beginOpening();

    /// Starts decoders that wait for files, so that the first files need not wait for them.
    void startAhead(int count, const task::Progress &progress = {});

    /// The confinement of decoders on this machine, see `Confinement`. Starts one if necessary.
    int confinement();

private:
    friend class HeldDecoder;
    std::unique_ptr<Child> acquire(const task::Progress &progress);
    std::unique_ptr<Child> startChild(const task::Progress &progress) const;
    void release(std::unique_ptr<Child> child);
    std::unique_ptr<Child> ask(const struct Message &request, platform::HandleView file,
                               const task::Progress &progress);
    template <class F>
    auto answerOf(std::unique_ptr<Child> &child, const task::Progress &progress, F &&unpack);

    std::filesystem::path m_program;
    std::mutex m_mutex;
    std::vector<std::unique_ptr<Child>> m_idle;
    std::uint64_t m_opening = 0;
};

/// The UIDs of these transfer syntaxes.
inline constexpr const char *implicitLittleEndian = "1.2.840.10008.1.2",
                            *explicitLittleEndian = "1.2.840.10008.1.2.1";

/// Whether a file starts like a DICOM file, with or without a preamble.
bool looksLikeDicom(std::span<const std::byte> start);

} // namespace pellucid::decoding
