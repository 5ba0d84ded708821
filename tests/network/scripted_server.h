// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <poll.h>
#include <set>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <utility>
#include <vector>

#include "tests/network/acceptor.h"
#include "tests/support/dicom_writer.h"

/// A DICOM server of the tests, written byte by byte without any library that could correct what it
/// says: it claims, sends and breaks off what a script wants (PS3.7, annex E; PS3.8, 9.3).
namespace pellucid::test {

namespace uid {
inline const std::string find = "1.2.840.10008.5.1.4.1.2.2.1", get = "1.2.840.10008.5.1.4.1.2.2.3",
                         move = "1.2.840.10008.5.1.4.1.2.2.2",
                         capture = "1.2.840.10008.5.1.4.1.1.7", ct = "1.2.840.10008.5.1.4.1.1.2",
                         implicitLittle = "1.2.840.10008.1.2",
                         explicitLittle = "1.2.840.10008.1.2.1",
                         application = "1.2.840.10008.3.1.1.1";
} // namespace uid

/// The fields of commands (PS3.7, annex E).
namespace command {
inline constexpr std::uint16_t storeRequest = 0x0001, getRequest = 0x0010, findRequest = 0x0020,
                               moveRequest = 0x0021, echoRequest = 0x0030, cancel = 0x0fff,
                               response = 0x8000;
inline constexpr int noDataset = 0x0101;
} // namespace command

/// Thrown when the program has closed the connection, or sent what is no DICOM.
struct ProgramHasGone {};

/// A command that the program has sent, and the data set after it.
struct ScriptedRequest {
    std::uint16_t field = 0, id = 0, status = 0;
    std::uint8_t context = 0;
    std::map<std::uint32_t, std::string> fields, dataset; ///< by tag
    std::string bytes;                                    ///< of the data set
    /// Without padding.
    std::string text(std::uint32_t tag) const { return textIn(dataset, tag); }
    /// The same of the command.
    std::string fieldText(std::uint32_t tag) const { return textIn(fields, tag); }

private:
    static std::string textIn(const std::map<std::uint32_t, std::string> &elements,
                              std::uint32_t tag) {
        const auto at = elements.find(tag);
        std::string text = at == elements.end() ? std::string() : at->second;
        while (!text.empty() && (text.back() == ' ' || text.back() == '\0'))
            text.pop_back();
        return text;
    }
};

/// How a server answers the request for an association (PS3.8, 9.3).
struct ScriptedNegotiation {
    /// The result for a transfer syntax of a presentation context that the program proposes (PS3.8,
    /// table 9-18). The first that is accepted is chosen.
    using Results = std::function<int(const std::string &sopClass, const std::string &syntax)>;
    Results results{}; ///< empty: all are accepted
    bool grantsRoles = true;
    std::size_t pduBytes = 16384; ///< of the longest message that it takes
    std::string items{};          ///< of the user information, also such as nobody asked for
    std::string login{};          ///< USER:PASSWORD, the only one that it accepts; empty: anybody
    /// Result, source and reason of a rejection (PS3.8, table 9-21).
    std::optional<std::array<int, 3>> rejection{};
};

/// What a server proposes that sends objects: each kind in one transfer syntax.
struct ScriptedProposal {
    std::string calledAe, callingAe;
    std::vector<std::string> sopClasses;
    std::string syntax = uid::explicitLittle;
};

/// One association. Sending and waiting *throw* ProgramHasGone.
class ScriptedAssociation {
public:
    /// The program asks for it.
    explicit ScriptedAssociation(int socket, const ScriptedNegotiation &negotiation = {})
        : m_socket(socket), m_pduBytes(negotiation.pduBytes), m_hasRoles(negotiation.grantsRoles) {
        accept(negotiation);
    }
    /// The program is asked for it.
    ScriptedAssociation(int socket, const ScriptedProposal &proposal) : m_socket(socket) {
        propose(proposal);
    }
    int socket() const { return m_socket; }

