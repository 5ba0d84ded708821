// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <fcntl.h>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "core/archive/server.h"
#include "core/platform/handle.h"
#include "tests/network/acceptor.h"
#include "tests/network/pacs.h"
#include "tests/network/scripted_server.h"
#include "tests/network/servers.h"
#include "tests/support/dicom_writer.h"

namespace pellucid::test {

/// What happens before a server sends an object.
enum class Harm { none, stall, abort, close, reset, halfClose, release, strange };

/// What a DICOM server does differently.
struct ScpQuirks {
    int objects = 8;  ///< of its series
    int captures = 0; ///< of them, at the end, of another kind
    int studies = 19; ///< that it lists; the series is in the first
    std::string root = "1.2.826.0.1.3680043.8.498.66"; ///< of the UIDs of its objects
    bool countsObjects = true;                         ///< of the study and the series
    std::string comment{};                             ///< at the end of each request
    std::chrono::milliseconds delay{};                 ///< before it begins to answer
    int maxAssociations = 0;                           ///< at the same time; 0: any number
    const char *address = "127.0.0.1";
    ScriptedNegotiation negotiation{};                     ///< without its results
    std::string onlySyntax{};                              ///< that it accepts; empty: any
    std::optional<std::vector<std::string>> onlyClasses{}; ///< of objects
    std::uint16_t echoStatus = 0;

    std::uint16_t pending = 0xff00, findStatus = 0; ///< of each match; after the last one
    std::uint16_t findFailure = 0, seriesLevel = 0, imageLevel = 0; ///< in place of any answer
    bool isEndless = false, isDeaf = false, isDoubled = false;      ///< deaf: to a cancel
    enum class Empty { none, noDataset, noElements } first = Empty::none; ///< match
    /// Changes each match. `key`: the UID of its level.
    std::function<void(DicomWriter &match, DicomWriter::Tag key, int n)> match{};

    bool offersGet = true, offersMove = true, knowsDestination = true;
    const char *sendsFrom = nullptr; ///< by C-MOVE; null: its own address
    bool failsEachThird = false;     ///< of each request
    std::vector<int> unsendable{};
    std::optional<std::uint16_t> getStatus{}; ///< in place of objects
    Harm harm = Harm::none;
    int harmAt = 3;         ///< the object, counted from 1
    bool isForGood = false; ///< also at those after it
    bool isChanging = false, sendsExtra = false;

    std::uint16_t storeStatus = 0, everyThirdStoreStatus = 0;
    std::function<void(DicomWriter &)> object{}; ///< changes each object
};

/// A DICOM server with one series, which answers C-ECHO, C-FIND, C-GET, C-MOVE and C-STORE.
class OddScp {
public:
    static constexpr const char *ae = "ODD";

    explicit OddScp(ScpQuirks quirks)
        : destinationPort(freePort()), m_quirks(std::move(quirks)),
          m_acceptor([this](int client) { serve(client); }, m_quirks.address) {}

    archive::Server server() const {
        archive::Server server = serverAt(m_acceptor.port(), ae);
        server.peer.host = m_quirks.address;
        server.name = "odd";
        return server;
    }
    std::string study() const { return m_quirks.root; }
    std::string series() const { return study() + ".1"; }
    std::string instance(int n) const { return series() + "." + std::to_string(n + 1); }
    /// The port of the program, to which C-MOVE sends.
    const int destinationPort;

    DicomWriter object(int n) const {
        // Longer than the messages that a server may take.
        DicomWriter w = sliceOf({.rows = 100, .columns = 100}, n);
        w.put({0x0008, 0x0005}, "CS", "ISO_IR 100");
        w.put({0x0008, 0x0016}, "UI", classOf(n));
        w.put({0x0008, 0x0018}, "UI", instance(n));
        w.put({0x0008, 0x0020}, "DA", day);
        w.put({0x0010, 0x0010}, "PN", name);
        w.put({0x0020, 0x000d}, "UI", study());
        w.put({0x0020, 0x000e}, "UI", series());
        if (m_quirks.object)
            m_quirks.object(w);
        return w;
    }
    /// The data sets that it was sent and has stored, by the UIDs of their commands.
    std::map<std::string, std::string> stored() const {
        const std::lock_guard lock(m_mutex);
        return m_stored;
    }

private:
    static constexpr const char *day = "20260101", *name = "M\xfcller^Eva";
    static constexpr DicomWriter::Tag studyKey{0x0020, 0x000d}, seriesKey{0x0020, 0x000e},
        instanceKey{0x0008, 0x0018};

    // What has come of the objects of a request.
    struct Sent {
        int completed = 0;
        std::vector<std::string> failed;
    };

