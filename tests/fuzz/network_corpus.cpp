// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/network_corpus.h"

#include <map>
#include <optional>
#include <vector>

#include "core/confined/packing.h"
#include "core/network/client/message.h"
#include "core/network/client/reasons.h"
#include "core/task/reason.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"

namespace pellucid::fuzz {

namespace {

namespace fs = std::filesystem;
using network::Message;
using test::writeText;

void writePackedValues(const fs::path &folder) {
    writeText(folder / "values",
              confined::packed(std::map<std::string, std::vector<std::optional<double>>>{
                  {"a", {1.0, {}, -2.5}}, {"", {}}}));
    writeText(folder / "reason",
              task::because::serverStatus(task::because::serverIsBusy, "0xA700").encoded());
}

void writeNetworkMessages(const fs::path &folder) {
    network::Connection connection;
    connection.peer.host = "host";
    connection.peer.secret = "secret";
    connection.peer.allowsInsecureLogin = true;
    connection.peer.characterSet = "ISO_IR 100";
    connection.sopClasses = {"1.2.3", "1.2.4"};
    connection.transferSyntaxes = {"1.2.840.10008.1.2"};
    connection.encodings = {{"1.2.3", "1.2.840.10008.1.2"}};
    writeText(folder / "connection", network::pack(connection));
    writeText(folder / "acceptance",
              network::pack(network::Acceptance{
                  "US", {"A", "B"}, {"host", "127.0.0.1"}, true, "a", "b", "c", "d", 1.5}));
    writeText(folder / "query",
              network::pack(
                  network::Query{network::Level::series, {{network::tag::patientName, "A*"}}, 3}));
    writeText(folder / "query_end", network::pack(network::QueryEnd{true, false, {"slow today"}}));
    writeText(folder / "retrieval",
              network::pack(
                  network::Retrieval{network::Level::image, "1.2", "1.3", {"1.4", "1.5"}, "US"}));
    writeText(folder / "retrieval_end",
              network::pack(network::RetrievalEnd{
                  3, 2, 1, {"1.2"}, task::Reason(task::because::serverIsBusy).encoded()}));
    writeText(folder / "arrival",
              network::pack(network::Arrival{"1.2", "1.2.3", "1.2.840.10008.1.2", "SENDER"}));
    writeText(folder / "attributes",
              network::pack(network::Attributes{{network::tag::patientName, "Fuzz^Jane"},
                                                {network::tag::studyUid, "1.2.3"}}));
    writeText(folder / "uids", network::pack(std::vector<std::string>{"1.2", "1.3"}));
    writeText(folder / "reason",
              task::because::serverStatus(task::because::serverIsBusy, "0xA700").encoded());
}

// Lengths around those that the target takes, with a descriptor and without.
void writePackets(const fs::path &folder) {
    for (const std::size_t length : {1, 15, 16, 17, 271, 272, 273, 5000})
        for (const char first : {'\0', '\1', '\2', '\3'})
            writeText(folder / (std::to_string(length) + "_" + std::to_string(int(first))),
                      first + std::string(length - 1, 'x'));
}

void writeAnswers(const fs::path &folder) {
    const auto answer = [](Message::Kind kind, int code) {
        return std::string{char(kind), char(code)};
    };
    // What the target reads first is not an answer; an odd code comes with a file.
    const std::string before = answer(Message::Kind::echo, 0);
    writeText(folder / "kept",
              before + answer(Message::Kind::file, 1) + answer(Message::Kind::kept, 0));
    writeText(folder / "refused", before + answer(Message::Kind::refused, 4));
    writeText(folder / "refused_at_the_end",
              before + answer(Message::Kind::file, 1) + answer(Message::Kind::refused, 7));
    writeText(folder / "cancelled", before + answer(Message::Kind::cancel, 0));
    writeText(folder / "cancelled_while_it_arrives",
              before + answer(Message::Kind::file, 1) + answer(Message::Kind::cancel, 0));
    writeText(folder / "without_the_file", before + answer(Message::Kind::file, 0));
    writeText(folder / "nonsense", before + answer(Message::Kind::file, 1) + "x");
}

void writeMultipart(const fs::path &folder) {
    const std::string parts =
        "preamble\r\n--b\r\nContent-Type: application/dicom\r\n\r\none\r\n--b\r\n"
        "\r\ntwo--b\r\n--b--\r\nepilogue";
    writeText(folder / "parts",
              "multipart/related; type=\"application/dicom\"; boundary=b\n" + parts);
    writeText(folder / "quoted", "Multipart/Related;BOUNDARY = \"b\"\n" + parts);
    writeText(folder / "line_feeds", "multipart/related; boundary=b\n--b\n\nx\n--b--");
    writeText(folder / "single", "application/dicom\nDICM");
    writeText(folder / "truncated",
              "multipart/related; boundary=b\n--b\r\n\r\none\r\n--b\r\n\r\ntw");
    writeText(folder / "none", "multipart/related; boundary=b\n--b--\r\n");
}

void writeDicomJson(const fs::path &folder) {
    writeText(folder / "studies",
              R"([{"00100010": {"vr": "PN", "Value": [{"Alphabetic": "M\u00fcller^Eva"}]},
                   "00080061": {"vr": "CS", "Value": ["CT", "SR", null]},
                   "00201208": {"vr": "IS", "Value": [512]}, "00080050": {"vr": "SH"},
                   "00081140": {"vr": "SQ", "Value": [{"00081155": {"vr": "UI", "Value": ["1"]}}]},
                   "00280030": {"vr": "DS", "Value": [0.5, 1e300]}}, {}])");
    writeText(folder / "stored",
              R"({"00081199": {"vr": "SQ", "Value": [{"00081155": {"vr": "UI", "Value": ["1.2"]}}]},
                  "00081198": {"vr": "SQ", "Value": [{"00081155": {"vr": "UI", "Value": ["1.3"]},
                                                      "00081197": {"vr": "US", "Value": [42752]}}]}})");
    writeText(folder / "nested", std::string(200, '[') + std::string(200, ']'));
    // Copying it would use more stack than there is.
    writeText(folder / "nested_deeply", std::string(100'000, '[') + std::string(100'000, ']'));
}

void writeFileStarts(const fs::path &folder) {
    test::DicomWriter writer;
    writer.put({0x0008, 0x0016}, "UI", "1.2.840.10008.5.1.4.1.1.7");
    writer.put({0x0008, 0x0018}, "UI", "1.2.3.4");
    writer.put({0x0010, 0x0010}, "PN", "Fuzz^Jane");
    writer.write(folder / "file");
    writer.write(folder / "implicit", {.syntax = "1.2.840.10008.1.2", .isImplicit = true});
}

} // namespace

void writeNetworkCorpus(const std::string &target, const fs::path &folder) {
    if (target == "packing")
        writePackedValues(folder);
    else if (target == "network_message")
        writeNetworkMessages(folder);
    else if (target == "packet")
        writePackets(folder);
    else if (target == "control")
        writeAnswers(folder);
    else if (target == "multipart")
        writeMultipart(folder);
    else if (target == "dicom_json")
        writeDicomJson(folder);
    else if (target == "file_start")
        writeFileStarts(folder);
}

} // namespace pellucid::fuzz
