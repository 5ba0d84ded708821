// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/multipart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/network/process/dicom_json.h"
#include "core/network/process/file_start.h"
#include "core/network/process/statuses.h"
#include "core/task/error.h"
#include "tests/support/dicom_writer.h"

namespace pellucid::network::process {

namespace {

struct Parts {
    std::vector<std::string> complete;
    bool isComplete = false;
};

// Reads a body in pieces of every size.
Parts partsOf(const std::string &type, const std::string &body, std::size_t piece) {
    Parts parts;
    std::string current;
    MultipartReader reader(type, {[&] { current.clear(); },
                                  [&](std::span<const std::byte> bytes) {
                                      current.append(reinterpret_cast<const char *>(bytes.data()),
                                                     bytes.size());
                                  },
                                  [&] { parts.complete.push_back(current); }});
    for (std::size_t at = 0; at < body.size(); at += piece)
        reader.add(std::as_bytes(std::span(body)).subspan(at, std::min(piece, body.size() - at)));
    parts.isComplete = reader.finish();
    return parts;
}

} // namespace

TEST(Multipart, PartsAreFoundInPiecesOfAnySize) {
    const std::string first("a\r\n--b\0c\r\nd", 11), second = "--XY is no delimiter";
    const std::string body = "preamble\r\n--XYZ\r\nContent-Type: application/dicom\r\n\r\n" +
                             first + "\r\n--XYZ\r\n\r\n" + second + "\r\n--XYZ--\r\nepilogue";
    for (const char *const type :
         {"multipart/related; type=\"application/dicom\"; boundary=XYZ",
          "multipart/related;boundary=\"XYZ\"", "Multipart/Related; BOUNDARY = XYZ; start=1"})
        for (std::size_t piece = 1; piece <= body.size(); ++piece) {
            const Parts parts = partsOf(type, body, piece);
            EXPECT_TRUE(parts.isComplete);
            ASSERT_EQ(parts.complete, (std::vector{first, second})) << type << " " << piece;
        }
}

TEST(Multipart, OddServersAreUnderstood) {
    // Line feeds alone.
    EXPECT_EQ(partsOf("multipart/related; boundary=b", "--b\n\nx\n--b--", 3).complete,
              std::vector<std::string>{"x"});
    // A single part that is not wrapped.
    EXPECT_EQ(partsOf("application/dicom", "DICM", 2).complete, std::vector<std::string>{"DICM"});
    // Nothing.
    EXPECT_TRUE(partsOf("multipart/related; boundary=b", "--b--\r\n", 5).complete.empty());
}

// A part whose end is missing is not a part.
TEST(Multipart, ATruncatedEndIsNoticed) {
    const std::string body = "--b\r\n\r\none\r\n--b\r\n\r\ntwo\r\n--b--";
    for (std::size_t length = 8; length < body.size() - 2; ++length) {
        const Parts parts = partsOf("multipart/related; boundary=b", body.substr(0, length), 4);
        EXPECT_FALSE(parts.isComplete && length > 8) << length;
        for (const std::string &part : parts.complete)
            EXPECT_TRUE(part == "one" || part == "two") << part;
    }
}

TEST(DicomJson, AnswersAreRead) {
    const auto answers = readDicomJson(
        R"([{"00100010": {"vr": "PN", "Value": [{"Alphabetic": "M\u00fcller^Eva"}]},
             "00080061": {"vr": "CS", "Value": ["CT", "SR"]},
             "00201208": {"vr": "IS", "Value": [512]}, "00080050": {"vr": "SH"}}])");
    ASSERT_EQ(answers.size(), 1U);
    EXPECT_EQ(answers[0].at(network::tag::patientName), "M\xC3\xBCller^Eva");
    EXPECT_EQ(answers[0].at(network::tag::modalitiesInStudy), "CT\\SR");
    EXPECT_EQ(answers[0].at(network::tag::instancesInStudy), "512");
    EXPECT_FALSE(answers[0].contains(network::tag::accessionNumber));
    EXPECT_TRUE(readDicomJson(" ").empty());
    EXPECT_TRUE(readDicomJson("[]").empty());
    for (const char *const bad : {"<html>", "{}", "[1]", "[", "[[]]"})
        EXPECT_THROW(readDicomJson(bad), task::Error) << bad;
}

