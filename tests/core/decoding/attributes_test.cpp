// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/message.h"
#include "core/task/error.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

using decoding::Attribute;
using decoding::AttributeList;
using decoding::Decoder;

test::DicomWriter sample() {
    test::SeriesKnobs knobs;
    test::DicomWriter w = test::sliceOf(knobs, 0);
    w.put({0x0008, 0x0005}, "CS", std::string("ISO_IR 100"));
    w.put({0x0010, 0x0010}, "PN", std::string("M\xFCller^Eva"));
    w.put({0x0009, 0x0010}, "LO", std::string("ACME 1"));
    w.put({0x0009, 0x1002}, "LO", std::string("secret\nsauce"));
    test::DicomWriter inner, item;
    inner.put({0x0008, 0x0100}, "SH", std::string("T-1"));
    item.put({0x0008, 0x0104}, "LO", std::string("Meaning"));
    item.putSequence({0x0040, 0xA168}, {inner});
    w.putSequence({0x0008, 0x2218}, {item, inner});
    return w;
}

const Attribute *find(const AttributeList &list, std::uint32_t tag) {
    const auto at = std::find_if(list.attributes.begin(), list.attributes.end(),
                                 [&](const Attribute &a) { return a.tag == tag; });
    return at == list.attributes.end() ? nullptr : &*at;
}

TEST(Attributes, AreListedInTheOrderOfTheFileWithTheirSequences) {
    const test::TemporaryFolder folder;
    sample().write(folder / "a.dcm");
    const AttributeList list = Decoder::shared().attributes(folder / "a.dcm");
    EXPECT_TRUE(list.isComplete);
    EXPECT_EQ(list.attributes.front().tag >> 16, 2U); // the meta header comes first
    const Attribute *const name = find(list, 0x00100010);
    ASSERT_NE(name, nullptr);
    EXPECT_EQ(*name, (Attribute{0, 0x00100010, "PN", "PatientName", "M\xC3\xBCller^Eva"}));
    EXPECT_EQ(find(list, 0x00280010)->value, "8");
    EXPECT_EQ(find(list, 0x7FE00010)->value, "160 bytes");
    EXPECT_EQ(find(list, 0x00091002)->name, "Private, ACME 1");
    EXPECT_EQ(find(list, 0x00091002)->value, "secret sauce");
    // A sequence, its first item, the item's attributes, its second item.
    const Attribute *const sequence = find(list, 0x00082218);
    ASSERT_NE(sequence, nullptr);
    const auto at = std::size_t(sequence - list.attributes.data());
    EXPECT_EQ(sequence->value, "2 items");
    const std::vector<std::pair<int, std::string>> expected{
        {1, "1"}, {2, "CodeMeaning"}, {2, "ConceptCodeSequence"}, {3, "1"}, {4, "CodeValue"},
        {1, "2"}, {2, "CodeValue"}};
    for (std::size_t n = 0; n < expected.size(); ++n) {
        EXPECT_EQ(list.attributes[at + 1 + n].depth, expected[n].first) << n;
        EXPECT_EQ(list.attributes[at + 1 + n].name, expected[n].second) << n;
    }
    EXPECT_EQ(tagText(*sequence), "(0008,2218)");
    EXPECT_EQ(tagText(list.attributes[at + 1]), "");
}

TEST(Attributes, OfADamagedFileAreThoseBeforeTheDamage) {
    const test::TemporaryFolder folder;
    const std::string whole = sample().file({});
    test::writeText(folder / "cut.dcm", whole.substr(0, whole.size() / 2));
    const AttributeList list = Decoder::shared().attributes(folder / "cut.dcm");
    EXPECT_NE(find(list, 0x00080060), nullptr);
    test::writeText(folder / "text.dcm", "no DICOM at all");
    EXPECT_THROW(Decoder::shared().attributes(folder / "text.dcm"), task::Error);
}

TEST(Attributes, AMessageIsNotBelieved) {
    const auto bytes = [](const std::string &text) { return std::as_bytes(std::span(text)); };
    const AttributeList good{
        {{0, 1, "SQ", "a\nb", "\x1B[2J"}, {1, 0, "", "1", ""}, {2, 5, "LO", "c", "d"}}, false};
    const std::string packed = decoding::pack(good);
    const AttributeList got = decoding::unpack<decoding::AttributeList>(bytes(packed));
    EXPECT_EQ(got.attributes[0].name, "a b");
    EXPECT_EQ(got.attributes[0].value, " [2J");
    EXPECT_EQ(got.attributes[2], good.attributes[2]);
    EXPECT_FALSE(got.isComplete);
    for (const int depth : {-1, 3, 1000}) {
        AttributeList bad = good;
        bad.attributes[2].depth = depth;
        const std::string text = decoding::pack(bad);
        EXPECT_THROW(decoding::unpack<decoding::AttributeList>(bytes(text)), task::Error) << depth;
    }
    AttributeList many{std::vector<Attribute>(decoding::maxAttributes + 1), true};
    const std::string text = decoding::pack(many);
    EXPECT_THROW(decoding::unpack<decoding::AttributeList>(bytes(text)), task::Error);
}

} // namespace

} // namespace pellucid
