// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/association.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dcmtrans.h>
#include <dcmtk/dcmnet/dimse.h>
#include <dcmtk/dcmnet/diutil.h>
#include <dcmtk/dcmtls/tlslayer.h>

#include "core/network/client/reasons.h"
#include "core/network/process/confine.h"
#include "core/network/process/connect.h"
#include "core/network/process/reasons.h"
#include "core/platform/channel.h"
#include "core/platform/next_connect.h"
#include "core/platform/process.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;

// A presentation context has an odd number below 256.
constexpr std::size_t maxContexts = 128;

void prepareNetwork(double connectSeconds, double silenceSeconds) {
    platform::letBrokenPipesFail();
    dcmConnectionTimeout.set(Sint32(std::lround(connectSeconds)));
    dcmSocketReceiveTimeout.set(Sint32(std::lround(silenceSeconds)));
    dcmSocketSendTimeout.set(Sint32(std::lround(silenceSeconds)));
    dcmDisableGethostbyaddr.set(OFTrue); // names of clients are not looked up
    dcmMaxOutgoingPDUSize.set(ASC_MAXIMUMPDUSIZE);
}

task::Reason rejectionOf(const T_ASC_RejectParameters &rejection) {
    switch (rejection.reason) {
    case ASC_REASON_SU_CALLINGAETITLENOTRECOGNIZED:
        return because::serverDoesNotKnowUs;
    case ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED:
        return because::serverHasAnotherName;
    case ASC_REASON_SP_PRES_TEMPORARYCONGESTION:
        return because::serverIsBusy;
    case ASC_REASON_SP_PRES_LOCALLIMITEXCEEDED:
        return because::serverHasTooManyConnections;
    default:
        return because::serverRejectsUs;
    }
}

// Private kinds, and those that are newer than DCMTK, are stored as well.
bool isStorage(const std::string &sopClass) {
    const bool isOfDicom = sopClass.starts_with("1.2.840.10008.");
    return !isOfDicom || sopClass.starts_with("1.2.840.10008.5.1.4.1.1.") ||
           std::any_of(dcmAllStorageSOPClassUIDs,
                       dcmAllStorageSOPClassUIDs + numberOfDcmAllStorageSOPClassUIDs,
                       [&](const char *known) { return sopClass == known; });
}

std::string nameOf(const char *uid) {
    const char *const name = dcmFindNameOfUID(uid);
    return name != nullptr ? name : uid;
}

struct Proposal {
    std::string sopClass;
    std::vector<std::string> syntaxes;
    T_ASC_SC_ROLE role = ASC_SC_ROLE_DEFAULT;
};

const std::vector<std::string> plainSyntaxes{UID_LittleEndianExplicitTransferSyntax,
                                             UID_LittleEndianImplicitTransferSyntax};

// Servers that convert choose any encoding that they are offered. These two are hardly ever stored,
// and what is stored in them is asked for by itself when it has not come.
std::vector<std::string> usualSyntaxes() {
    std::vector<std::string> syntaxes = transferSyntaxes();
    std::erase(syntaxes, UID_DeflatedExplicitVRLittleEndianTransferSyntax);
    std::erase(syntaxes, UID_BigEndianExplicitTransferSyntax);
    return syntaxes;
}

// High-Throughput JPEG 2000: DCMTK 3.6.7 answers no message in a context of it.
bool isHighThroughput(const std::string &syntax) {
    return syntax.starts_with("1.2.840.10008.1.2.4.20");
}

// One context for each kind and syntax, the best syntaxes first if not all fit.
void proposeEach(std::vector<Proposal> &proposals, const std::vector<std::string> &classes,
                 const std::vector<std::string> &syntaxes) {
    for (const std::string &syntax : syntaxes)
        for (const std::string &sopClass : classes)
            if (proposals.size() < maxContexts)
                proposals.push_back({sopClass, {syntax}, ASC_SC_ROLE_SCP});
}

