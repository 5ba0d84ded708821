// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/dimse_dcmtk.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcmetinf.h>
#include <dcmtk/dcmdata/dcostrma.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/dimse.h>

#include "core/parse/attributes.h"

namespace pellucid::network {

namespace {

// Passes the bytes of a data set on, unchanged and unparsed.
class ObjectConsumer : public DcmConsumer {
public:
    explicit ObjectConsumer(Storage &storage) : m_storage(storage) {}
    OFBool good() const override { return OFTrue; }
    OFCondition status() const override { return EC_Normal; }
    OFBool isFlushed() const override { return OFTrue; }
    offile_off_t avail() const override { return offile_off_t(1) << 30; }
    offile_off_t write(const void *from, offile_off_t bytes) override {
        m_storage.write({static_cast<const std::byte *>(from), std::size_t(bytes)});
        return bytes;
    }
    void flush() override {}

private:
    Storage &m_storage;
};

class ObjectStream : public DcmOutputStream {
public:
    explicit ObjectStream(Storage &storage) : DcmOutputStream(&m_consumer), m_consumer(storage) {}

private:
    ObjectConsumer m_consumer;
};

// The meta header of a file (PS3.10, 7.1).
void writeMetaHeader(ObjectStream &stream, const exchange::Arrival &arrival) {
    DcmMetaInfo header;
    const Uint8 version[2] = {0, 1};
    header.putAndInsertUint8Array(DCM_FileMetaInformationVersion, version, 2);
    header.putAndInsertString(DCM_MediaStorageSOPClassUID, arrival.sopClassUid.c_str());
    header.putAndInsertString(DCM_MediaStorageSOPInstanceUID, arrival.sopInstanceUid.c_str());
    header.putAndInsertString(DCM_TransferSyntaxUID, arrival.transferSyntax.c_str());
    header.putAndInsertString(DCM_ImplementationClassUID, OFFIS_IMPLEMENTATION_CLASS_UID);
    header.putAndInsertString(DCM_ImplementationVersionName, OFFIS_DTK_IMPLEMENTATION_VERSION_NAME);
    header.putAndInsertUint32(DCM_FileMetaInformationGroupLength, 0);
    header.computeGroupLengthAndPadding(EGL_recalcGL, EPD_noChange,
                                        META_HEADER_DEFAULT_TRANSFERSYNTAX, EET_UndefinedLength);
    header.transferInit();
    header.write(stream, META_HEADER_DEFAULT_TRANSFERSYNTAX, EET_UndefinedLength, nullptr);
    header.transferEnd();
}

// A data set in another context may be encoded in another way than it says.
void requireContext(T_ASC_PresentationContextID got, unsigned char wanted) {
    if (got != wanted)
        throw Lost{task::because::dataComeInAnotherContext};
}

// Receives a data set in any encoding, also in one that DCMTK does not know.
void receiveBytes(Association &association, unsigned char context, Storage &storage) {
    DUL_ASSOCIATIONKEY **const link = &association.get()->DULassociation;
    for (;;) {
        DUL_PDV part{};
        if (DUL_NextPDV(link, &part).bad()) {
            const OFCondition read =
                DUL_ReadPDVs(link, nullptr, DUL_NOBLOCK, patienceOf(association));
            if (read != DUL_PDATAPDUARRIVED)
                association.fail(read.text());
            continue;
        }
        if (part.pdvType != DUL_DATASETPDV)
            throw Lost{task::because::serverSendsTheUnexpected};
        requireContext(part.presentationContextID, context);
        storage.write({static_cast<const std::byte *>(part.data), part.fragmentLength});
        if (part.lastPDV)
            return;
    }
}

std::string numberText(std::uint32_t value, int bytes) {
    std::string text;
    for (; bytes > 0; --bytes, value >>= 8)
        text += char(value & 0xff);
    return text;
}

} // namespace

Command::Command() : message(std::make_unique<T_DIMSE_Message>()) {}
Command::~Command() = default;
Command::Command(Command &&) noexcept = default;

int patienceOf(const Association &association) {
    return int(std::lround(association.silenceSeconds()));
}

std::optional<Command> nextCommand(Association &association, Control &control) {
    for (bool hasWaited = false;; hasWaited = true) {
        Command command;
        DcmDataset *detail = nullptr;
        // First without patience: the command may be in the last packet already.
        const OFCondition received = DIMSE_receiveCommand(
            association.get(), DIMSE_NONBLOCKING, hasWaited ? patienceOf(association) : 0,
            &command.context, command.message.get(), &detail);
        const std::unique_ptr<DcmDataset> owned(detail);
        if (received.good()) {
            command.comment = parse::readText(detail, DCM_ErrorComment);
            return command;
        }
        if (received != DIMSE_NODATAAVAILABLE)
            association.fail(received.text());
        if (association.wait(control) == Association::Event::cancel)
            return std::nullopt;
    }
}

std::unique_ptr<DcmDataset> receiveDataset(Association &association, unsigned char context) {
    DcmDataset *dataset = nullptr;
    T_ASC_PresentationContextID got = context;
    const OFCondition received =
        DIMSE_receiveDataSetInMemory(association.get(), DIMSE_NONBLOCKING, patienceOf(association),
                                     &got, &dataset, nullptr, nullptr);
    std::unique_ptr<DcmDataset> owned(dataset);
    if (received.bad() || !owned)
        association.fail(received.text());
    requireContext(got, context);
    return owned;
}

void CommandSet::put(std::uint16_t element, std::string value) {
    if (value.size() % 2 != 0)
        value += '\0';
    m_elements += numberText(0, 2) + numberText(element, 2) +
                  numberText(std::uint32_t(value.size()), 4) + value;
}

void CommandSet::put(std::uint16_t element, std::uint16_t value) {
    put(element, numberText(value, 2));
}

std::string CommandSet::bytes() const {
    CommandSet length;
    length.put(0, numberText(std::uint32_t(m_elements.size()), 4));
    return length.m_elements + m_elements;
}

void sendFragments(Association &association, unsigned char context, Fragments kind,
                   std::span<const std::byte> bytes, Control &control) {
    const std::size_t longest = association.get()->sendPDVLength;
    std::vector<std::byte> padded;
    do {
        const std::size_t now = std::min(longest, bytes.size());
        std::span<const std::byte> part = bytes.first(now);
        if (now % 2 != 0) { // of a file that lacks its padding
            padded.assign(part.begin(), part.end());
            padded.push_back(std::byte(0));
            part = padded;
        }
        DUL_PDV fragment{(unsigned long)(part.size()), context,
                         kind == Fragments::ofCommand ? DUL_COMMANDPDV : DUL_DATASETPDV,
                         OFBool(now == bytes.size()), const_cast<std::byte *>(part.data())};
        DUL_PDVLIST list{};
        list.count = 1;
        list.pdv = &fragment;
        if (const OFCondition sent = DUL_WritePDVs(&association.get()->DULassociation, &list);
            sent.bad())
            association.fail(sent.text());
        bytes = bytes.subspan(now);
        control.heartbeat();
    } while (!bytes.empty());
}

void receiveObject(Association &association, unsigned char context,
                   const T_DIMSE_C_StoreRQ &request, Control &control) {
    const auto ignore = [&] {
        DIC_UL bytes = 0, values = 0;
        const OFCondition ignored = DIMSE_ignoreDataSet(association.get(), DIMSE_NONBLOCKING,
                                                        patienceOf(association), &bytes, &values);
        if (ignored.bad())
            association.fail(ignored.text());
    };
    exchange::Arrival arrival{request.AffectedSOPClassUID, request.AffectedSOPInstanceUID,
                              association.syntaxOf(context), association.callingAe()};
    std::uint16_t status = exchange::status::invalidInstance;
    if (!exchange::isUid(arrival.sopClassUid) || !exchange::isUid(arrival.sopInstanceUid) ||
        !exchange::isUid(arrival.transferSyntax)) {
        ignore();
    } else if (Storage storage(control, arrival); !storage.isWanted()) {
        status = storage.status();
        ignore();
    } else {
        ObjectStream stream(storage);
        writeMetaHeader(stream, arrival);
        receiveBytes(association, context, storage);
        status = storage.finish();
    }
    CommandSet response;
    response.put(0x0002, arrival.sopClassUid);
    response.put(0x0100, std::uint16_t(DIMSE_C_STORE_RSP));
    response.put(0x0120, request.MessageID);
    response.put(0x0800, std::uint16_t(DIMSE_DATASET_NULL));
    response.put(0x0900, status);
    response.put(0x1000, arrival.sopInstanceUid);
    const std::string bytes = response.bytes();
    sendFragments(association, context, Fragments::ofCommand, std::as_bytes(std::span(bytes)),
                  control);
}

} // namespace pellucid::network