    /// The next command; nothing when the program has released the association.
    std::optional<ScriptedRequest> next() {
        std::string commandBytes;
        ScriptedRequest request;
        while (!receive(commandBytes, request.context, 1))
            if (m_isReleased)
                return std::nullopt;
        request.fields = elements(commandBytes, Encoding::implicitLittle);
        request.field = number(request.fields, 0x00000100);
        request.id = number(request.fields, 0x00000110);
        request.status = number(request.fields, 0x00000900);
        if (number(request.fields, 0x00000800) != command::noDataset) {
            while (!receive(request.bytes, request.context, 0))
                if (m_isReleased)
                    throw ProgramHasGone();
            request.dataset =
                elements(request.bytes, isImplicit(request.context) ? Encoding::implicitLittle
                                                                    : Encoding::explicitLittle);
        }
        return request;
    }
    /// Whether the program has sent something that nobody has read.
    bool isWaiting() const {
        pollfd waiting{m_socket, POLLIN, 0};
        return ::poll(&waiting, 1, 0) > 0;
    }
    /// Says nothing until the program has closed the connection.
    void awaitEnd() const {
        for (std::array<char, 256> bytes{}; ::recv(m_socket, bytes.data(), bytes.size(), 0) > 0;) {
        }
    }
    /// Ends an association that the program was asked for.
    void release() {
        send(pdu(5, std::string(4, '\0')));
        if (receivePdu().first != 6)
            throw ProgramHasGone();
    }

    /// Answers a request. `fields`: beside those that each answer has.
    void answer(const ScriptedRequest &request, std::uint16_t status,
                const std::optional<DicomWriter> &dataset = {}, DicomWriter fields = {}) {
        fields.putShort({0x0000, 0x0100}, request.field | command::response);
        fields.putShort({0x0000, 0x0120}, request.id);
        fields.putShort({0x0000, 0x0900}, status);
        fields.putShort({0x0000, 0x0800}, dataset ? 1 : command::noDataset);
        std::string bytes = commandPdu(request.context, fields);
        if (dataset)
            bytes += dataPdus(request.context,
                              dataset->dataset({.isImplicit = isImplicit(request.context)}));
        send(bytes);
    }
    /// The last answer to a C-GET.
    void endGet(const ScriptedRequest &request, std::uint16_t status, int completed,
                int failed = 0) {
        DicomWriter counts;
        counts.putShort({0x0000, 0x1021}, completed);
        counts.putShort({0x0000, 0x1022}, failed);
        counts.putShort({0x0000, 0x1023}, 0);
        answer(request, status, {}, counts);
    }

    /// The command that announces an object.
    std::string storeCommand(const std::string &sopClass, const std::string &sopInstance,
                             const std::string &syntax = uid::explicitLittle) {
        DicomWriter fields;
        fields.put({0x0000, 0x0002}, "UI", sopClass);
        fields.putShort({0x0000, 0x0100}, command::storeRequest);
        fields.putShort({0x0000, 0x0110}, ++m_lastId);
        fields.putShort({0x0000, 0x0700}, 0);
        fields.putShort({0x0000, 0x0800}, 1);
        fields.put({0x0000, 0x1000}, "UI", sopInstance);
        return commandPdu(contextOf(sopClass, syntax), fields);
    }
    /// Sends an object as it is announced. *Shape*: the status that the program answers with.
    std::uint16_t store(const std::string &sopClass, const std::string &sopInstance,
                        const std::string &dataset,
                        const std::string &syntax = uid::explicitLittle) {
        send(storeCommand(sopClass, sopInstance, syntax) +
             dataPdus(contextOf(sopClass, syntax), dataset));
        const auto answered = next();
        if (!answered || answered->field != (command::storeRequest | command::response))
            throw ProgramHasGone();
        return answered->status;
    }

