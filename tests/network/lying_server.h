// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/network/scripted_server.h"
#include "tests/support/dicom_writer.h"

namespace pellucid::test {

/// A server with one study, which it lists truly. What it sends when it is asked for instances
/// (C-GET) is up to the test.
class LyingServer {
public:
    static inline const std::string study = "1.2.826.0.1.3680043.8.498.55", series = study + ".1";
    static std::string instance(int n) { return series + "." + std::to_string(n + 1); }

    /// `get`: sends what it likes; the end of the request is its own. `uids`: those asked for.
    using Get = std::function<void(ScriptedAssociation &, const ScriptedRequest &,
                                   const std::vector<std::string> &uids)>;
    LyingServer(int instances, Get get)
        : m_get(std::move(get)), m_server([this, instances](ScriptedAssociation &association,
                                                            const ScriptedRequest &request) {
              if (request.field == command::findRequest)
                  list(association, request, m_hasStudy ? instances : 0);
              else if (request.field == command::getRequest)
                  m_get(association, request, split(request.text(0x00080018)));
          }) {}
    int port() const { return m_server.port(); }
    /// From now on, it has no study.
    void forgetStudy() { m_hasStudy = false; }

    /// The object as it would be true.
    static DicomWriter object(const std::string &uid) {
        DicomWriter writer;
        writer.put({0x0008, 0x0016}, "UI", uid::capture);
        writer.put({0x0008, 0x0018}, "UI", uid);
        writer.put({0x0008, 0x0060}, "CS", "OT");
        writer.put({0x0010, 0x0010}, "PN", "Lies^Jane");
        writer.put({0x0020, 0x000d}, "UI", study);
        writer.put({0x0020, 0x000e}, "UI", series);
        writer.put(DicomWriter::pixelData, "OW", std::string(4000, '\x5a'));
        return writer;
    }
    static std::uint16_t sendTruly(ScriptedAssociation &association, const std::string &uid) {
        return association.store(uid::capture, uid, object(uid).dataset({}));
    }

private:
    static std::vector<std::string> split(const std::string &text) {
        std::vector<std::string> parts;
        std::istringstream each(text);
        for (std::string part; std::getline(each, part, '\\');)
            parts.push_back(part);
        return parts;
    }
    static void list(ScriptedAssociation &association, const ScriptedRequest &request,
                     int instances) {
        const std::string level = request.text(0x00080052);
        DicomWriter row;
        row.put({0x0008, 0x0052}, "CS", level);
        row.put({0x0010, 0x0010}, "PN", "Lies^Jane");
        row.put({0x0010, 0x0020}, "LO", "LIES-1");
        row.put({0x0010, 0x0030}, "DA", "19700101");
        row.put({0x0020, 0x000d}, "UI", study);
        row.put({0x0020, 0x000e}, "UI", series);
        if (level == "IMAGE")
            for (int n = 0; n < instances; ++n) {
                row.put({0x0008, 0x0016}, "UI", uid::capture);
                row.put({0x0008, 0x0018}, "UI", instance(n));
                row.put({0x0020, 0x0013}, "IS", std::to_string(n + 1));
                association.answer(request, 0xff00, row);
            }
        else if (instances > 0)
            association.answer(request, 0xff00, row);
        association.answer(request, 0);
    }

