// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/dimse_dcmtk.h"

#include <cmath>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcmetinf.h>
#include <dcmtk/dcmdata/dcostrma.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/dimse.h>

#include "core/dicom_text/attributes.h"
#include "core/network/process/reasons.h"

namespace pellucid::network::process {

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
void writeMetaHeader(ObjectStream &stream, const Arrival &arrival) {
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
            command.comment = dicom_text::readText(detail, DCM_ErrorComment);
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

void receiveObject(Association &association, unsigned char context,
                   const T_DIMSE_C_StoreRQ &request, Control &control) {
    const auto ignore = [&] {
        DIC_UL bytes = 0, values = 0;
        const OFCondition ignored = DIMSE_ignoreDataSet(association.get(), DIMSE_NONBLOCKING,
                                                        patienceOf(association), &bytes, &values);
        if (ignored.bad())
            association.fail(ignored.text());
    };
    Arrival arrival{request.AffectedSOPClassUID, request.AffectedSOPInstanceUID,
                    association.syntaxOf(context), association.callingAe()};
    std::uint16_t status = status::invalidInstance;
    if (!isUid(arrival.sopClassUid) || !isUid(arrival.sopInstanceUid) ||
        !isUid(arrival.transferSyntax)) {
        ignore();
    } else if (Storage storage(control, arrival); !storage.isWanted()) {
        status = storage.status();
        ignore();
    } else {
        ObjectStream stream(storage);
        writeMetaHeader(stream, arrival);
        T_ASC_PresentationContextID got = context;
        const OFCondition received =
            DIMSE_receiveDataSetInFile(association.get(), DIMSE_NONBLOCKING,
                                       patienceOf(association), &got, &stream, nullptr, nullptr);
        if (received.bad())
            association.fail(received.text());
        requireContext(got, context);
        status = storage.finish();
    }
    T_DIMSE_C_StoreRSP response{};
    response.MessageIDBeingRespondedTo = request.MessageID;
    OFStandard::strlcpy(response.AffectedSOPClassUID, request.AffectedSOPClassUID,
                        sizeof response.AffectedSOPClassUID);
    OFStandard::strlcpy(response.AffectedSOPInstanceUID, request.AffectedSOPInstanceUID,
                        sizeof response.AffectedSOPInstanceUID);
    response.DataSetType = DIMSE_DATASET_NULL;
    response.DimseStatus = status;
    response.opts = O_STORE_AFFECTEDSOPCLASSUID | O_STORE_AFFECTEDSOPINSTANCEUID;
    const OFCondition sent =
        DIMSE_sendStoreResponse(association.get(), context, &request, &response, nullptr);
    if (sent.bad())
        association.fail(sent.text());
}

} // namespace pellucid::network::process
