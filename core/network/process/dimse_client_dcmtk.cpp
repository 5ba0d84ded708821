// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/dimse.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <sstream>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/dimse.h>

#include "core/dicom_text/attributes.h"
#include "core/files/mapping.h"
#include "core/network/client/reasons.h"
#include "core/network/process/dimse_dcmtk.h"
#include "core/network/process/file_start.h"
#include "core/network/process/reasons.h"
#include "core/network/process/statuses.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds cancelPatience(2);

const char *nameOf(Level level) {
    switch (level) {
    case Level::study:
        return "STUDY";
    case Level::series:
        return "SERIES";
    case Level::image:
        return "IMAGE";
    }
    return "STUDY";
}

DcmTagKey keyOf(std::uint32_t tag) {
    return {Uint16(tag >> 16), Uint16(tag & 0xffff)};
}

bool isAscii(const std::string &text) {
    for (const char c : text)
        if ((unsigned char)(c) >= 0x80)
            return false;
    return true;
}

// A question in the server's character set if it has all letters, else in UTF-8.
void encode(DcmDataset &identifier, const Attributes &keys, const std::string &set) {
    bool isPlain = true;
    for (const auto &[tag, value] : keys) {
        identifier.putAndInsertString(keyOf(tag), value.c_str());
        isPlain = isPlain && isAscii(value);
    }
    if (isPlain)
        return;
    identifier.putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 192");
    if (!set.empty() && set != "ISO_IR 192")
        identifier.convertCharacterSet("ISO_IR 192", set.c_str(), 0, OFTrue);
}

void isStillSending(void *control, unsigned long) {
    static_cast<Control *>(control)->heartbeat();
}

void send(Association &association, unsigned char context, T_DIMSE_Message &message,
          DcmDataset *dataset, Control &control) {
    const OFCondition sent = DIMSE_sendMessageUsingMemoryData(
        association.get(), context, &message, nullptr, dataset, &isStillSending, &control);
    if (sent.bad())
        association.fail(sent.text());
}

// A number in little endian.
std::string numberText(std::uint32_t value, int bytes) {
    std::string text;
    for (; bytes > 0; --bytes, value >>= 8)
        text += char(value & 0xff);
    return text;
}

// A command set, whose elements are in implicit VR little endian (PS3.7, 6.3.1). DCMTK sends none
// before a data set that it has not parsed.
class CommandSet {
public:
    void put(std::uint16_t element, std::string value) {
        if (value.size() % 2 != 0)
            value += '\0';
        m_elements += numberText(0, 2) + numberText(element, 2) +
                      numberText(std::uint32_t(value.size()), 4) + value;
    }
    void put(std::uint16_t element, std::uint16_t value) { put(element, numberText(value, 2)); }
    // With the length of the group.
    std::string bytes() const {
        CommandSet length;
        length.put(0, numberText(std::uint32_t(m_elements.size()), 4));
        return length.m_elements + m_elements;
    }

private:
    std::string m_elements;
};

std::string storeCommand(std::uint16_t id, const std::string &sopClass,
                         const std::string &instance) {
    CommandSet command;
    command.put(0x0002, sopClass);
    command.put(0x0100, std::uint16_t(DIMSE_C_STORE_RQ));
    command.put(0x0110, id);
    command.put(0x0700, std::uint16_t(DIMSE_PRIORITY_MEDIUM));
    command.put(0x0800, std::uint16_t(DIMSE_DATASET_PRESENT));
    command.put(0x1000, instance);
    return command.bytes();
}

