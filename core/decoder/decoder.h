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

#include "core/decoder/instance.h"
#include "core/decoder/volume_layout.h"
#include "core/task/progress.h"

namespace pellucid::decoder {

class Child;

/// A decoded file. As long as it is there its decoder decodes nothing else.
class DecodedFile {
public:
    DecodedFile(InstanceHeader header, std::span<const std::uint16_t> samples,
                std::unique_ptr<Child> child, class Decoder &decoder);
    ~DecodedFile();
    DecodedFile(DecodedFile &&other) noexcept;

    InstanceHeader header;
    /// As of DecodedImage. A decoder that a file has taken over may change them while they are
    /// read: each is to be read once.
    std::span<const std::uint16_t> samples;

private:
    std::unique_ptr<Child> m_child;
    class Decoder *m_decoder;
};

/// What an archive gives, file by file; `data` comes in parts, the last with `isLast`.
struct ArchivePart {
    const ArchiveFile &file;
    std::span<const std::byte> data;
    bool isFirst, isLast;
    bool isDamaged; ///< the last: `data` is a packed reason, and the file is not what came before
};

/// Reads files whose bytes nobody vouches for, in processes of their own (`pellucid-decode`) that
/// may do nothing but compute: no file, no network, no process; what they give back is checked. A
/// file whose decoder crashes, hangs or asks for too much is named, and the next one gets a new
/// decoder. Safe from any thread; each call has a decoder of its own, which is kept for the next.
class Decoder {
public:
    /// `program`: what is run; *throws* nothing, the calls do.
    explicit Decoder(std::filesystem::path program);
    ~Decoder();
    Decoder(const Decoder &) = delete;
    Decoder &operator=(const Decoder &) = delete;

    /// The one of this program: `pellucid-decode` beside it or where packages keep it, or what
    /// PELLUCID_DECODER names.
    static Decoder &shared();

    /// All *throw* Error{unusable} with path and reason, Error{outOfMemory}, Error{internal} if
    /// there is no decoder, Cancelled.
    InstanceHeader header(const std::filesystem::path &path, const task::Progress &progress = {});
    DecodedFile image(const std::filesystem::path &path, const task::Progress &progress = {});
    DirectoryFile directory(const std::filesystem::path &path, const task::Progress &progress = {});
    /// Twice: first the names and sizes of all files, then their data. The callback may throw.
    void archive(const std::filesystem::path &path,
                 const std::function<void(const ArchiveFile &)> &announce,
                 const std::function<void(const ArchivePart &)> &take,
                 const task::Progress &progress = {});

    /// Of a file that `volume::isVolumeFile`.
    VolumeLayout layout(const std::filesystem::path &path, const task::Progress &progress = {});
    /// Exactly so many bytes, in parts of whole samples. True if the file holds more. The callback
    /// may throw.
    bool samples(const std::filesystem::path &path, const SampleRange &samples,
                 const std::function<void(std::span<const std::byte>)> &take,
                 const task::Progress &progress = {});

    /// Other files come, of somebody else perhaps: decoders that have read the former ones read
    /// none of these. One that a file has taken over could give wrong headers and pixels for what
    /// it reads next.
    void beginOpening();

    /// What holds decoders back here, see `Confinement`; of one that is started for it if need be.
    int confinement();

private:
    friend class DecodedFile;
    std::unique_ptr<Child> lend(const task::Progress &progress);
    std::unique_ptr<Child> started(const task::Progress &progress) const;
    void takeBack(std::unique_ptr<Child> child);
    std::unique_ptr<Child> ask(const struct Message &request, int file,
                               const task::Progress &progress);
    template <class F>
    auto answered(std::unique_ptr<Child> &child, const task::Progress &progress, F &&unpack);

    std::filesystem::path m_program;
    std::mutex m_mutex;
    std::vector<std::unique_ptr<Child>> m_idle;
    std::uint64_t m_opening = 0;
};

/// Whether a file begins as DICOM files do, with a preamble or without.
bool looksLikeDicom(std::span<const std::byte> start);

} // namespace pellucid::decoder