    // An association that is open.
    class Counted {
    public:
        explicit Counted(std::atomic<int> &count) : m_count(count), m_number(++count) {}
        ~Counted() { --m_count; }
        Counted(const Counted &) = delete;
        Counted &operator=(const Counted &) = delete;
        int number() const { return m_number; }

    private:
        std::atomic<int> &m_count;
        int m_number;
    };

    std::string classOf(int n) const {
        return n < m_quirks.objects - m_quirks.captures ? uid::ct : uid::capture;
    }

    void serve(int client) {
        const Counted association(m_open);
        ScriptedNegotiation negotiation = m_quirks.negotiation;
        negotiation.results = [this](const std::string &sopClass, const std::string &syntax) {
            return resultFor(sopClass, syntax);
        };
        if (m_quirks.maxAssociations != 0 && association.number() > m_quirks.maxAssociations)
            negotiation.rejection = {2, 3, 2}; // local limit exceeded
        try {
            ScriptedAssociation asked(client, negotiation);
            while (const auto request = asked.next())
                answer(asked, *request);
        } catch (const ProgramHasGone &) {
        } catch (const std::out_of_range &) { // what the program sent is shorter than it says
        }
    }
    int resultFor(const std::string &sopClass, const std::string &syntax) const {
        constexpr int accepted = 0, classIsRefused = 3, syntaxIsRefused = 4;
        const auto &classes = m_quirks.onlyClasses;
        const bool isObject = sopClass.starts_with("1.2.840.10008.5.1.4.1.1.");
        if ((sopClass == uid::get && !m_quirks.offersGet) ||
            (sopClass == uid::move && !m_quirks.offersMove) ||
            (isObject && classes &&
             std::find(classes->begin(), classes->end(), sopClass) == classes->end()))
            return classIsRefused;
        return m_quirks.onlySyntax.empty() || syntax == m_quirks.onlySyntax ? accepted
                                                                            : syntaxIsRefused;
    }
    void answer(ScriptedAssociation &asked, const ScriptedRequest &request) {
        if (request.field == command::cancel)
            return;
        pause(asked);
        switch (request.field) {
        case command::echoRequest:
            asked.answer(request, m_quirks.echoStatus, {}, withComment());
            break;
        case command::findRequest:
            find(asked, request);
            break;
        case command::getRequest:
            get(asked, request);
            break;
        case command::moveRequest:
            move(asked, request);
            break;
        case command::storeRequest:
            asked.answer(request, store(request), {}, withComment());
            break;
        default:
            throw ProgramHasGone();
        }
    }
    // Shorter if the program closes the connection.
    void pause(const ScriptedAssociation &asked) const {
        pollfd waiting{asked.socket(), POLLIN, 0};
        if (m_quirks.delay.count() > 0)
            ::poll(&waiting, 1, int(m_quirks.delay.count()));
    }
    DicomWriter withComment() const {
        DicomWriter fields;
        if (!m_quirks.comment.empty())
            fields.put({0x0000, 0x0902}, "LO", m_quirks.comment);
        return fields;
    }

