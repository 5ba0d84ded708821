// SPDX-License-Identifier: GPL-3.0-or-later
// Names as servers store them, in the character sets of PS3.3, C.12.1.1.2.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "core/archive/search.h"
#include "core/archive/sending.h"
#include "core/archive/server.h"
#include "tests/network/pacs.h"
#include "tests/support/dicom_writer.h"

namespace pellucid {

using namespace test;
namespace tag = network::tag;

namespace {

struct Name {
    std::string sets, written, read;
};

// The examples of PS3.5, H.3, I.2 and J.3, and names of the same kind. Some sets have two terms:
// with and without code extensions.
const std::vector<Name> &names() {
    static const std::vector<Name> all{
        {"", "Adams^John Robert Quincy", "Adams^John Robert Quincy"},
        {"ISO_IR 6", "Adams^John", "Adams^John"},
        {"ISO_IR 100", "Buc^J\xE9r\xF4me", "Buc^J\u00E9r\u00F4me"},
        {"ISO_IR 101", "Wa\xB3\xEAsa^Lech", "Wa\u0142\u0119sa^Lech"},
        {"ISO_IR 109",
         "Bor\xF5^\xA1"
         "a\xBF",
         "Bor\u0121^\u0126a\u017C"},
        {"ISO_IR 110", "K\xE0rlis^\xABirts", "K\u0101rlis^\u0122irts"},
        {"ISO_IR 144", "\xBB\xEE\xDA\x63\x65\xDC\xD1\x79\x70\xD3",
         "\u041B\u044E\u043Ace\u043C\u0431yp\u0433"},
        {"ISO_IR 127", "\xE2\xC8\xC7\xE6\xEA^\xE4\xE6\xD2\xC7\xD1",
         "\u0642\u0628\u0627\u0646\u064A^\u0644\u0646\u0632\u0627\u0631"},
        {"ISO_IR 126", "\xC4\xE9\xEF\xED\xF5\xF3\xE9\xEF\xF2",
         "\u0394\u03B9\u03BF\u03BD\u03C5\u03C3\u03B9\u03BF\u03C2"},
        {"ISO_IR 138", "\xF9\xF8\xE5\xEF^\xE3\xE1\xE5\xF8\xE4",
         "\u05E9\u05E8\u05D5\u05DF^\u05D3\u05D1\u05D5\u05E8\u05D4"},
        {"ISO_IR 148",
         "\xC7"
         "avu\xFEo\xF0lu^\xDE"
         "enol",
         "\u00C7avu\u015Fo\u011Flu^\u015Eenol"},
        {"ISO_IR 166", "\xB9\xD2\xC1^\xAA\xD7\xE8\xCD",
         "\u0E19\u0E32\u0E21^\u0E0A\u0E37\u0E48\u0E2D"},
        {"ISO_IR 13", "\xD4\xCF\xC0\xDE^\xC0\xDB\xB3",
         "\uFF94\uFF8F\uFF80\uFF9E^\uFF80\uFF9B\uFF73"},
        {"\\ISO 2022 IR 87",
         "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B=\x1b$B$d$^$@\x1b(B^\x1b$B$?$m$&\x1b(B",
         "Yamada^Tarou=\u5C71\u7530^\u592A\u90CE=\u3084\u307E\u3060^\u305F\u308D\u3046"},
        {"ISO 2022 IR 13\\ISO 2022 IR 87",
         "\xD4\xCF\xC0\xDE^\xC0\xDB\xB3=\x1b$B;3ED\x1b(J^\x1b$BB@O:\x1b(J",
         "\uFF94\uFF8F\uFF80\uFF9E^\uFF80\uFF9B\uFF73=\u5C71\u7530^\u592A\u90CE"},
        // The first character of JIS X 0212 after its symbols.
        {"\\ISO 2022 IR 87\\ISO 2022 IR 159", "Kaji=\x1b$(D0!\x1b(B=\x1b$B$d\x1b(B",
         "Kaji=\u4E02=\u3084"},
        {"\\ISO 2022 IR 149",
         "Hong^Gildong=\x1b$)C\xFB\xF3^\x1b$)C\xD1\xCE\xD4\xD7=\x1b$)C\xC8\xAB^\x1b$)C\xB1\xE6\xB5"
         "\xBF",
         "Hong^Gildong=\u6D2A^\u5409\u6D1E=\uD64D^\uAE38\uB3D9"},
        {"\\ISO 2022 IR 58", "Zhang^XiaoDong=\x1b$)A\xD5\xC5^\x1b$)A\xD0\xA1\xB6\xAB=",
         "Zhang^XiaoDong=\u5F20^\u5C0F\u4E1C="},
        {"GB18030",
         "Wang^XiaoDong=\xCD\xF5^\xD0\xA1\xB6\xAB=", "Wang^XiaoDong=\u738B^\u5C0F\u4E1C="},
        {"GBK", "Wang^XiaoDong=\xCD\xF5^\xD0\xA1\xB6\xAB=", "Wang^XiaoDong=\u738B^\u5C0F\u4E1C="},
        {"ISO_IR 192", "Wang^XiaoDong=\xE7\x8E\x8B^\xE5\xB0\x8F\xE6\x9D\xB1=",
         "Wang^XiaoDong=\u738B^\u5C0F\u6771="}};
    return all;
}

std::string studyOf(std::size_t n) {
    return "1.2.826.0.1.3680043.8.498.77." + std::to_string(n);
}

// A small object of a study of its own. An empty `sets`: it names none.
void writeObject(const fs::path &path, std::size_t n, const std::string &sets,
                 const std::string &name) {
    DicomWriter writer;
    if (!sets.empty())
        writer.put({0x0008, 0x0005}, "CS", sets);
    writer.put({0x0008, 0x0016}, "UI", "1.2.840.10008.5.1.4.1.1.7");
    writer.put({0x0008, 0x0018}, "UI", studyOf(n) + ".1.1");
    writer.put({0x0008, 0x0020}, "DA", "20260101");
    writer.put({0x0008, 0x0060}, "CS", "OT");
    writer.put({0x0010, 0x0010}, "PN", name);
    writer.put({0x0010, 0x0020}, "LO", "ID-" + std::to_string(n));
    writer.put({0x0020, 0x000d}, "UI", studyOf(n));
    writer.put({0x0020, 0x000e}, "UI", studyOf(n) + ".1");
    writer.write(path);
}

// The names that a search finds, by study.
std::map<std::string, std::string> foundAt(const archive::Server &server,
                                           const archive::SearchTerms &terms = {}) {
    std::map<std::string, std::string> found;
    const auto result = archive::search({server}, terms);
    EXPECT_FALSE(result.outcomes.at(0).failure.has_value())
        << result.outcomes.at(0).failure->english();
    for (const archive::FoundEntry &entry : result.entries)
        found[entry.text(tag::studyUid)] = entry.text(tag::patientName);
    return found;
}

} // namespace

// dcmqrscp answers with what is stored, in the set that the object names.
TEST_F(Pacs, NamesOfEveryCharacterSetAreFound) {
    Dcmqrscp dcmqrscp;
    const archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    fs::create_directories(m_folder / "objects");
    for (std::size_t n = 0; n < names().size(); ++n)
        writeObject(m_folder / "objects" / ("object" + std::to_string(n)), n, names()[n].sets,
                    names()[n].written);
    put(server, m_folder / "objects");
    const auto found = foundAt(server);
    EXPECT_EQ(found.size(), names().size());
    for (std::size_t n = 0; n < names().size(); ++n) {
        const auto at = found.find(studyOf(n));
        ASSERT_NE(at, found.end()) << names()[n].sets;
        EXPECT_EQ(at->second, names()[n].read) << names()[n].sets;
    }
}

// Many servers name no set. The set of the server's settings is then that of its answers, and of
// the question.
TEST_F(Pacs, AServerThatNamesNoCharacterSetHasThatOfItsSettings) {
    for (const auto &[set, written, read] :
         {Name{"ISO_IR 100",
               "M\xFC"
               "ller^J\xF6rg",
               "M\u00FCller^J\u00F6rg"},
          Name{"ISO_IR 144", "\xBB\xEE\xDA^\xDC", "\u041B\u044E\u043A^\u043C"},
          Name{"GB18030", "Wang=\xCD\xF5", "Wang=\u738B"},
          Name{"ISO_IR 192", "Wang=\xE7\x8E\x8B", "Wang=\u738B"}}) {
        SCOPED_TRACE(set);
        Dcmqrscp dcmqrscp;
        archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
        server.peer.characterSet = set;
        const fs::path folder = m_folder / ("of " + set);
        fs::create_directories(folder);
        writeObject(folder / "unnamed", 0, "", written);
        // An answer that names its set is read by that one.
        writeObject(folder / "named", 1, "ISO_IR 101", "Wa\xB3\xEAsa^Lech");
        put(server, folder);
        const auto found = foundAt(server);
        ASSERT_EQ(found.size(), 2U);
        EXPECT_EQ(found.at(studyOf(0)), read);
        EXPECT_EQ(found.at(studyOf(1)), "Wa\u0142\u0119sa^Lech");
    }
}

// A search text with letters beyond ASCII is sent in the server's set, or in UTF-8, which the
// question names: a server that converts finds the name in any set.
TEST_F(Pacs, NamesBeyondAsciiAreSearchedFor) {
    Dcmqrscp dcmqrscp;
    archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    fs::create_directories(m_folder / "objects");
    writeObject(m_folder / "objects" / "a", 0, "ISO_IR 100",
                "M\xFC"
                "ller^J\xF6rg");
    writeObject(m_folder / "objects" / "b", 1, "ISO_IR 192", "M\u00FCller^Eva");
    writeObject(m_folder / "objects" / "c", 2, "ISO_IR 101", "Wa\xB3\xEAsa^Lech");
    put(server, m_folder / "objects");
    for (const char *const set : {"", "ISO_IR 192", "ISO_IR 100"}) {
        server.peer.characterSet = set;
        const auto found = foundAt(server, {.patientName = "M\u00FCller*"});
        EXPECT_EQ(found, (std::map<std::string, std::string>{{studyOf(0), "M\u00FCller^J\u00F6rg"},
                                                             {studyOf(1), "M\u00FCller^Eva"}}))
            << set;
    }
    server.peer.characterSet = "";
    EXPECT_EQ(foundAt(server, {.patientName = "Wa\u0142*"}).size(), 1U);
    // A letter that the server's set lacks: the question still comes, in another set.
    server.peer.characterSet = "ISO_IR 100";
    EXPECT_EQ(foundAt(server, {.patientName = "Wa\u0142*"}).size(), 1U);
}

} // namespace pellucid
