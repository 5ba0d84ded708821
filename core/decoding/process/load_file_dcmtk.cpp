// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/load_file.h"

#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "core/dcmtk/codecs.h"
#include "core/decoding/client/decoder.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/process/memory_input.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/files/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

// Syntaxes without a name in DCMTK 3.6.7 (PS3.6, table A-1).
constexpr std::pair<const char *, const char *> otherSyntaxNames[] = {
    {"1.2.840.10008.1.2.4.110", "JPEG XL Lossless"},
    {"1.2.840.10008.1.2.4.111", "JPEG XL JPEG Recompression"},
    {"1.2.840.10008.1.2.4.112", "JPEG XL"},
    {"1.2.840.10008.1.2.4.201", "High-Throughput JPEG 2000 Lossless"},
    {"1.2.840.10008.1.2.4.202", "High-Throughput JPEG 2000 RPCL Lossless"},
    {"1.2.840.10008.1.2.4.203", "High-Throughput JPEG 2000"},
};

// The offset of the data set, and what the meta header says about it; empty without a meta header.
struct Meta {
    std::string syntaxUid;
    std::size_t end = 0;
};

std::optional<Meta> metaOf(std::span<const std::byte> file) {
    constexpr std::size_t preamble = 132;
    if (file.size() < preamble || std::memcmp(file.data() + 128, "DICM", 4) != 0)
        return std::nullopt;
    // The meta header is always explicit little endian.
    const auto number = [&](std::size_t at, int bytes) {
        std::size_t value = 0;
        for (int n = 0; n < bytes; ++n)
            value |= std::to_integer<std::size_t>(file[at + std::size_t(n)]) << (8 * n);
        return value;
    };
    Meta meta;
    for (std::size_t at = preamble; at + 12 <= file.size() && number(at, 2) == 2;) {
        const std::string_view vr(reinterpret_cast<const char *>(file.data() + at + 4), 2);
        const bool isLong = vr == "OB" || vr == "UN" || vr == "SQ" || vr == "OW" || vr == "UT";
        const std::size_t bytes = isLong ? number(at + 8, 4) : number(at + 6, 2);
        const std::size_t value = at + (isLong ? 12 : 8);
        if (value > file.size() || bytes > file.size() - value)
            return std::nullopt;
        if (number(at + 2, 2) == 0x10) {
            meta.syntaxUid.assign(reinterpret_cast<const char *>(file.data() + value), bytes);
            while (!meta.syntaxUid.empty() &&
                   (meta.syntaxUid.back() == '\0' || meta.syntaxUid.back() == ' '))
                meta.syntaxUid.pop_back();
        }
        at = value + bytes;
        meta.end = at;
    }
    return meta.end > 0 ? std::optional(meta) : std::nullopt;
}

// Whether a data set that is declared to be explicit is implicit. The first element tells: little
// endian, of a low group, followed by two capitals or a length.
bool looksImplicit(std::span<const std::byte> file, const Meta &meta) {
    if (meta.end + 8 > file.size() || meta.syntaxUid == UID_LittleEndianImplicitTransferSyntax ||
        meta.syntaxUid == UID_BigEndianExplicitTransferSyntax ||
        meta.syntaxUid == UID_DeflatedExplicitVRLittleEndianTransferSyntax)
        return false;
    const auto byte = [&](std::size_t n) { return std::to_integer<int>(file[meta.end + n]); };
    const auto isCapital = [](int c) { return c >= 'A' && c <= 'Z'; };
    return byte(1) == 0 && !(isCapital(byte(4)) && isCapital(byte(5)));
}

bool isDeflated(const std::string &syntaxUid) {
    return syntaxUid == UID_DeflatedExplicitVRLittleEndianTransferSyntax;
}

} // namespace

LoadedFile::LoadedFile() : format(std::make_unique<DcmFileFormat>()) {}
LoadedFile::~LoadedFile() = default;
LoadedFile::LoadedFile(LoadedFile &&) noexcept = default;

DcmDataset &LoadedFile::dataset() const {
    return *format->getDataset();
}