    void find(ScriptedAssociation &asked, const ScriptedRequest &request) const {
        const std::string level = request.text(0x00080052);
        if (const std::uint16_t failure = failureOf(level); failure != 0) {
            asked.answer(request, failure, {}, withComment());
            return;
        }
        if (m_quirks.first == ScpQuirks::Empty::noDataset)
            asked.answer(request, m_quirks.pending);
        else if (m_quirks.first == ScpQuirks::Empty::noElements)
            asked.answer(request, m_quirks.pending, DicomWriter());
        const int count = matchesOf(level, request);
        for (int n = 0; n < count || (m_quirks.isEndless && count > 0); ++n) {
            if (!m_quirks.isDeaf && asked.isWaiting()) {
                asked.next();
                asked.answer(request, 0xfe00);
                return;
            }
            for (int time = 0; time < (m_quirks.isDoubled ? 2 : 1); ++time)
                asked.answer(request, m_quirks.pending, matchOf(level, n));
        }
        asked.answer(request, m_quirks.findStatus, {}, withComment());
    }
    std::uint16_t failureOf(const std::string &level) const {
        if (m_quirks.findFailure != 0)
            return m_quirks.findFailure;
        return level == "SERIES"  ? m_quirks.seriesLevel
               : level == "IMAGE" ? m_quirks.imageLevel
                                  : std::uint16_t(0);
    }
    int matchesOf(const std::string &level, const ScriptedRequest &request) const {
        if (!isAskedFor(request, 0x0020000d, study()) || !isAskedFor(request, 0x0020000e, series()))
            return 0;
        const bool isOneStudy = !request.text(0x0020000d).empty();
        return level == "IMAGE"                  ? m_quirks.objects
               : level == "SERIES" || isOneStudy ? 1
                                                 : m_quirks.studies;
    }
    // Whether a UID is in the list of a request, or the request has none.
    static bool isAskedFor(const ScriptedRequest &request, std::uint32_t key,
                           const std::string &value) {
        const std::string list = "\\" + request.text(key) + "\\";
        return list == "\\\\" || list.find("\\" + value + "\\") != std::string::npos;
    }
    DicomWriter matchOf(const std::string &level, int n) const {
        DicomWriter w;
        w.put({0x0008, 0x0005}, "CS", "ISO_IR 100");
        w.put({0x0008, 0x0020}, "DA", day);
        w.put({0x0008, 0x0052}, "CS", level);
        w.put({0x0008, 0x0054}, "AE", ae);
        w.put({0x0010, 0x0010}, "PN", name);
        w.put({0x0010, 0x0020}, "LO", "knobs");
        w.put(studyKey, "UI", study());
        if (level == "STUDY")
            describeStudy(w, n);
        else
            w.put(seriesKey, "UI", series());
        if (level == "SERIES")
            describeSeries(w);
        if (level == "IMAGE")
            describeObject(w, n);
        const auto key = level == "STUDY" ? studyKey : level == "SERIES" ? seriesKey : instanceKey;
        if (m_quirks.isEndless)
            w.put(key, "UI", "1.2.3." + std::to_string(n));
        if (m_quirks.match)
            m_quirks.match(w, key, n);
        return w;
    }
    void describeStudy(DicomWriter &w, int n) const {
        w.put({0x0008, 0x0061}, "CS", "CT");
        if (n > 0)
            w.put(studyKey, "UI", study() + ".2." + std::to_string(n));
        if (m_quirks.countsObjects) {
            w.put({0x0020, 0x1206}, "IS", "1");
            w.put({0x0020, 0x1208}, "IS", std::to_string(m_quirks.objects));
        }
    }
    void describeSeries(DicomWriter &w) const {
        w.put({0x0008, 0x0060}, "CS", "CT");
        w.put({0x0020, 0x0011}, "IS", "1");
        if (m_quirks.countsObjects)
            w.put({0x0020, 0x1209}, "IS", std::to_string(m_quirks.objects));
    }
    void describeObject(DicomWriter &w, int n) const {
        w.put({0x0008, 0x0016}, "UI", classOf(n));
        w.put(instanceKey, "UI", instance(n));
        w.put({0x0020, 0x0013}, "IS", std::to_string(n + 1));
        w.putNumbers({0x0020, 0x0032}, {0.0, 0.0, 2.0 * n});
        w.putNumbers({0x0020, 0x0037}, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0});
    }

    void get(ScriptedAssociation &asked, const ScriptedRequest &request) {
        if (m_quirks.getStatus)
            endWith(asked, request, *m_quirks.getStatus, {});
        else
            end(asked, request, sendObjects(asked, request, asked));
    }
    void move(ScriptedAssociation &asked, const ScriptedRequest &request) {
        constexpr std::uint16_t unknownDestination = 0xa801;
        const auto out = m_quirks.knowsDestination && !m_quirks.getStatus
                             ? connected(request.fieldText(0x00000600))
                             : nullptr;
        if (!out) {
            endWith(asked, request, m_quirks.getStatus.value_or(unknownDestination), {});
            return;
        }
        const Sent sent = sendObjects(asked, request, out->association);
        out->association.release();
        end(asked, request, sent);
    }
    // To the program, as a server that sends.
    struct Out {
        Out(int socket, const ScriptedProposal &proposal)
            : descriptor(socket), association(socket, proposal) {}
        platform::Handle descriptor;
        ScriptedAssociation association;
    };
    // Null if the program does not accept it.
    std::unique_ptr<Out> connected(const std::string &destinationAe) const {
        const char *const from =
            m_quirks.sendsFrom != nullptr ? m_quirks.sendsFrom : m_quirks.address;
        const int socket = connectTo(destinationPort, from);
        if (socket < 0)
            return nullptr;
        const std::string syntax =
            m_quirks.onlySyntax.empty() ? uid::explicitLittle : m_quirks.onlySyntax;
        try {
            return std::make_unique<Out>(
                socket, ScriptedProposal{destinationAe, ae, {uid::ct, uid::capture}, syntax});
        } catch (const ProgramHasGone &) {
            return nullptr;
        }
    }