std::vector<Proposal> proposalsFor(const Connection &connection) {
    std::vector<Proposal> proposals;
    switch (connection.purpose) {
    case Purpose::echo:
        proposals.push_back({UID_VerificationSOPClass, plainSyntaxes});
        // The user hears what else it offers.
        proposals.push_back({UID_FINDStudyRootQueryRetrieveInformationModel, plainSyntaxes});
        proposals.push_back({UID_GETStudyRootQueryRetrieveInformationModel, plainSyntaxes});
        proposals.push_back({UID_MOVEStudyRootQueryRetrieveInformationModel, plainSyntaxes});
        proposals.push_back({UID_SecondaryCaptureImageStorage, plainSyntaxes});
        break;
    case Purpose::find:
        proposals.push_back({UID_FINDStudyRootQueryRetrieveInformationModel, plainSyntaxes});
        break;
    case Purpose::move:
        proposals.push_back({UID_MOVEStudyRootQueryRetrieveInformationModel, plainSyntaxes});
        break;
    case Purpose::get:
        proposals.push_back({UID_GETStudyRootQueryRetrieveInformationModel, plainSyntaxes});
        proposeEach(
            proposals, connection.sopClasses.empty() ? commonClasses() : connection.sopClasses,
            connection.transferSyntaxes.empty() ? usualSyntaxes() : connection.transferSyntaxes);
        break;
    case Purpose::store:
        for (const Encoding &encoding : connection.encodings)
            if (proposals.size() < maxContexts && !isHighThroughput(encoding.transferSyntax))
                proposals.push_back({encoding.sopClassUid, {encoding.transferSyntax}});
        break;
    case Purpose::login: // no service of DICOM
        break;
    }
    return proposals;
}

} // namespace

Association::Association(const Connection &connection, Control &control)
    : m_characterSet(connection.peer.characterSet),
      m_silenceSeconds(connection.peer.silenceSeconds) {
    const Peer &peer = connection.peer;
    prepareNetwork(peer.connectSeconds, peer.silenceSeconds);
    ConnectionEvents events{
        [this, &control, &peer] {
            control.step(Step::tcp, peer.host + ":" + std::to_string(peer.port));
            m_confinement = confine();
        },
        [&control](const std::string &parameters) { control.step(Step::tls, parameters); }};
    m_transport = peer.usesTls
                      ? std::make_unique<Transport>(
                            std::move(events), Certificates{peer.authorities, peer.certificate,
                                                            peer.key, peer.keyPassword, peer.host})
                      : std::make_unique<Transport>(std::move(events));
    m_transport->use(connectTo(peer, control).socket);
    platform::skipNextConnect();
    if (ASC_initializeNetwork(NET_REQUESTOR, 0, int(std::lround(peer.associationSeconds)),
                              &m_network)
            .bad())
        throw Lost{because::networkCannotBeSetUp};
    ASC_setTransportLayer(m_network, &m_transport->layer(), 0);
    negotiate(connection);
    control.step(Step::association, m_parameters->theirImplementationVersionName);
}

void Association::negotiate(const Connection &connection) {
    const Peer &peer = connection.peer;
    T_ASC_Parameters *parameters = nullptr;
    ASC_createAssociationParameters(&parameters, ASC_MAXIMUMPDUSIZE);
    ASC_setAPTitles(parameters, peer.callingAe.c_str(), peer.calledAe.c_str(), nullptr);
    ASC_setTransportLayerType(parameters, peer.usesTls);
    // DCMTK takes the connection that is there.
    ASC_setPresentationAddresses(parameters, "127.0.0.1",
                                 ("127.0.0.1:" + std::to_string(peer.port)).c_str());
    T_ASC_PresentationContextID id = 1;
    for (const Proposal &proposal : proposalsFor(connection)) {
        std::vector<const char *> syntaxes;
        for (const std::string &syntax : proposal.syntaxes)
            syntaxes.push_back(syntax.c_str());
        ASC_addPresentationContext(parameters, id, proposal.sopClass.c_str(), syntaxes.data(),
                                   int(syntaxes.size()), proposal.role);
        id = T_ASC_PresentationContextID(id + 2);
    }
    if (peer.authentication == Authentication::basic)
        ASC_setIdentRQUserPassword(parameters, peer.user.c_str(), peer.secret.c_str(), OFFalse);
    const OFCondition requested = ASC_requestAssociation(m_network, parameters, &m_association);
    m_parameters = m_association != nullptr ? m_association->params : parameters;
    if (requested.bad()) {
        if (requested == DUL_ASSOCIATIONREJECTED) {
            T_ASC_RejectParameters rejection{};
            ASC_getRejectParameters(m_parameters, &rejection);
            throw Lost{rejectionOf(rejection)};
        }
        failRequest(requested.text(), peer.usesTls);
    }
    // Each object's status says whether its class or only its encodings were refused.
    if (connection.purpose != Purpose::store &&
        ASC_countAcceptedPresentationContexts(m_parameters) == 0)
        throw task::Error(task::ErrorCode::unusable, because::serverLacksTheService);
}