LoadedFile loadFile(std::span<const std::byte> bytes, Extent extent) {
    dcmtk::prepareDcmtk();
    if (bytes.empty())
        throw Error(ErrorCode::unusable, because::isEmpty);
    if (!looksLikeDicom(bytes))
        throw Error(ErrorCode::unusable, because::isNotDicom);
    LoadedFile loaded;
    const auto meta = metaOf(bytes);
    const Uint32 longest = extent == Extent::header ? 4096 : DCM_MaxReadLength;
    OFCondition read = EC_Normal;
    if (meta && looksImplicit(bytes, *meta)) {
        loaded.oddities |= mislabelledEncoding;
        // The meta header contains the SOP class, which data sets may lack.
        const auto head = memoryInput(bytes.first(meta->end));
        loaded.format->transferInit();
        (void)loaded.format->read(*head, EXS_Unknown, EGL_noChange, longest);
        loaded.format->transferEnd();
        const auto rest = memoryInput(bytes.subspan(meta->end));
        DcmDataset &dataset = loaded.dataset();
        dataset.clear();
        dataset.transferInit();
        read = dataset.read(*rest, EXS_LittleEndianImplicit, EGL_noChange, longest);
        dataset.transferEnd();
    } else {
        const auto input = memoryInput(bytes);
        loaded.format->transferInit();
        if (extent == Extent::header && meta && isDeflated(meta->syntaxUid))
            read = loaded.format->readUntilTag(*input, EXS_Unknown, EGL_noChange, longest,
                                               DCM_PixelData);
        else
            read = loaded.format->read(*input, EXS_Unknown, EGL_noChange, longest);
        loaded.format->transferEnd();
    }
    loaded.isComplete = read.good();
    loaded.failure = read.good()                     ? ""
                     : read == EC_StreamNotifyClient ? "the file ends too early"
                                                     : read.text();
    DcmDataset *const dataset = loaded.format->getDataset();
    if (dataset == nullptr || dataset->card() == 0)
        throw Error(ErrorCode::unusable,
                    read.bad() ? because::isNotReadable(loaded.failure) : because::holdsNoData);
    loaded.syntaxUid = meta ? meta->syntaxUid : std::string();
    if (loaded.syntaxUid.empty())
        if (const char *const uid = DcmXfer(dataset->getOriginalXfer()).getXferID())
            loaded.syntaxUid = uid;
    return loaded;
}

bool isJpeg2000(const std::string &uid) {
    return uid == UID_JPEG2000LosslessOnlyTransferSyntax || uid == UID_JPEG2000TransferSyntax ||
           uid.starts_with("1.2.840.10008.1.2.4.20");
}

bool isJpegXl(const std::string &uid) {
    return uid.starts_with("1.2.840.10008.1.2.4.11");
}

bool isNative(const std::string &uid) {
    const DcmXfer transfer(uid.c_str());
    return transfer.getXfer() != EXS_Unknown && !transfer.isEncapsulated();
}

bool isDecodable(const std::string &uid) {
    if (isJpeg2000(uid) || isJpegXl(uid))
        return true;
    const DcmXfer transfer(uid.c_str());
    if (transfer.getXfer() == EXS_Unknown)
        return false;
    if (!transfer.isEncapsulated())
        return true;
    for (const E_TransferSyntax syntax :
         {EXS_JPEGProcess1, EXS_JPEGProcess2_4, EXS_JPEGProcess6_8, EXS_JPEGProcess10_12,
          EXS_JPEGProcess14, EXS_JPEGProcess14SV1, EXS_JPEGLSLossless, EXS_JPEGLSLossy,
          EXS_RLELossless})
        if (transfer.getXfer() == syntax)
            return true;
    return false;
}

std::string syntaxName(const std::string &uid) {
    for (const auto &[known, name] : otherSyntaxNames)
        if (uid == known)
            return name;
    const DcmXfer transfer(uid.c_str());
    return transfer.getXfer() == EXS_Unknown ? uid : transfer.getXferName();
}

} // namespace pellucid::decoding::process