// In fragments as long as the other side takes, which have an even length (PS3.8, annex E).
void sendFragments(Association &association, unsigned char context, DUL_DATAPDV kind,
                   std::span<const std::byte> bytes, Control &control) {
    const std::size_t longest = association.get()->sendPDVLength;
    std::vector<std::byte> padded;
    do {
        const std::size_t now = std::min(longest, bytes.size());
        std::span<const std::byte> part = bytes.first(now);
        if (now % 2 != 0) { // of a file without its padding
            padded.assign(part.begin(), part.end());
            padded.push_back(std::byte(0));
            part = padded;
        }
        DUL_PDV fragment{(unsigned long)(part.size()), context, kind, OFBool(now == bytes.size()),
                         const_cast<std::byte *>(part.data())};
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

// Sends the cancel, and gives the server time to end the request.
class Cancelling {
public:
    void begin(Association &association, unsigned char context, unsigned short request) {
        if (m_end)
            return;
        m_end = Clock::now() + cancelPatience;
        DIMSE_sendCancelRequest(association.get(), context, request);
    }
    bool hasBegun() const { return m_end.has_value(); }
    // Whether the server has ignored it; the association is over then.
    bool isIgnored(Association &association) const {
        if (!m_end || Clock::now() < *m_end)
            return false;
        association.abort();
        return true;
    }

private:
    std::optional<Clock::time_point> m_end;
};

Attributes attributesOf(DcmDataset &dataset, const Query &query, const std::string &defaultSet) {
    if (!defaultSet.empty() && !dataset.tagExistsWithValue(DCM_SpecificCharacterSet))
        dataset.putAndInsertString(DCM_SpecificCharacterSet, defaultSet.c_str());
    const dicom_text::CharacterSets sets(dataset);
    Attributes attributes;
    const auto take = [&](std::uint32_t tag) {
        if (std::string text = dicom_text::readText(&dataset, keyOf(tag), &sets); !text.empty())
            attributes[tag] = std::move(text);
    };
    for (const auto &[tag, value] : query.keys)
        take(tag);
    take(tag::retrieveAe);
    take(tag::availability);
    return attributes;
}

DcmDataset identifierOf(const Retrieval &retrieval) {
    DcmDataset identifier;
    identifier.putAndInsertString(DCM_QueryRetrieveLevel, nameOf(retrieval.level));
    identifier.putAndInsertString(DCM_StudyInstanceUID, retrieval.studyUid.c_str());
    if (retrieval.level != Level::study)
        identifier.putAndInsertString(DCM_SeriesInstanceUID, retrieval.seriesUid.c_str());
    if (retrieval.level == Level::image) {
        std::string uids;
        for (const std::string &uid : retrieval.instanceUids)
            uids += (uids.empty() ? "" : "\\") + uid;
        identifier.putAndInsertOFStringArray(DCM_SOPInstanceUID, OFString(uids.c_str()));
    }
    return identifier;
}

void takeFailed(DcmDataset &dataset, RetrievalEnd &end) {
    OFString uids;
    if (dataset.findAndGetOFStringArray(DCM_FailedSOPInstanceUIDList, uids).bad())
        return;
    std::istringstream each(std::string(uids.c_str()));
    for (std::string uid; std::getline(each, uid, '\\');)
        if (isUid(uid) && end.failedInstances.size() < uidsAtOnce)
            end.failedInstances.push_back(uid);
}

// The responses of C-GET and C-MOVE have the same fields.
template <class Response> void takeCounts(const Response &response, RetrievalEnd &end) {
    end.completed = response.NumberOfCompletedSubOperations;
    end.failed = response.NumberOfFailedSubOperations;
    end.warnings = response.NumberOfWarningSubOperations;
}

// Takes objects and responses until the last one.
RetrievalEnd retrieve(Association &association, unsigned char context, unsigned short request,
                      Control &control) {
    RetrievalEnd end;
    Cancelling cancelling;
    for (;;) {
        if (cancelling.isIgnored(association))
            throw CancelledByProgram();
        std::optional<Command> command = nextCommand(association, control);
        if (!command) {
            cancelling.begin(association, context, request);
            continue;
        }
        // While answers keep coming, nobody waits.
        if (control.isCancelled())
            cancelling.begin(association, context, request);
        T_DIMSE_Message &message = *command->message;
        if (message.CommandField == DIMSE_C_STORE_RQ) {
            receiveObject(association, command->context, message.msg.CStoreRQ, control);
            continue;
        }
        std::uint16_t status = 0;
        bool hasData = false;
        if (message.CommandField == DIMSE_C_GET_RSP) {
            const T_DIMSE_C_GetRSP &response = message.msg.CGetRSP;
            status = response.DimseStatus;
            hasData = response.DataSetType != DIMSE_DATASET_NULL;
            takeCounts(response, end);
        } else if (message.CommandField == DIMSE_C_MOVE_RSP) {
            const T_DIMSE_C_MoveRSP &response = message.msg.CMoveRSP;
            status = response.DimseStatus;
            hasData = response.DataSetType != DIMSE_DATASET_NULL;
            takeCounts(response, end);
        } else {
            throw Lost{because::serverSendsTheUnexpected};
        }
        if (hasData)
            takeFailed(*receiveDataset(association, command->context), end);
        if (isPending(status)) {
            control.heartbeat();
            continue;
        }
        if (cancelling.hasBegun())
            throw CancelledByProgram();
        if (status != 0 && !isWarning(status)) {
            const task::Reason reason = statusReason(status, command->comment);
            if (end.completed == 0)
                throw Error(ErrorCode::unusable, reason);
            // Objects that fail are counted and listed; the rest has come.
            end.reason = reason.encoded();
        }
        return end;
    }
}

// Sends a C-GET or C-MOVE, whose fields have the same names. `fields`: of the message.
template <class Fields>
RetrievalEnd request(Association &association, const char *model, T_DIMSE_Message &message,
                     Fields &fields, const Retrieval &retrieval, Control &control) {
    const unsigned char context = association.contextFor(model);
    DcmDataset identifier = identifierOf(retrieval);
    fields.MessageID = association.get()->nextMsgID++;
    OFStandard::strlcpy(fields.AffectedSOPClassUID, model, sizeof fields.AffectedSOPClassUID);
    fields.Priority = DIMSE_PRIORITY_MEDIUM;
    fields.DataSetType = DIMSE_DATASET_PRESENT;
    send(association, context, message, &identifier, control);
    return retrieve(association, context, fields.MessageID, control);
}

} // namespace

void echo(Association &association, Control &control) {
    T_DIMSE_Message request{};
    request.CommandField = DIMSE_C_ECHO_RQ;
    request.msg.CEchoRQ.MessageID = association.get()->nextMsgID++;
    OFStandard::strlcpy(request.msg.CEchoRQ.AffectedSOPClassUID, UID_VerificationSOPClass,
                        sizeof request.msg.CEchoRQ.AffectedSOPClassUID);
    request.msg.CEchoRQ.DataSetType = DIMSE_DATASET_NULL;
    send(association, association.contextFor(UID_VerificationSOPClass), request, nullptr, control);
    const std::optional<Command> answer = nextCommand(association, control);
    if (!answer)
        throw CancelledByProgram();
    if (answer->message->CommandField != DIMSE_C_ECHO_RSP)
        throw Lost{because::serverSendsTheUnexpected};
    if (const std::uint16_t status = answer->message->msg.CEchoRSP.DimseStatus; status != 0)
        throw Error(ErrorCode::unusable, statusReason(status, answer->comment));
    std::string offers;
    for (const auto &[uid, name] : std::initializer_list<std::pair<const char *, const char *>>{
             {UID_FINDStudyRootQueryRetrieveInformationModel, "C-FIND"},
             {UID_GETStudyRootQueryRetrieveInformationModel, "C-GET"},
             {UID_MOVEStudyRootQueryRetrieveInformationModel, "C-MOVE"},
             {UID_SecondaryCaptureImageStorage, "C-STORE"}})
        if (ASC_findAcceptedPresentationContextID(association.get(), uid) != 0)
            offers += std::string(offers.empty() ? "" : ", ") + name;
    control.step(Step::service, offers);
}

QueryEnd find(Association &association, const Query &query, Control &control) {
    const char *const model = UID_FINDStudyRootQueryRetrieveInformationModel;
    const unsigned char context = association.contextFor(model);
    DcmDataset identifier;
    identifier.putAndInsertString(DCM_QueryRetrieveLevel, nameOf(query.level));
    encode(identifier, query.keys, association.characterSet());
    T_DIMSE_Message request{};
    request.CommandField = DIMSE_C_FIND_RQ;
    T_DIMSE_C_FindRQ &find = request.msg.CFindRQ;
    find.MessageID = association.get()->nextMsgID++;
    OFStandard::strlcpy(find.AffectedSOPClassUID, model, sizeof find.AffectedSOPClassUID);
    find.Priority = DIMSE_PRIORITY_MEDIUM;
    find.DataSetType = DIMSE_DATASET_PRESENT;
    send(association, context, request, &identifier, control);

    QueryEnd end;
    Cancelling cancelling;
    bool isCancelledByUser = false;
    for (std::uint32_t matches = 0;;) {
        if (cancelling.isIgnored(association)) {
            if (isCancelledByUser)
                throw CancelledByProgram();
            return end;
        }
        bool isOver = false;
        std::optional<Command> command = [&] {
            try {
                return nextCommand(association, control);
            } catch (const Lost &) {
                isOver = end.reachedLimit; // all that was asked for is here
                if (!isOver)
                    throw;
                return std::optional<Command>();
            }
        }();
        if (isOver)
            return end;
        // While answers keep coming, nobody waits.
        if (!command || control.isCancelled()) {
            isCancelledByUser = true;
            cancelling.begin(association, context, find.MessageID);
        }
        if (!command)
            continue;
        if (command->message->CommandField != DIMSE_C_FIND_RSP)
            throw Lost{because::serverSendsTheUnexpected};
        const T_DIMSE_C_FindRSP &response = command->message->msg.CFindRSP;
        const std::uint16_t status = response.DimseStatus;
        std::unique_ptr<DcmDataset> answer;
        if (response.DataSetType != DIMSE_DATASET_NULL)
            answer = receiveDataset(association, command->context);
        if (isPending(status)) {
            if (query.limit != 0 && matches == query.limit) {
                end.reachedLimit = true;
                cancelling.begin(association, context, find.MessageID);
            } else if (answer && !cancelling.hasBegun()) {
                auto attributes = attributesOf(*answer, query, association.characterSet());
                if (!attributes.empty()) { // some servers begin with an empty one
                    ++matches;
                    control.match(query, std::move(attributes));
                }
            }
            continue;
        }
        if (isCancelledByUser)
            throw CancelledByProgram();
        if (!command->comment.empty())
            end.warnings.push_back(shortened(command->comment, longestComment));
        // The server ends it before all is listed: by a cancel that nobody asked for, by a warning
        // of its own, or for lack of resources.
        end.mayBeIncomplete = !end.reachedLimit && (isCancel(status) || isLimitOfServer(status) ||
                                                    (isOutOfResources(status) && matches > 0));
        if (status != 0 && !end.reachedLimit && !end.mayBeIncomplete && !isWarning(status))
            throw Error(ErrorCode::unusable, statusReason(status, command->comment));
        return end;
    }
}

RetrievalEnd get(Association &association, const Retrieval &retrieval, Control &control) {
    T_DIMSE_Message message{};
    message.CommandField = DIMSE_C_GET_RQ;
    return request(association, UID_GETStudyRootQueryRetrieveInformationModel, message,
                   message.msg.CGetRQ, retrieval, control);
}

RetrievalEnd move(Association &association, const Retrieval &retrieval, Control &control) {
    T_DIMSE_Message message{};
    message.CommandField = DIMSE_C_MOVE_RQ;
    OFStandard::strlcpy(message.msg.CMoveRQ.MoveDestination, retrieval.destinationAe.c_str(),
                        sizeof message.msg.CMoveRQ.MoveDestination);
    return request(association, UID_MOVEStudyRootQueryRetrieveInformationModel, message,
                   message.msg.CMoveRQ, retrieval, control);
}

std::optional<task::Reason> store(Association &association, platform::HandleView file,
                                  std::uint64_t bytes, Control &control) {
    const files::Mapping mapping(file, bytes, files::Mapping::Access::read);
    const FileStart start = startOf(mapping.bytes());
    const Encoding encoding{start.arrival.sopClassUid, start.arrival.transferSyntax};
    const auto context = association.contextFor(encoding);
    if (!context && association.isClassRefused(encoding.sopClassUid))
        throw Error(ErrorCode::unusable, because::serverLacksTheService);
    if (!context) {
        const char *const name = dcmFindNameOfUID(encoding.transferSyntax.c_str());
        throw Error(ErrorCode::unusable, because::serverDoesNotTakeTheEncoding(
                                             name != nullptr ? name : encoding.transferSyntax));
    }
    const std::string request = storeCommand(association.get()->nextMsgID++, encoding.sopClassUid,
                                             start.arrival.sopInstanceUid);
    sendFragments(association, *context, DUL_COMMANDPDV, std::as_bytes(std::span(request)),
                  control);
    sendFragments(association, *context, DUL_DATASETPDV, mapping.bytes().subspan(start.dataSet),
                  control);
    const std::optional<Command> answer = nextCommand(association, control);
    if (!answer) {
        association.abort();
        throw CancelledByProgram();
    }
    if (answer->message->CommandField != DIMSE_C_STORE_RSP)
        throw Lost{because::serverSendsTheUnexpected};
    const std::uint16_t status = answer->message->msg.CStoreRSP.DimseStatus;
    if (isWarning(status))
        return changeReason(status);
    if (status != 0)
        throw Error(ErrorCode::unusable, statusReason(status, answer->comment));
    return std::nullopt;
}

} // namespace pellucid::network::process