    /// The context that was accepted for a kind of object.
    std::uint8_t contextOf(const std::string &sopClass,
                           const std::string &syntax = uid::explicitLittle) const {
        const auto at = m_contexts.find({sopClass, syntax});
        if (at == m_contexts.end())
            throw ProgramHasGone();
        return at->second;
    }
    /// Whether this side may send objects of this kind: it has the context, and the role for it.
    bool maySend(const std::string &sopClass, const std::string &syntax) const {
        return m_hasRoles && m_contexts.contains({sopClass, syntax});
    }

    /// Any bytes.
    void send(const std::string &bytes) const {
        for (std::size_t sent = 0; sent < bytes.size();) {
            const ssize_t now =
                ::send(m_socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (now <= 0)
                throw ProgramHasGone();
            sent += std::size_t(now);
        }
    }
    static std::string pdu(int type, const std::string &body) {
        return std::string{char(type), '\0'} + big(body.size(), 4) + body;
    }
    static std::string item(int type, const std::string &body) {
        return std::string{char(type), '\0'} + big(body.size(), 2) + body;
    }
    /// PS3.8, 9.3.2
    static std::string associationRequest(const ScriptedProposal &proposal) {
        const auto title = [](const std::string &text) {
            return text + std::string(16 - text.size(), ' ');
        };
        std::string contexts;
        for (std::size_t n = 0; n < proposal.sopClasses.size(); ++n)
            contexts +=
                item(0x20, std::string{char(2 * n + 1), '\0', '\0', '\0'} +
                               item(0x30, proposal.sopClasses[n]) + item(0x40, proposal.syntax));
        return pdu(1, std::string("\0\1\0\0", 4) + title(proposal.calledAe) +
                          title(proposal.callingAe) + std::string(32, '\0') +
                          item(0x10, uid::application) + contexts +
                          item(0x50, item(0x51, big(16384, 4)) + item(0x52, "1.2.3.4")));
    }
    /// A part of a message. `control`: 1: of a command, 2: the last, or both.
    static std::string value(std::uint8_t context, int control, const std::string &bytes) {
        return big(bytes.size() + 2, 4) + char(context) + char(control) + bytes;
    }
    static std::string commandPdu(std::uint8_t context, const DicomWriter &fields) {
        const DicomWriter::Form form{.isImplicit = true};
        const std::string rest = fields.dataset(form);
        DicomWriter length;
        length.put({0x0000, 0x0000}, "UL", DicomWriter::number(std::uint32_t(rest.size())));
        return pdu(4, value(context, 3, length.dataset(form) + rest));
    }
    /// A data set in pieces that every program takes.
    static std::string dataPdus(std::uint8_t context, const std::string &bytes) {
        constexpr std::size_t most = 16000;
        std::string all;
        for (std::size_t at = 0; at == 0 || at < bytes.size(); at += most)
            all +=
                pdu(4, value(context, at + most >= bytes.size() ? 2 : 0, bytes.substr(at, most)));
        return all;
    }
    static std::string big(std::size_t number, int bytes) {
        std::string text;
        for (int n = bytes - 1; n >= 0; --n)
            text += char(number >> (8 * n) & 0xff);
        return text;
    }

private:
    enum class Encoding { implicitLittle, explicitLittle };

    std::string receiveBytes(std::size_t count) const {
        std::string bytes(count, '\0');
        for (std::size_t got = 0; got < count;) {
            const ssize_t now = ::recv(m_socket, bytes.data() + got, count - got, 0);
            if (now <= 0)
                throw ProgramHasGone();
            got += std::size_t(now);
        }
        return bytes;
    }
    static std::size_t bigAt(const std::string &bytes, std::size_t at, int count) {
        std::size_t number = 0;
        for (int n = 0; n < count; ++n)
            number = number << 8 | std::size_t((unsigned char)(bytes.at(at + std::size_t(n))));
        return number;
    }
    static std::size_t littleAt(const std::string &bytes, std::size_t at, int count) {
        std::size_t number = 0;
        for (int n = count - 1; n >= 0; --n)
            number = number << 8 | std::size_t((unsigned char)(bytes.at(at + std::size_t(n))));
        return number;
    }
    std::pair<int, std::string> receivePdu() const {
        const std::string head = receiveBytes(6);
        const std::size_t length = bigAt(head, 2, 4);
        if (head[0] == 4 && length > m_pduBytes)
            throw ProgramHasGone();
        return {head[0], receiveBytes(length)};
    }

    // Adds what comes to a message. True when it is complete.
    bool receive(std::string &message, std::uint8_t &context, int kind) {
        for (;;) {
            if (m_waiting.empty()) {
                const auto [type, body] = receivePdu();
                if (type == 5) {
                    send(pdu(6, std::string(4, '\0')));
                    m_isReleased = true;
                    return false;
                }
                if (type != 4)
                    throw ProgramHasGone();
                m_waiting = body;
            }
            while (!m_waiting.empty()) {
                const std::size_t length = bigAt(m_waiting, 0, 4);
                context = std::uint8_t(m_waiting.at(4));
                const int control = m_waiting.at(5);
                if ((control & 1) != kind)
                    throw ProgramHasGone();
                message += m_waiting.substr(6, length - 2);
                m_waiting.erase(0, length + 4);
                if ((control & 2) != 0)
                    return true;
            }
        }
    }

    static std::map<std::uint32_t, std::string> elements(const std::string &bytes,
                                                         Encoding encoding) {
        std::map<std::uint32_t, std::string> found;
        for (std::size_t at = 0; at + 8 <= bytes.size();) {
            const auto tag =
                std::uint32_t(littleAt(bytes, at, 2) << 16 | littleAt(bytes, at + 2, 2));
            const bool isImplicit = encoding == Encoding::implicitLittle;
            const std::string vr = bytes.substr(at + 4, 2);
            const bool isLong = vr == "SQ" || vr == "OB" || vr == "OW" || vr == "UN" || vr == "UT";
            const std::size_t length = isImplicit ? littleAt(bytes, at + 4, 4)
                                       : isLong   ? littleAt(bytes, at + 8, 4)
                                                  : littleAt(bytes, at + 6, 2);
            at += !isImplicit && isLong ? 12 : 8;
            found[tag] = bytes.substr(at, length);
            at += length;
        }
        return found;
    }
    static std::uint16_t number(const std::map<std::uint32_t, std::string> &fields,
                                std::uint32_t tag) {
        const auto at = fields.find(tag);
        return at == fields.end() || at->second.size() < 2
                   ? std::uint16_t(0)
                   : std::uint16_t(littleAt(at->second, 0, 2));
    }

    // The items of an association request or within one of its items, in order.
    static std::vector<std::pair<int, std::string>> itemsOf(const std::string &bytes) {
        std::vector<std::pair<int, std::string>> items;
        for (std::size_t at = 0; at + 4 <= bytes.size();) {
            const std::size_t length = bigAt(bytes, at + 2, 2);
            items.emplace_back((unsigned char)(bytes[at]), bytes.substr(at + 4, length));
            at += 4 + length;
        }
        return items;
    }
    void accept(const ScriptedNegotiation &negotiation) {
        const auto [type, request] = receivePdu();
        if (type != 1 || request.size() < 68)
            throw ProgramHasGone();
        const auto items = itemsOf(request.substr(68));
        if (negotiation.rejection)
            reject(*negotiation.rejection);
        if (!negotiation.login.empty() && negotiation.login != loginIn(items))
            reject({2, 1, 1});
        std::string answer = request.substr(0, 68) + item(0x10, uid::application);
        std::string user = item(0x51, big(m_pduBytes, 4)) +
                           item(0x52, "1.2.826.0.1.3680043.8.498.1") + item(0x55, "SCRIPTED") +
                           negotiation.items;
        for (const auto &[kind, body] : items)
            if (kind == 0x20)
                answer += item(0x21, answerToContext(body, negotiation.results));
            else if (kind == 0x50 && m_hasRoles)
                user += rolesIn(body);
        send(pdu(2, answer + item(0x50, user)));
    }
    void reject(const std::array<int, 3> &why) const {
        send(pdu(3, std::string{'\0', char(why[0]), char(why[1]), char(why[2])}));
        throw ProgramHasGone();
    }
    // The user and the password of the items of a request (PS3.7, table D.3-14).
    static std::string loginIn(const std::vector<std::pair<int, std::string>> &items) {
        for (const auto &[kind, body] : items)
            if (kind == 0x50)
                for (const auto &[part, text] : itemsOf(body))
                    if (part == 0x58) {
                        const std::size_t length = bigAt(text, 2, 2);
                        return text.substr(4, length) + ":" + text.substr(6 + length);
                    }
        return {};
    }
    static std::string rolesIn(const std::string &userInformation) {
        std::string roles;
        for (const auto &[part, text] : itemsOf(userInformation))
            if (part == 0x54)
                roles += item(0x54, text);
        return roles;
    }
    std::string answerToContext(const std::string &body,
                                const ScriptedNegotiation::Results &results) {
        std::string sopClass, syntax;
        int result = 0;
        for (const auto &[part, text] : itemsOf(body.substr(4))) {
            if (part == 0x30)
                sopClass = text;
            if (part != 0x40 || (!syntax.empty() && result == 0))
                continue;
            syntax = text;
            result = results ? results(sopClass, syntax) : 0;
        }
        if (result == 0)
            note(std::uint8_t(body[0]), sopClass, syntax);
        return body.substr(0, 1) + '\0' + char(result) + '\0' + item(0x40, syntax);
    }
    void propose(const ScriptedProposal &proposal) {
        send(associationRequest(proposal));
        const auto [type, answer] = receivePdu();
        if (type != 2 || answer.size() < 68)
            throw ProgramHasGone();
        for (const auto &[kind, body] : itemsOf(answer.substr(68)))
            if (kind == 0x21 && body.at(2) == 0)
                note(std::uint8_t(body[0]), proposal.sopClasses.at(std::size_t(body[0] / 2)),
                     proposal.syntax);
    }
    void note(std::uint8_t context, const std::string &sopClass, const std::string &syntax) {
        m_contexts.emplace(std::pair(sopClass, syntax), context);
        if (syntax == uid::implicitLittle)
            m_implicit.insert(context);
    }
    bool isImplicit(std::uint8_t context) const { return m_implicit.contains(context); }

    int m_socket;
    std::size_t m_pduBytes = 16384;
    bool m_hasRoles = true, m_isReleased = false;
    std::uint16_t m_lastId = 0;
    std::string m_waiting;                                                  // of the last PDU
    std::map<std::pair<std::string, std::string>, std::uint8_t> m_contexts; // accepted ones
    std::set<std::uint8_t> m_implicit;                                      // of them
};

/// Runs a script for each request, in a thread of each association. C-ECHO is answered.
class ScriptedServer {
public:
    using Script = std::function<void(ScriptedAssociation &, const ScriptedRequest &)>;
    explicit ScriptedServer(Script script, ScriptedNegotiation::Results results = {})
        : m_script(std::move(script)), m_negotiation{.results = std::move(results)},
          m_acceptor([this](int client) { serve(client); }) {}
    int port() const { return m_acceptor.port(); }

private:
    void serve(int client) const {
        try {
            ScriptedAssociation association(client, m_negotiation);
            while (const auto request = association.next()) {
                if (request->field == command::echoRequest)
                    association.answer(*request, 0);
                else
                    m_script(association, *request);
            }
        } catch (const ProgramHasGone &) {
        } catch (const std::out_of_range &) { // what the program sent is shorter than it says
        }
    }

    Script m_script;
    ScriptedNegotiation m_negotiation;
    Acceptor m_acceptor; // last: its threads use the others
};

} // namespace pellucid::test