void Association::failRequest(const std::string &text, bool usesTls) const {
    if (m_transport->refusal())
        throw Lost{*m_transport->refusal()};
    if (text.find("imeout") != std::string::npos)
        throw Lost{because::serverDoesNotAnswer};
    // A server that expects TLS hangs up, or answers with an alert, whose first byte is 15h.
    for (const char *const sign : {"closed", "bort", "eset by peer", "ype 15"})
        if (!usesTls && text.find(sign) != std::string::npos)
            throw Lost{because::tlsMayBeExpected};
    throw Lost{because::associationFails(text)};
}

Association::Association(const Acceptance &acceptance, platform::HandleView socket,
                         Control &control)
    : m_silenceSeconds(acceptance.silenceSeconds) {
    prepareNetwork(acceptance.silenceSeconds, acceptance.silenceSeconds);
    ConnectionEvents events{
        [] {}, [&control](const std::string &parameters) { control.step(Step::tls, parameters); }};
    m_transport =
        acceptance.usesTls
            ? std::make_unique<Transport>(std::move(events), Certificates{acceptance.authorities,
                                                                          acceptance.certificate,
                                                                          acceptance.key,
                                                                          acceptance.keyPassword,
                                                                          {},
                                                                          acceptance.clientHosts})
            : std::make_unique<Transport>(std::move(events));
    // The program has accepted the connection; DCMTK calls that external.
    dcmExternalSocketHandle.set(socket.get());
    const int patience = int(std::lround(acceptance.silenceSeconds));
    if (ASC_initializeNetwork(NET_ACCEPTOR, 0, patience, &m_network).bad())
        throw Lost{because::networkCannotBeSetUp};
    ASC_setTransportLayer(m_network, &m_transport->layer(), 0);
    m_confinement = confine();
    const OFCondition received =
        ASC_receiveAssociation(m_network, &m_association, ASC_MAXIMUMPDUSIZE, nullptr, nullptr,
                               m_transport->isSecure(), DUL_NOBLOCK, patience);
    m_parameters = m_association != nullptr ? m_association->params : nullptr;
    if (received.bad()) {
        if (m_transport->refusal())
            throw Lost{*m_transport->refusal()};
        throw Lost{because::associationFails(std::string(received.text()))};
    }
    std::array<char, 65> calling{}, called{};
    ASC_getAPTitles(m_parameters, calling.data(), calling.size(), called.data(), called.size(),
                    nullptr, 0);
    m_callingAe = calling.data();
    const auto reject = [&](T_ASC_RejectParametersReason why, const task::Reason &reason) {
        const T_ASC_RejectParameters rejection{ASC_RESULT_REJECTEDPERMANENT, ASC_SOURCE_SERVICEUSER,
                                               why};
        ASC_rejectAssociation(m_association, &rejection);
        throw Lost{reason};
    };
    if (!acceptance.calledAe.empty() && acceptance.calledAe != called.data())
        reject(ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED,
               because::wrongCalledTitle(m_callingAe, std::string(called.data())));
    if (!acceptance.callingAes.empty() &&
        std::find(acceptance.callingAes.begin(), acceptance.callingAes.end(), m_callingAe) ==
            acceptance.callingAes.end())
        reject(ASC_REASON_SU_CALLINGAETITLENOTRECOGNIZED, because::senderIsUnknown(m_callingAe));

    acceptContexts(control);
    if (ASC_acknowledgeAssociation(m_association).bad())
        throw Lost{because::serverHungUp};
    control.step(Step::association, m_callingAe);
}

