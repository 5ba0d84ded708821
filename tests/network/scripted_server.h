// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <poll.h>
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
                         capture = "1.2.840.10008.5.1.4.1.1.7",
                         explicitLittle = "1.2.840.10008.1.2.1",
                         application = "1.2.840.10008.3.1.1.1";
} // namespace uid

/// The fields of commands (PS3.7, annex E).
namespace command {
inline constexpr std::uint16_t storeRequest = 0x0001, getRequest = 0x0010, findRequest = 0x0020,
                               echoRequest = 0x0030, cancel = 0x0fff, response = 0x8000;
inline constexpr int noDataset = 0x0101;
} // namespace command

/// Thrown when the program has closed the connection, or sent what is no DICOM.
struct ProgramHasGone {};

/// A command that the program has sent, and the data set after it.
struct ScriptedRequest {
    std::uint16_t field = 0, id = 0, status = 0;
    std::uint8_t context = 0;
    std::map<std::uint32_t, std::string> dataset; ///< by tag, without padding
    std::string text(std::uint32_t tag) const {
        const auto at = dataset.find(tag);
        return at == dataset.end() ? std::string() : at->second;
    }
};

/// One association. Sending and waiting *throw* ProgramHasGone.
class ScriptedAssociation {
public:
    /// The result for each presentation context that the program proposes (PS3.8, table 9-18): by
    /// its kind of object and its first transfer syntax.
    using Results = std::function<int(const std::string &sopClass, const std::string &syntax)>;
    /// `results`: empty: all are accepted.
    explicit ScriptedAssociation(int socket, const Results &results = {}) : m_socket(socket) {
        accept(results);
    }

    /// The next command; nothing when the program has released the association.
    std::optional<ScriptedRequest> next() {
        std::string commandBytes, dataBytes;
        ScriptedRequest request;
        while (!receive(commandBytes, request.context, 1))
            if (m_isReleased)
                return std::nullopt;
        const auto fields = elements(commandBytes, Encoding::implicitLittle);
        request.field = number(fields, 0x00000100);
        request.id = number(fields, 0x00000110);
        request.status = number(fields, 0x00000900);
        if (number(fields, 0x00000800) != command::noDataset) {
            while (!receive(dataBytes, request.context, 0))
                if (m_isReleased)
                    throw ProgramHasGone();
            request.dataset = elements(dataBytes, Encoding::explicitLittle);
        }
        return request;
    }
    /// Whether the program has sent something that nobody has read.
    bool isWaiting() const {
        pollfd waiting{m_socket, POLLIN, 0};
        return ::poll(&waiting, 1, 0) > 0;
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
            bytes += dataPdus(request.context, dataset->dataset({}));
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
    std::string storeCommand(const std::string &sopClass, const std::string &sopInstance) {
        DicomWriter fields;
        fields.put({0x0000, 0x0002}, "UI", sopClass);
        fields.putShort({0x0000, 0x0100}, command::storeRequest);
        fields.putShort({0x0000, 0x0110}, ++m_lastId);
        fields.putShort({0x0000, 0x0700}, 0);
        fields.putShort({0x0000, 0x0800}, 1);
        fields.put({0x0000, 0x1000}, "UI", sopInstance);
        return commandPdu(contextOf(sopClass), fields);
    }
    /// Sends an object as it is announced. *Shape*: the status that the program answers with.
    std::uint16_t store(const std::string &sopClass, const std::string &sopInstance,
                        const std::string &dataset) {
        send(storeCommand(sopClass, sopInstance) + dataPdus(contextOf(sopClass), dataset));
        const auto answered = next();
        if (!answered || answered->field != (command::storeRequest | command::response))
            throw ProgramHasGone();
        return answered->status;
    }

    /// The context that was accepted for a kind of object in explicit VR little endian.
    std::uint8_t contextOf(const std::string &sopClass) const {
        const auto at = m_contexts.find(sopClass);
        if (at == m_contexts.end())
            throw ProgramHasGone();
        return at->second;
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
        return {head[0], receiveBytes(bigAt(head, 2, 4))};
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
            std::string text = bytes.substr(at, length);
            at += length;
            // Numbers of commands keep their zeros.
            while (!isImplicit && !text.empty() && (text.back() == ' ' || text.back() == '\0'))
                text.pop_back();
            found[tag] = text;
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

    static std::string item(int type, const std::string &body) {
        return std::string{char(type), '\0'} + big(body.size(), 2) + body;
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
    // Accepts contexts with the first transfer syntax of their lists, and each role.
    void accept(const Results &results) {
        const auto [type, request] = receivePdu();
        if (type != 1 || request.size() < 68)
            throw ProgramHasGone();
        std::string answer = request.substr(0, 68) + item(0x10, uid::application);
        std::string user = item(0x51, big(16384, 4)) + item(0x52, "1.2.826.0.1.3680043.8.498.1") +
                           item(0x55, "SCRIPTED");
        for (const auto &[kind, body] : itemsOf(request.substr(68))) {
            if (kind == 0x20) {
                std::string sopClass, syntax;
                for (const auto &[part, text] : itemsOf(body.substr(4))) {
                    if (part == 0x30)
                        sopClass = text;
                    else if (part == 0x40 && syntax.empty())
                        syntax = text;
                }
                const int result = results ? results(sopClass, syntax) : 0;
                answer +=
                    item(0x21, body.substr(0, 1) + '\0' + char(result) + '\0' + item(0x40, syntax));
                if (result == 0 && syntax == uid::explicitLittle)
                    m_contexts.emplace(sopClass, std::uint8_t(body[0]));
            } else if (kind == 0x50) {
                for (const auto &[part, text] : itemsOf(body))
                    if (part == 0x54)
                        user += item(0x54, text);
            }
        }
        send(pdu(2, answer + item(0x50, user)));
    }

    int m_socket;
    bool m_isReleased = false;
    std::uint16_t m_lastId = 0;
    std::string m_waiting; // of the last PDU
    std::map<std::string, std::uint8_t> m_contexts;
};

/// Runs a script for each request, in a thread of each association. C-ECHO is answered.
class ScriptedServer {
public:
    using Script = std::function<void(ScriptedAssociation &, const ScriptedRequest &)>;
    explicit ScriptedServer(Script script, ScriptedAssociation::Results results = {})
        : m_script(std::move(script)), m_results(std::move(results)),
          m_acceptor([this](int client) { serve(client); }) {}
    int port() const { return m_acceptor.port(); }

private:
    void serve(int client) const {
        try {
            ScriptedAssociation association(client, m_results);
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
    ScriptedAssociation::Results m_results;
    Acceptor m_acceptor; // last: its threads use the others
};

} // namespace pellucid::test
