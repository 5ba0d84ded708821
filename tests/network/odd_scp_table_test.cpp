// SPDX-License-Identifier: GPL-3.0-or-later
// Each habit of a DICOM server that has been met or that the standard allows, and what comes of it:
// what can come comes, a part is called a part, a reason says what is wrong, nothing hangs.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/archive/retrieval.h"
#include "core/archive/server.h"
#include "core/network/client/link.h"
#include "core/task/progress.h"
#include "tests/network/odd_scp.h"
#include "tests/network/odd_table.h"
#include "tests/network/pacs.h"
#include "tests/network/scripted_server.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"

namespace pellucid {

namespace {

using namespace test;
using std::chrono::milliseconds;
using Tag = DicomWriter::Tag;
using Empty = ScpQuirks::Empty;

enum class Task { echo, search, retrieve, store };

// An asterisk in the outcome is any text.
struct Row {
    Task task;
    const char *quirk;
    ScpQuirks quirks;
    const char *outcome;
    std::function<void(archive::Server &)> entered{}; ///< by the user, about the server
    bool hasImplicitFiles = false;                    ///< to send
};

// What the user enters.
void isImpatient(archive::Server &server) {
    server.peer.silenceSeconds = 1.0;
}
void hasALimit(archive::Server &server) {
    server.limit = 200;
}
void movesOnly(archive::Server &server) {
    server.retrieve = archive::RetrieveMethod::move;
}
void knowsTheOtherHost(archive::Server &server) {
    server.sendsFrom = {"127.0.0.2"};
}
void hasTheWrongHost(archive::Server &server) {
    server.peer.host = "127.0.0.1";
}

// Changes of the UID of each match.
using Match = std::function<void(DicomWriter &, Tag, int)>;

Match changesUids(std::function<std::string(const std::string &)> change) {
    return [change = std::move(change)](DicomWriter &match, Tag key, int) {
        std::string uid = match.text(key);
        if (uid.back() == '\0')
            uid.pop_back();
        match.put(key, "UI", change(uid));
    };
}
const Match endsInSpaces =
    changesUids([](const std::string &uid) { return uid + (uid.size() % 2 != 0 ? " " : "  "); });
const Match endsInZeros =
    changesUids([](const std::string &uid) { return uid + std::string(3, '\0'); });
const Match hasInvalidUids = changesUids([](const std::string &uid) { return uid + "_A"; });
const Match lacksTheFirstUid = [](DicomWriter &match, Tag key, int n) {
    if (n == 0)
        match.remove(key);
};
const Match lacksTheUidOfAnObject = [](DicomWriter &match, Tag key, int n) {
    if (n == 0 && key == Tag(0x0008, 0x0018))
        match.remove(key);
};

void addPrivate(DicomWriter &w) {
    DicomWriter item;
    item.put({0x0008, 0x0100}, "SH", "1");
    item.put({0x0008, 0x0104}, "LO", "nested");
    w.put({0x0011, 0x0010}, "LO", "ODD SERVER");
    w.put({0x0011, 0x1001}, "LO", std::string(60, 'x'));
    w.put({0x0011, 0x1002}, "UN", "\1\2\3\4");
    w.putSequence({0x0011, 0x1003}, {item});
}
const Match hasPrivateElements = [](DicomWriter &match, Tag, int) { addPrivate(match); };

// The same values in other representations.
const Match hasWrongVrs = [](DicomWriter &match, Tag, int) {
    for (const auto &[tag, vr] : {std::pair(Tag(0x0008, 0x0020), "LO"),
                                  {Tag(0x0010, 0x0020), "ST"},
                                  {Tag(0x0020, 0x0013), "LO"}})
        if (match.has(tag))
            match.put(tag, vr, match.text(tag));
    if (match.has({0x0020, 0x1208}))
        match.putShort({0x0020, 0x1208}, 8);
};
const Match hasNoCharacterSet = [](DicomWriter &match, Tag, int) {
    match.remove({0x0008, 0x0005});
};
const Match hasStudyKeysOnly = [](DicomWriter &match, Tag, int) {
    match.remove({0x0020, 0x0032});
    match.remove({0x0020, 0x0037});
};

// What an encoder of its own would write differently: the length of a group, sequences of defined
// length, private elements, padding.
void addWhatEncodersChange(DicomWriter &object) {
    object.put({0x0008, 0x0000}, "UL", DicomWriter::number(std::uint32_t(4711)));
    addPrivate(object);
    object.put({0xfffc, 0xfffc}, "OB", std::string(32, '\0'));
}

// The quirks of associations, which concern each task. `outcome`: of the task at a server without
// any.
std::vector<Row> associating(Task task, const char *outcome) {
    const ScriptedNegotiation wantsLogin{.login = "eva:secret"};
    const bool stores = task == Task::store;
    const auto fails = [stores](const char *storing, const char *otherwise) {
        return stores ? storing : otherwise;
    };
    return {
        {task, "none", {}, outcome},
        {task, "identity", {.negotiation = wantsLogin}, outcome, hasPassword},
        {task,
         "identity, no login",
         {.negotiation = wantsLogin},
         fails("0 sent: the server rejects the association*",
               "the server rejects the association*")},
        {task, "pdu=4096", {.negotiation = {.pduBytes = 4096}}, outcome},
        {task, "pdu=16384", {.negotiation = {.pduBytes = 16384}}, outcome},
        {task,
         "async",
         {.negotiation = {.items = ScriptedAssociation::item(0x53, std::string("\0\5\0\5", 4))}},
         outcome},
        {task,
         "reject",
         {.negotiation = {.rejection = std::array{1, 1, 7}}},
         fails("0 sent: the server does not accept this AE title as its own; check the AE title of "
               "the server",
               "the server does not accept this AE title as its own; check the AE title of the "
               "server")},
        {task, "maxassoc=2", {.maxAssociations = 2}, outcome},
        {task, "maxassoc=1", {.maxAssociations = 1}, outcome},
        {task, "bind", {.address = "127.0.0.2"}, outcome},
        {task,
         "bind, another address",
         {.address = "127.0.0.2"},
         fails("0 sent: the host refuses connections to this port*",
               "the host refuses connections to this port*"),
         hasTheWrongHost},
        {task,
         "comment",
         {.comment = "hello"},
         task == Task::search ? "19 studies, warning: hello" : outcome},
        {task, "delay", {.delay = milliseconds(100)}, outcome},
    };
}

std::vector<Row> searching() {
    constexpr Task task = Task::search;
    return {
        {task, "ff01", {.pending = 0xff01}, "19 studies"},
        {task, "endstatus=B001", {.findStatus = 0xb001}, "19 studies, may be incomplete"},
        {task, "endstatus=A700", {.findStatus = 0xa700}, "19 studies, may be incomplete"},
        {task,
         "endstatus=A700, comment",
         {.comment = "list is cut", .findStatus = 0xa700},
         "19 studies, may be incomplete, warning: list is cut"},
        {task, "endstatus=FE00", {.findStatus = 0xfe00}, "19 studies, may be incomplete"},
        {task,
         "endstatus=C001",
         {.findStatus = 0xc001},
         "19 studies, then: the server cannot process the request (0xC001)"},
        {task, "uidpad", {.match = endsInSpaces}, "19 studies"},
        {task, "uidnul", {.match = endsInZeros}, "19 studies"},
        {task, "nouid", {.match = lacksTheFirstUid}, "18 studies, 1 without a UID"},
        {task, "leadingzero", {.root = "1.2.826.0.1.007"}, "19 studies"},
        {task, "private", {.match = hasPrivateElements}, "19 studies"},
        {task, "wrongvr", {.match = hasWrongVrs}, "19 studies"},
        {task, "baduid", {.match = hasInvalidUids}, "0 studies, 19 without a UID"},
        {task, "emptypending", {.first = Empty::noDataset}, "19 studies"},
        {task, "emptypending, a data set", {.first = Empty::noElements}, "19 studies"},
        {task, "nocharset", {.match = hasNoCharacterSet}, "19 studies"},
        {task, "onlystudykeys", {.match = hasStudyKeysOnly}, "19 studies"},
        {task,
         "findfail=A700, comment",
         {.comment = "the database is down", .findFailure = 0xa700},
         "the server is out of resources (0xA700: the database is down)"},
        {task,
         "findfail=C001",
         {.findFailure = 0xc001},
         "the server cannot process the request (0xC001)"},
        {task, "endless", {.isEndless = true}, "200 studies, may be incomplete", hasALimit},
        {task,
         "endless, deaf to the cancel",
         {.isEndless = true, .isDeaf = true},
         "200 studies, may be incomplete",
         hasALimit},
        {task, "dup", {.isDoubled = true}, "19 studies"},
        {task,
         "delay, too long",
         {.delay = milliseconds(5000)},
         "the server has sent nothing for 1 s",
         isImpatient},
        {task, "implicitonly", {.onlySyntax = uid::implicitLittle}, "19 studies"},
        {task, "explicitonly", {.onlySyntax = uid::explicitLittle}, "19 studies"},
    };
}

// The quirks of lists. What is not listed comes with its series or study.
std::vector<Row> retrievingWhatIsListed() {
    constexpr Task task = Task::retrieve;
    constexpr const char *all = "8 of 8";
    return {
        {task, "ff01", {.pending = 0xff01}, all},
        {task, "endstatus=B001", {.findStatus = 0xb001}, all},
        {task, "endstatus=A700", {.findStatus = 0xa700}, all},
        {task, "endstatus=FE00", {.findStatus = 0xfe00}, all},
        {task,
         "endstatus=C001",
         {.findStatus = 0xc001},
         "the server cannot process the request (0xC001)"},
        {task, "uidpad", {.match = endsInSpaces}, all},
        {task, "uidnul", {.match = endsInZeros}, all},
        {task, "nouid", {.match = lacksTheFirstUid}, all},
        {task, "nouid, of an object", {.match = lacksTheUidOfAnObject}, all},
        {task, "leadingzero", {.root = "1.2.826.0.1.007"}, all},
        {task, "private", {.match = hasPrivateElements}, all},
        {task, "wrongvr", {.match = hasWrongVrs}, all},
        {task, "baduid", {.match = hasInvalidUids}, all},
        {task, "emptypending", {.first = Empty::noDataset}, all},
        {task, "emptypending, a data set", {.first = Empty::noElements}, all},
        {task, "nocharset", {.match = hasNoCharacterSet}, all},
        {task, "onlystudykeys", {.match = hasStudyKeysOnly}, all},
        {task, "dup", {.isDoubled = true}, all},
        {task,
         "findfail=A700, comment",
         {.comment = "the database is down", .findFailure = 0xa700},
         "the server is out of resources (0xA700: the database is down)"},
        {task, "noimagelevel=A900", {.imageLevel = 0xa900}, all},
        {task, "noimagelevel=C000", {.imageLevel = 0xc000}, all},
        {task,
         "noimagelevel=A900, without numbers",
         {.countsObjects = false, .imageLevel = 0xa900},
         all},
        {task, "noimagelevel=A900, by C-MOVE", {.imageLevel = 0xa900}, all, movesOnly},
        {task, "noimagelevel=C000, by C-MOVE", {.imageLevel = 0xc000}, all, movesOnly},
        {task, "noimagelevel=A900, noget", {.imageLevel = 0xa900, .offersGet = false}, all},
        {task,
         "noimagelevel=A900, noget, nomove",
         {.imageLevel = 0xa900, .offersGet = false, .offersMove = false},
         "the server offers neither C-GET nor C-MOVE"},
        {task, "noserieslevel=A900", {.seriesLevel = 0xa900}, all},
        {task, "noserieslevel=C000", {.seriesLevel = 0xc000}, all},
        {task,
         "noserieslevel=A900, without numbers",
         {.countsObjects = false, .seriesLevel = 0xa900},
         all},
        {task, "noserieslevel, noimagelevel", {.seriesLevel = 0xa900, .imageLevel = 0xa900}, all},
        {task, "noserieslevel=A900, by C-MOVE", {.seriesLevel = 0xa900}, all, movesOnly},
        {task, "noserieslevel=C000, by C-MOVE", {.seriesLevel = 0xc000}, all, movesOnly},
    };
}

// Of connections that break.
std::vector<Row> retrievingWithHarm() {
    constexpr Task task = Task::retrieve;
    constexpr const char *all = "8 of 8";
    return {
        // These take longest.
        {task,
         "stall=6, for good",
         {.harm = Harm::stall, .harmAt = 6, .isForGood = true},
         "5 of 8 incomplete: the server has sent nothing for 1 s",
         isImpatient},
        {task,
         "close=6, for good",
         {.harm = Harm::close, .harmAt = 6, .isForGood = true},
         "5 of 8 incomplete: the other side closed the connection"},
        // Connections that wait for their turn end as well.
        {task,
         "close=30, for good, with 64 objects",
         {.objects = 64, .harm = Harm::close, .harmAt = 30, .isForGood = true},
         "* of 64 incomplete: the other side closed the connection"},
        {task, "stall=3", {.harm = Harm::stall}, all, isImpatient},
        {task, "stall=3, by C-MOVE", {.offersGet = false, .harm = Harm::stall}, all, isImpatient},
        {task, "abort=3", {.harm = Harm::abort}, all},
        {task, "close=3", {.harm = Harm::close}, all},
        {task, "close=3, by C-MOVE", {.offersGet = false, .harm = Harm::close}, all},
        {task, "close=3, changed", {.harm = Harm::close, .isChanging = true}, all},
        {task, "rst=3", {.harm = Harm::reset}, all},
        {task, "halfclose=3", {.harm = Harm::halfClose}, all},
        {task, "release=3", {.harm = Harm::release}, all},
        {task, "strange=3", {.harm = Harm::strange}, all},
    };
}

std::vector<Row> retrieving() {
    constexpr Task task = Task::retrieve;
    constexpr const char *all = "8 of 8";
    return {
        {task, "noget", {.offersGet = false}, all},
        {task, "nomove", {.offersMove = false}, all},
        {task,
         "noget, nomove",
         {.offersGet = false, .offersMove = false},
         "0 of 8 incomplete: the server offers neither C-GET nor C-MOVE"},
        {task, "implicitonly", {.onlySyntax = uid::implicitLittle}, all},
        {task, "implicitonly, noget", {.onlySyntax = uid::implicitLittle, .offersGet = false}, all},
        {task, "explicitonly", {.onlySyntax = uid::explicitLittle}, all},
        {task, "explicitonly, noget", {.onlySyntax = uid::explicitLittle, .offersGet = false}, all},
        // It can send them on connections of its own.
        {task, "norole", {.negotiation = {.grantsRoles = false}}, all},
        {task,
         "norole, nomove",
         {.negotiation = {.grantsRoles = false}, .offersMove = false},
         "0 of 8 incomplete: the server *"},
        {task, "failthird", {.unsendable = {2, 5}}, "6 of 8 incomplete: the server *"},
        {task,
         "failthird, noget",
         {.offersGet = false, .unsendable = {2, 5}},
         "6 of 8 incomplete: the server could not send it"},
        // What is asked for again is not the third.
        {task, "failthird, of each request", {.failsEachThird = true}, all},
        {task,
         "onlyct",
         {.captures = 1, .onlyClasses = std::vector{uid::ct}},
         "7 of 8 incomplete: the server *"},
        {task,
         "getstatus=A702, comment",
         {.comment = "the archive is offline", .getStatus = 0xa702},
         "0 of 8 incomplete: the server does not have enough resources to send the objects"
         " (0xA702: the archive is offline)"},
        {task,
         "getstatus=A702, noget",
         {.offersGet = false, .getStatus = 0xa702},
         "0 of 8 incomplete: the server does not have enough resources to send the objects "
         "(0xA702)"},
        {task,
         "getstatus=C000",
         {.getStatus = 0xc000},
         "0 of 8 incomplete: the server cannot process the request (0xC000)"},
        {task,
         "getstatus=0110",
         {.getStatus = 0x0110},
         "0 of 8 incomplete: the server failed to process the request (0x0110)"},
        {task, "getstatus=FE00", {.getStatus = 0xfe00}, "0 of 8 incomplete: *0xFE00*"},
        {task,
         "getstatus=B000",
         {.getStatus = 0xb000},
         "0 of 8 incomplete: the server did not send it, and gave no reason"},
        {task,
         "getstatus=0000",
         {.getStatus = 0x0000},
         "0 of 8 incomplete: the server did not send it, and gave no reason"},
        {task,
         "movefrom",
         {.offersGet = false, .sendsFrom = "127.0.0.2"},
         "0 of 8 incomplete: a sender at 127.0.0.2 was refused*"},
        {task,
         "movefrom, entered",
         {.offersGet = false, .sendsFrom = "127.0.0.2"},
         all,
         knowsTheOtherHost},
        {task,
         "destfail",
         {.offersGet = false, .knowsDestination = false},
         "0 of 8 incomplete: the server does not know where to send; register*(0xA801)"},
        {task, "changed", {.isChanging = true}, all},
        {task, "extra", {.sendsExtra = true}, all},
        {task, "extra, noget", {.offersGet = false, .sendsExtra = true}, all},
        {task,
         "extra, changed, of a series",
         {.imageLevel = 0xa900, .isChanging = true, .sendsExtra = true},
         all},
        {task, "maxassoc=2, noget", {.maxAssociations = 2, .offersGet = false}, all},
        {task, "maxassoc=2, of 24", {.objects = 24, .maxAssociations = 2}, "24 of 24"},
        {task, "maxassoc=1, of 24", {.objects = 24, .maxAssociations = 1}, "24 of 24"},
        {task, "bind, noget", {.address = "127.0.0.2", .offersGet = false}, all},
    };
}

std::vector<Row> storing() {
    constexpr Task task = Task::store;
    constexpr const char *all = "8 sent";
    constexpr const char *refusesKind =
        "the server does not support this kind of object or service";
    static const std::string noClass = std::string("0 sent: ") + refusesKind,
                             onlyCt = std::string("7 sent: ") + refusesKind;
    return {
        {task,
         "store=B000",
         {.storeStatus = 0xb000},
         "8 sent, 8 changed: stored, but the server changed or left out attributes (0xB000)"},
        {task,
         "store=B006",
         {.storeStatus = 0xb006},
         "8 sent, 8 changed: stored, but the server changed or left out attributes (0xB006)"},
        {task,
         "store=B007",
         {.storeStatus = 0xb007},
         "8 sent, 8 changed: stored, but the server changed or left out attributes (0xB007)"},
        {task,
         "store=A700",
         {.storeStatus = 0xa700},
         "0 sent: the server is out of resources (0xA700)"},
        {task,
         "store=A700, comment",
         {.comment = "the disk is full", .storeStatus = 0xa700},
         "0 sent: the server is out of resources (0xA700: the disk is full)"},
        {task,
         "store=0110",
         {.storeStatus = 0x0110},
         "0 sent: the server failed to process the request (0x0110)"},
        {task,
         "storefailthird=A700",
         {.everyThirdStoreStatus = 0xa700},
         "6 sent: the server is out of resources (0xA700)"},
        {task, "noclass", {.onlyClasses = std::vector<std::string>{}}, noClass.c_str()},
        {task, "onlyct", {.captures = 1, .onlyClasses = std::vector{uid::ct}}, onlyCt.c_str()},
        {task, "as in the file", {.object = addWhatEncodersChange}, all},
        {task,
         "as in the file, pdu=4096",
         {.negotiation = {.pduBytes = 4096}, .object = addWhatEncodersChange},
         all},
        {task, "as in the file, implicit", {.object = addWhatEncodersChange}, all, {}, true},
        // Every program can read it (PS3.5, 10.1), and no value changes.
        {task, "implicitonly", {.onlySyntax = uid::implicitLittle}, "8 sent, 8 converted"},
        {task, "implicitonly, implicit", {.onlySyntax = uid::implicitLittle}, all, {}, true},
        {task, "explicitonly", {.onlySyntax = uid::explicitLittle}, all},
        {task,
         "explicitonly, implicit",
         {.onlySyntax = uid::explicitLittle},
         "8 sent, 8 converted",
         {},
         true},
    };
}

std::vector<Row> echoing() {
    constexpr Task task = Task::echo;
    return {
        {task,
         "noget, nomove",
         {.offersGet = false, .offersMove = false},
         "answers: C-FIND, C-STORE"},
        {task,
         "echo=0110",
         {.echoStatus = 0x0110},
         "the server failed to process the request (0x0110)"},
        {task,
         "echo=A700, comment",
         {.comment = "maintenance", .echoStatus = 0xa700},
         "the server is out of resources (0xA700: maintenance)"},
    };
}

std::vector<Row> joined(const std::vector<std::vector<Row>> &tables) {
    std::vector<Row> rows;
    for (const auto &table : tables)
        rows.insert(rows.end(), table.begin(), table.end());
    return rows;
}

class PacsOddScp : public PacsScripted {
protected:
    void expectAll(const std::vector<Row> &rows) const {
        expectOutcomes(rows, [this](const Row &row, std::size_t number) {
            return outcomeOf(row, m_folder / std::to_string(number));
        });
    }

private:
    static std::string outcomeOf(const Row &row, const fs::path &folder) {
        const OddScp scp(row.quirks);
        archive::Server server = scp.server();
        server.limit = 0;
        if (row.entered)
            row.entered(server);
        // The slowest row waits about ten seconds before it gives up.
        return outcomeWithin(std::chrono::seconds(25), [&](const task::Progress &progress) {
            switch (row.task) {
            case Task::echo:
                return echoed(server, progress);
            case Task::search:
                return searched(server, progress);
            case Task::retrieve:
                return retrieved(server, scp.study(), folder, progress,
                                 {.port = scp.destinationPort});
            case Task::store:
                return stored(scp, server, row, folder, progress);
            }
            return std::string();
        });
    }
    static std::string echoed(const archive::Server &server, const task::Progress &progress) {
        network::Link link({server.peer, network::Purpose::echo}, progress);
        std::string offers;
        link.echo(progress, [&](network::Step step, const std::string &found) {
            if (step == network::Step::service)
                offers = found;
        });
        return "answers: " + offers;
    }
    static std::string stored(const OddScp &scp, const archive::Server &server, const Row &row,
                              const fs::path &folder, const task::Progress &progress) {
        fs::create_directories(folder);
        std::vector<fs::path> files;
        for (int n = 0; n < row.quirks.objects; ++n) {
            files.push_back(folder / (std::to_string(n) + ".dcm"));
            scp.object(n).write(files.back(), row.hasImplicitFiles
                                                  ? DicomWriter::Form{.syntax = uid::implicitLittle,
                                                                      .isImplicit = true}
                                                  : DicomWriter::Form());
        }
        std::string text = sent(server, files, progress);
        const auto stored = scp.stored();
        const auto converted = std::count_if(files.begin(), files.end(), [&](const fs::path &file) {
            const auto at = stored.find(scp.instance(std::stoi(file.stem())));
            return at != stored.end() && at->second != dataSetOf(file);
        });
        if (converted > 0)
            text += ", " + std::to_string(converted) + " converted";
        return text;
    }
};

} // namespace

TEST_F(PacsOddScp, EachQuirkOfSearchingHasItsOutcome) {
    expectAll(joined({searching(), associating(Task::search, "19 studies")}));
}

TEST_F(PacsOddScp, EachQuirkOfRetrievingHasItsOutcome) {
    expectAll(joined({retrievingWithHarm(), retrieving(), retrievingWhatIsListed(),
                      associating(Task::retrieve, "8 of 8")}));
}

TEST_F(PacsOddScp, EachQuirkOfStoringHasItsOutcome) {
    expectAll(joined({storing(), associating(Task::store, "8 sent"), echoing(),
                      associating(Task::echo, "answers: C-FIND, C-GET, C-MOVE, C-STORE")}));
}

} // namespace pellucid