    Get m_get;
    std::atomic<bool> m_hasStudy = true;
    ScriptedServer m_server; // last: its threads use the others
};

/// A lie about one object, which a sender can get away with until somebody reads the object.
struct Lie {
    std::string what;
    std::function<std::string(const std::string &uid)> dataset; ///< in place of the true one
};

inline std::vector<Lie> liesAboutObjects() {
    const auto changed = [](DicomWriter::Tag tag, const std::string &value) {
        return [tag, value](const std::string &uid) {
            DicomWriter writer = LyingServer::object(uid);
            if (value.empty())
                writer.remove(tag);
            else
                writer.put(tag, "UI", value);
            return writer.dataset({});
        };
    };
    // The value of a length field, whose place is counted from the end.
    const auto withLength = [](std::uint32_t length) {
        return [length](const std::string &uid) {
            std::string bytes = LyingServer::object(uid).dataset({});
            bytes.replace(bytes.size() - 4000 - 4, 4, DicomWriter::number(length));
            return bytes;
        };
    };
    return {
        {"cut short",
         [](const std::string &uid) {
             const std::string bytes = LyingServer::object(uid).dataset({});
             return bytes.substr(0, bytes.size() - 100);
         }},
        {"cut in an element's head",
         [](const std::string &uid) {
             const std::string bytes = LyingServer::object(uid).dataset({});
             return bytes.substr(0, bytes.size() - 4000 - 6);
         }},
        {"longer than it is", withLength(4200)},
        {"two gigabytes long", withLength(0x7ffffff0)},
        {"of undefined length", withLength(0xffffffff)},
        {"another instance", changed({0x0008, 0x0018}, LyingServer::instance(90))},
        {"another class", changed({0x0008, 0x0016}, "1.2.840.10008.5.1.4.1.1.2")},
        {"another study", changed({0x0020, 0x000d}, "1.2.826.0.1.3680043.8.498.56")},
        {"another series", changed({0x0020, 0x000e}, "1.2.826.0.1.3680043.8.498.55.2")},
        {"a path as its study", changed({0x0020, 0x000d}, "../../../../tmp/pellucid-lie")},
        {"a path as its series", changed({0x0020, 0x000e}, "..")},
        {"a path as its name", changed({0x0008, 0x0018}, "../lie")},
        {"no study", changed({0x0020, 0x000d}, "")},
        {"no instance", changed({0x0008, 0x0018}, "")},
        {"nothing", [](const std::string &) { return std::string(); }},
        {"a page", [](const std::string &) { return std::string(3000, '<'); }},
    };
}

/// A message that breaks the protocol; sent in place of an object.
struct Violation {
    std::string what;
    std::function<std::string(ScriptedAssociation &, const std::string &uid)> bytes;
};

inline std::vector<Violation> violations() {
    using A = ScriptedAssociation;
    const auto start = [](A &a, const std::string &uid) {
        return a.storeCommand(uid::capture, uid);
    };
    return {
        {"a value longer than its PDU",
         [=](A &a, const std::string &uid) {
             return start(a, uid) + A::pdu(4, A::big(100000, 4) + char(a.contextOf(uid::capture)) +
                                                  '\2' + std::string(200, 'x'));
         }},
        {"a value of no length",
         [=](A &a, const std::string &uid) {
             return start(a, uid) + A::pdu(4, A::big(0, 4) + std::string(200, 'x'));
         }},
        {"a PDU of four gigabytes",
         [=](A &a, const std::string &uid) {
             return start(a, uid) + std::string("\4\0\xff\xff\xff\xf0", 6) + std::string(200, 'x');
         }},
        {"a PDU beyond what was negotiated",
         [=](A &a, const std::string &uid) {
             return start(a, uid) +
                    A::pdu(4, A::value(a.contextOf(uid::capture), 2, std::string(1 << 20, 'x')));
         }},
        {"an unknown kind of PDU",
         [=](A &a, const std::string &uid) {
             return start(a, uid) + A::pdu(9, std::string(10, 'x'));
         }},
        {"a data set in another context",
         [=](A &a, const std::string &uid) {
             return start(a, uid) + A::dataPdus(std::uint8_t(a.contextOf(uid::get)),
                                                LyingServer::object(uid).dataset({}));
         }},
        {"a context that does not exist",
         [](A &, const std::string &uid) {
             DicomWriter fields;
             fields.put({0x0000, 0x0002}, "UI", uid::capture);
             fields.putShort({0x0000, 0x0100}, command::storeRequest);
             fields.putShort({0x0000, 0x0110}, 1);
             fields.putShort({0x0000, 0x0700}, 0);
             fields.putShort({0x0000, 0x0800}, 1);
             fields.put({0x0000, 0x1000}, "UI", uid);
             return A::commandPdu(255, fields) +
                    A::dataPdus(255, LyingServer::object(uid).dataset({}));
         }},
        {"a data set without a command",
         [](A &a, const std::string &uid) {
             return A::dataPdus(a.contextOf(uid::capture), LyingServer::object(uid).dataset({}));
         }},
        {"a command where the data set should be",
         [=](A &a, const std::string &uid) { return start(a, uid) + start(a, uid); }},
        {"a command of noise",
         [](A &a, const std::string &) {
             return A::pdu(4, A::value(a.contextOf(uid::capture), 3, std::string(300, '\x77')));
         }},
        {"another request in place of an answer",
         [](A &a, const std::string &) {
             DicomWriter fields;
             fields.put({0x0000, 0x0002}, "UI", uid::find);
             fields.putShort({0x0000, 0x0100}, command::findRequest);
             fields.putShort({0x0000, 0x0110}, 1);
             fields.putShort({0x0000, 0x0700}, 0);
             fields.putShort({0x0000, 0x0800}, command::noDataset);
             return A::commandPdu(a.contextOf(uid::get), fields);
         }},
        {"an abort", [](A &, const std::string &) { return A::pdu(7, std::string(4, '\0')); }},
    };
}

} // namespace pellucid::test
