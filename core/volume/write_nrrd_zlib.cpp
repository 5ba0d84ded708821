// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>

#include <fmt/format.h>
#include <zlib.h>

#include "core/files/atomic_file.h"
#include "core/task/error.h"
#include "core/volume/nrrd.h"

namespace pellucid::volume {

namespace {

static_assert(std::endian::native == std::endian::little,
              "samples are written as they lie in memory");

std::string vectorText(const glm::dvec3 &v) {
    return fmt::format("({},{},{})", v.x, v.y, v.z);
}

std::string oneLine(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

void writeGzip(files::AtomicFile &file, std::span<const std::byte> bytes,
               const task::Progress &progress) {
    z_stream stream{};
    // 15 + 16: largest window, gzip framing. Level 1: medical noise hardly compresses further.
    if (deflateInit2(&stream, 1, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    std::vector<std::byte> out(1 << 20);
    std::size_t done = 0;
    int state = Z_OK;
    do {
        if (stream.avail_in == 0 && done < bytes.size()) {
            const std::size_t part = std::min<std::size_t>(bytes.size() - done, 1 << 30);
            stream.next_in =
                reinterpret_cast<Bytef *>(const_cast<std::byte *>(bytes.data() + done));
            stream.avail_in = uInt(part);
            done += part;
        }
        stream.next_out = reinterpret_cast<Bytef *>(out.data());
        stream.avail_out = uInt(out.size());
        state = deflate(&stream, done == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        try {
            progress.report(double(done - stream.avail_in) / double(bytes.size()));
            file.write(std::span(out).first(out.size() - stream.avail_out));
        } catch (...) {
            deflateEnd(&stream);
            throw;
        }
    } while (state != Z_STREAM_END);
    deflateEnd(&stream);
}

void writeRaw(files::AtomicFile &file, std::span<const std::byte> bytes,
              const task::Progress &progress) {
    constexpr std::size_t chunk = 1 << 24;
    for (std::size_t done = 0; done < bytes.size(); done += chunk) {
        progress.report(double(done) / double(bytes.size()));
        file.write(bytes.subspan(done, std::min(chunk, bytes.size() - done)));
    }
}

} // namespace

void writeNrrd(const std::filesystem::path &path, const Volume &volume, NrrdEncoding encoding,
               const task::Progress &progress, const NrrdPairs &pairs) {
    const Lattice &lattice = volume.lattice();
    const GridSize size = lattice.size();
    std::string header = fmt::format(
        "NRRD0004\n"
        "type: {}\ndimension: 3\nspace: left-posterior-superior\nsizes: {} {} {}\n"
        "space directions: {} {} {}\nkinds: domain domain domain\nendian: little\nencoding: {}\n"
        "space origin: {}\n",
        volume.isFloat() ? "float" : "short", size.i, size.j, size.k, vectorText(lattice.step(0)),
        vectorText(lattice.step(1)), vectorText(lattice.step(2)),
        encoding == NrrdEncoding::gzip ? "gzip" : "raw", vectorText(lattice.origin().mm));
    for (const auto &[key, value] : pairs)
        header += oneLine(key) + ":=" + oneLine(value) + "\n";
    header += "\n";
    files::AtomicFile file(path);
    file.write(header);
    volume.visit([&](auto samples) {
        if (encoding == NrrdEncoding::gzip)
            writeGzip(file, std::as_bytes(samples), progress);
        else
            writeRaw(file, std::as_bytes(samples), progress);
    });
    file.commit();
}

} // namespace pellucid::volume
