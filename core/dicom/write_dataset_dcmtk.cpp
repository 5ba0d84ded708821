// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/write_dataset.h"

#include <array>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmdata/dcwcache.h>

#include <fmt/format.h>

#include "core/dicom/reasons.h"
#include "core/files/atomic_file.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::dicom {

using task::Error;
using task::ErrorCode;
namespace because = task::because;

std::string decimal(double value) {
    for (int digits = 12; digits > 0; --digits) {
        std::string text = fmt::format("{:.{}g}", value, digits);
        if (text.size() <= 16)
            return text;
    }
    return "0";
}

std::string decimals(std::initializer_list<double> values) {
    std::string text;
    for (const double v : values)
        text += (text.empty() ? "" : "\\") + decimal(v);
    return text;
}

std::string newUid(UidKind kind) {
    std::array<char, 100> uid{};
    return dcmGenerateUniqueIdentifier(uid.data(), kind == UidKind::study ? SITE_STUDY_UID_ROOT
                                                   : kind == UidKind::series
                                                       ? SITE_SERIES_UID_ROOT
                                                       : SITE_INSTANCE_UID_ROOT);
}

std::string randomUid() {
    std::random_device random;
    std::string digits; // in decimal, from 125 bits: no digit is lost, and the first is not 0
    for (int n = 0; n < 37; ++n)
        digits += char('0' + (n == 0 ? 1 + random() % 9 : random() % 10));
    return "2.25." + digits;
}

void put(DcmItem &dataset, const DcmTagKey &tag, const std::string &value) {
    if (dataset.putAndInsertOFStringArray(tag, value.c_str()).bad())
        throw Error(ErrorCode::internal, because::attributeCannotBeSet(fmt::format(
                                             "{:04x},{:04x}", tag.getGroup(), tag.getElement())));
}

// DCMTK's own file output does not notice a disk that becomes full at the last flush.
void writeDataset(DcmFileFormat &file, int transferSyntax, const std::filesystem::path &path) {
    files::AtomicFile target(path);
    std::vector<std::byte> buffer(1 << 20);
    DcmOutputBufferStream stream(buffer.data(), offile_off_t(buffer.size()));
    DcmWriteCache cache;
    const auto drain = [&] {
        void *data = nullptr;
        offile_off_t count = 0;
        stream.flushBuffer(data, count);
        target.write(std::span(static_cast<const std::byte *>(data), std::size_t(count)));
        return count;
    };
    file.transferInit();
    OFCondition written = EC_StreamNotifyClient;
    while (written == EC_StreamNotifyClient) {
        written = file.write(stream, E_TransferSyntax(transferSyntax), EET_ExplicitLength, &cache,
                             EGL_recalcGL, EPD_noChange);
        drain();
    }
    file.transferEnd();
    if (written.bad())
        throw Error(ErrorCode::output, because::cannotBeEncoded(written.text()), path);
    do // a deflating stream still holds data back
        stream.flush();
    while (drain() > 0 || !stream.isFlushed());
    target.commit();
}

} // namespace pellucid::dicom