TEST(DicomJson, StoredAndFailedObjectsAreToldApart) {
    const auto answer = readStoreAnswer(
        R"({"00081199": {"vr": "SQ", "Value": [{"00081155": {"vr": "UI", "Value": ["1.2"]},
                                                "00081196": {"vr": "US", "Value": [45056]}}]},
            "00081198": {"vr": "SQ", "Value": [{"00081155": {"vr": "UI", "Value": ["1.3"]},
                                                "00081197": {"vr": "US", "Value": [42752]}}]}})");
    ASSERT_EQ(answer.stored.size(), 1U);
    EXPECT_EQ(answer.stored[0].uid, "1.2");
    EXPECT_EQ(changeReason(std::uint16_t(answer.stored[0].reason)).english(),
              "stored, but the server changed or left out attributes (0xB000)");
    ASSERT_EQ(answer.failed.size(), 1U);
    EXPECT_EQ(answer.failed[0].uid, "1.3");
    EXPECT_EQ(statusReason(std::uint16_t(answer.failed[0].reason), "disk").english(),
              "the server is out of resources (0xA700: disk)");
    EXPECT_THROW(readStoreAnswer("ok"), task::Error);
}

TEST(FileStart, TheMetaHeaderNamesTheObject) {
    const auto element = [](int number, const char *vr, std::string value) {
        if (value.size() % 2 != 0)
            value += '\0';
        std::string text{'\x02', '\0', char(number), '\0', vr[0], vr[1], char(value.size()), '\0'};
        return text + value;
    };
    const std::string file = std::string(128, '\0') + "DICM" + element(2, "UI", "1.2.3") +
                             element(3, "UI", "1.2.3.4") +
                             element(0x10, "UI", "1.2.840.10008.1.2.1") +
                             std::string("\x08\0\x05\0CS\x0a\0ISO_IR 100", 18);
    const auto bytes = std::as_bytes(std::span(file));
    for (std::size_t length = 0; length < file.size() - 8; ++length)
        EXPECT_FALSE(readFileStart(bytes.first(length))) << length;
    EXPECT_FALSE(readFileStart(bytes)); // the data set may name another object
    const auto start = readFileStart(bytes, true);
    ASSERT_TRUE(start);
    const network::Arrival &arrival = start->arrival;
    EXPECT_EQ(arrival.sopClassUid, "1.2.3");
    EXPECT_EQ(arrival.sopInstanceUid, "1.2.3.4");
    EXPECT_EQ(arrival.transferSyntax, "1.2.840.10008.1.2.1");
    const std::string page = std::string(200, '<');
    EXPECT_THROW(readFileStart(std::as_bytes(std::span(page))), task::Error);
}

// De-identification often changes the UIDs of the data set alone.
TEST(FileStart, TheUidsOfTheDataSetCount) {
    for (const test::DicomWriter::Form &form :
         {test::DicomWriter::Form{}, test::DicomWriter::Form{"1.2.840.10008.1.2", true}}) {
        test::DicomWriter w;
        w.put({0x0008, 0x0005}, "CS", std::string("ISO_IR 100"));
        w.put({0x0008, 0x0016}, "UI", std::string("1.2.3"));
        w.put({0x0008, 0x0018}, "UI", std::string("1.2.3.4"));
        w.put({0x0008, 0x0020}, "DA", std::string("20200101"));
        std::string file = w.file(form);
        const std::size_t meta = file.find("1.2.3.4");
        ASSERT_LT(meta, file.rfind("1.2.3.4"));
        file.replace(meta, 7, "9.8.7.6");
        const auto bytes = std::as_bytes(std::span(file));
        const auto start = readFileStart(bytes);
        ASSERT_TRUE(start);
        EXPECT_EQ(file.substr(start->dataSet, 4), std::string("\x08\0\x05\0", 4));
        const network::Arrival &arrival = start->arrival;
        EXPECT_EQ(arrival.sopClassUid, "1.2.3");
        EXPECT_EQ(arrival.sopInstanceUid, "1.2.3.4");
    }
}

// The context of an association says what is sent: a label that is wrong would make it unreadable.
TEST(FileStart, AMislabelledEncodingIsFound) {
    test::DicomWriter w;
    w.put({0x0008, 0x0016}, "UI", std::string("1.2.3"));
    w.put({0x0008, 0x0018}, "UI", std::string("1.2.3.4"));
    w.put({0x0008, 0x0020}, "DA", std::string("20200101"));
    for (const bool isImplicit : {false, true}) {
        const std::string file =
            w.file({.syntax = "1.2.840.10008.1.2.1", .isImplicit = isImplicit});
        const FileStart start = startOf(std::as_bytes(std::span(file)));
        EXPECT_EQ(start.arrival.transferSyntax,
                  isImplicit ? "1.2.840.10008.1.2" : "1.2.840.10008.1.2.1");
        EXPECT_EQ(start.arrival.sopInstanceUid, "1.2.3.4");
    }
}

} // namespace pellucid::network::process