    // `over`: the association on which they go.
    Sent sendObjects(ScriptedAssociation &asked, const ScriptedRequest &request,
                     ScriptedAssociation &over) {
        std::vector<int> chosen;
        for (int n = 0; n < m_quirks.objects; ++n)
            if (isAskedFor(request, 0x0020000d, study()) &&
                isAskedFor(request, 0x0020000e, series()) &&
                isAskedFor(request, 0x00080018, instance(n)))
                chosen.push_back(n);
        if (m_quirks.sendsExtra)
            chosen.insert(chosen.end(), {0, 1, 2});
        Sent sent;
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            harm(asked);
            if (!(m_quirks.failsEachThird && k % 3 == 2) && sendObject(over, chosen[k]))
                ++sent.completed;
            else
                sent.failed.push_back(instance(chosen[k]));
            asked.answer(request, 0xff00, {}, counts(sent, int(chosen.size() - k) - 1));
        }
        return sent;
    }
    // False if the server or the association cannot.
    bool sendObject(ScriptedAssociation &over, int n) {
        const auto &no = m_quirks.unsendable;
        const std::string sopClass = classOf(n);
        const bool isExplicit = over.maySend(sopClass, uid::explicitLittle);
        const std::string syntax = isExplicit ? uid::explicitLittle : uid::implicitLittle;
        // A kind that it does not take is not sent in any way.
        if (!over.maySend(sopClass, syntax) || resultFor(sopClass, syntax) != 0 ||
            std::find(no.begin(), no.end(), n) != no.end())
            return false;
        DicomWriter w = object(n);
        if (m_quirks.isChanging)
            w.put({0x0008, 0x0080}, "LO", "changed " + std::to_string(++m_changes));
        over.store(sopClass, instance(n), w.dataset({.isImplicit = !isExplicit}), syntax);
        return true;
    }
    void harm(const ScriptedAssociation &asked) {
        const int number = ++m_sent;
        if (m_quirks.harm == Harm::none || number < m_quirks.harmAt ||
            (number > m_quirks.harmAt && !m_quirks.isForGood))
            return;
        const std::string four(4, '\0');
        switch (m_quirks.harm) {
        case Harm::abort:
            asked.send(ScriptedAssociation::pdu(7, four));
            break;
        case Harm::reset:
            reset(asked.socket());
            break;
        case Harm::halfClose:
            ::shutdown(asked.socket(), SHUT_WR);
            asked.awaitEnd();
            break;
        case Harm::release:
            asked.send(ScriptedAssociation::pdu(5, four));
            asked.awaitEnd();
            break;
        case Harm::strange:
            asked.send(ScriptedAssociation::pdu(0x42, four));
            asked.awaitEnd();
            break;
        case Harm::stall:
            asked.awaitEnd();
            break;
        default:
            break;
        }
        throw ProgramHasGone(); // which closes the connection
    }
    // Without a farewell. The acceptor closes the number of the socket, which therefore stays
    // taken.
    static void reset(int socket) {
        const linger none{1, 0};
        ::setsockopt(socket, SOL_SOCKET, SO_LINGER, &none, sizeof none);
        const platform::Handle other(::open("/dev/null", O_RDWR | O_CLOEXEC));
        ::dup3(other.get(), socket, O_CLOEXEC);
    }
    DicomWriter counts(const Sent &sent, int remaining = 0) const {
        DicomWriter fields = withComment();
        if (remaining > 0)
            fields.putShort({0x0000, 0x1020}, remaining);
        fields.putShort({0x0000, 0x1021}, sent.completed);
        fields.putShort({0x0000, 0x1022}, int(sent.failed.size()));
        fields.putShort({0x0000, 0x1023}, 0);
        return fields;
    }
    void end(ScriptedAssociation &asked, const ScriptedRequest &request, const Sent &sent) const {
        endWith(asked, request,
                sent.failed.empty()  ? 0
                : sent.completed > 0 ? 0xb000
                                     : 0xa702,
                sent);
    }
    void endWith(ScriptedAssociation &asked, const ScriptedRequest &request, int status,
                 const Sent &sent) const {
        std::string uids;
        for (const std::string &uid : sent.failed)
            uids += (uids.empty() ? "" : "\\") + uid;
        std::optional<DicomWriter> list;
        if (!uids.empty())
            list.emplace().put({0x0008, 0x0058}, "UI", uids);
        asked.answer(request, std::uint16_t(status), list, counts(sent));
    }

    std::uint16_t store(const ScriptedRequest &request) {
        const std::lock_guard lock(m_mutex);
        if (m_quirks.everyThirdStoreStatus != 0 && ++m_storeRequests % 3 == 0)
            return m_quirks.everyThirdStoreStatus;
        m_stored[request.fieldText(0x00001000)] = request.bytes;
        return m_quirks.storeStatus;
    }

    const ScpQuirks m_quirks;
    std::atomic<int> m_open = 0, m_sent = 0, m_changes = 0;
    mutable std::mutex m_mutex;
    int m_storeRequests = 0;
    std::map<std::string, std::string> m_stored;
    Acceptor m_acceptor; // last: its threads use the others
};

} // namespace pellucid::test