void Association::acceptContexts(Control &control) {
    const auto accept = [&](const std::vector<std::string> &classes,
                            const std::vector<std::string> &syntaxes) {
        const auto pointers = [](const std::vector<std::string> &texts) {
            std::vector<const char *> all;
            for (const std::string &text : texts)
                all.push_back(text.c_str());
            return all;
        };
        auto kinds = pointers(classes), ways = pointers(syntaxes);
        ASC_acceptContextsWithPreferredTransferSyntaxes(
            m_parameters, kinds.data(), int(kinds.size()), ways.data(), int(ways.size()));
    };
    std::vector<std::string> objects;
    std::vector<T_ASC_PresentationContext> contexts(
        std::size_t(ASC_countPresentationContexts(m_parameters)));
    for (std::size_t n = 0; n < contexts.size(); ++n) {
        ASC_getPresentationContext(m_parameters, int(n), &contexts[n]);
        if (isStorage(contexts[n].abstractSyntax))
            objects.emplace_back(contexts[n].abstractSyntax);
    }
    accept({UID_VerificationSOPClass}, plainSyntaxes);
    accept(objects, transferSyntaxes());
    std::string refused;
    for (const T_ASC_PresentationContext &context : contexts)
        if (syntaxOf(context.presentationContextID).empty())
            refused += (refused.empty() ? "" : ", ") + nameOf(context.abstractSyntax) + " in " +
                       nameOf(context.proposedTransferSyntaxes[0]);
    if (!refused.empty())
        control.step(Step::refused, refused);
}

Association::~Association() {
    if (m_association != nullptr) {
        ASC_dropAssociation(m_association);
        ASC_destroyAssociation(&m_association);
    } else if (m_parameters != nullptr) {
        ASC_destroyAssociationParameters(&m_parameters);
    }
    if (m_network != nullptr)
        ASC_dropNetwork(&m_network);
}

unsigned char Association::contextFor(const std::string &sopClassUid) const {
    const T_ASC_PresentationContextID id =
        ASC_findAcceptedPresentationContextID(m_association, sopClassUid.c_str());
    if (id == 0)
        throw task::Error(task::ErrorCode::unusable, because::serverLacksTheService);
    return id;
}

std::optional<unsigned char> Association::contextFor(const Encoding &encoding) const {
    const T_ASC_PresentationContextID id = ASC_findAcceptedPresentationContextID(
        m_association, encoding.sopClassUid.c_str(), encoding.transferSyntax.c_str());
    if (id == 0 || syntaxOf(id) != encoding.transferSyntax)
        return std::nullopt;
    return id;
}

std::string Association::syntaxOf(unsigned char context) const {
    T_ASC_PresentationContext found{};
    if (ASC_findAcceptedPresentationContext(m_parameters, context, &found).bad())
        return {};
    return found.acceptedTransferSyntax;
}

bool Association::isClassRefused(const std::string &sopClassUid) const {
    for (int n = 0; n < ASC_countPresentationContexts(m_parameters); ++n) {
        T_ASC_PresentationContext context{};
        const bool isOfClass = ASC_getPresentationContext(m_parameters, n, &context).good() &&
                               sopClassUid == context.abstractSyntax;
        if (isOfClass && (context.resultReason == ASC_P_ACCEPTANCE ||
                          context.resultReason == ASC_P_TRANSFERSYNTAXESNOTSUPPORTED))
            return false;
    }
    return true;
}

Association::Event Association::wait(Control &control) const {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(m_silenceSeconds);
    for (;;) {
        // Bytes that TLS has already decrypted are not seen by poll.
        if (ASC_dataWaiting(m_association, 0))
            return Event::data;
        const std::array sockets{m_transport->socket()};
        const std::vector<bool> ready = platform::awaitAny(control.channel(), sockets, 1000);
        if (ready[1])
            return Event::data;
        if (ready[0] && control.isCancelled())
            return Event::cancel;
        if (Clock::now() > end)
            throw Lost{because::serverIsSilent(std::lround(m_silenceSeconds))};
    }
}

void Association::fail(const char *text) const {
    const std::string said = text;
    if (m_transport->refusal())
        throw Lost{*m_transport->refusal()};
    if (said.find("closed") != std::string::npos || said.find("bort") != std::string::npos ||
        said.find("elease") != std::string::npos)
        throw Lost{because::serverHungUp};
    throw Lost{because::connectionFails(said)};
}

void Association::abort() {
    ASC_abortAssociation(m_association);
}

void Association::release() {
    ASC_releaseAssociation(m_association);
}

} // namespace pellucid::network::process
