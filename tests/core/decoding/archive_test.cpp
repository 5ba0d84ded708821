// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/unpack_archive.h"

#include <fstream>
#include <functional>
#include <string>

#include <archive.h>
#include <archive_entry.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/process/reasons.h"
#include "core/task/error.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::decoding {

namespace fs = std::filesystem;

namespace {

class Archive : public testing::Test {
protected:
    // Writes a ZIP archive with the files that `fill` adds.
    fs::path make(const std::function<void(struct archive *)> &fill, const char *options = nullptr,
                  const char *password = nullptr) {
        const fs::path path = m_folder / "test.zip";
        struct archive *writer = archive_write_new();
        archive_write_set_format_zip(writer);
        if (options != nullptr)
            archive_write_set_options(writer, options);
        if (password != nullptr)
            archive_write_set_passphrase(writer, password);
        EXPECT_EQ(archive_write_open_filename(writer, path.string().c_str()), ARCHIVE_OK);
        fill(writer);
        archive_write_close(writer);
        archive_write_free(writer);
        return path;
    }

    static void add(struct archive *writer, const char *name, const std::string &text,
                    unsigned type = AE_IFREG) {
        struct archive_entry *entry = archive_entry_new();
        archive_entry_set_pathname(entry, name);
        archive_entry_set_filetype(entry, type);
        archive_entry_set_perm(entry, 0644);
        if (type == AE_IFLNK)
            archive_entry_set_symlink(entry, text.c_str());
        else
            archive_entry_set_size(entry, la_int64_t(text.size()));
        archive_write_header(writer, entry);
        if (type == AE_IFREG)
            archive_write_data(writer, text.data(), text.size());
        archive_entry_free(entry);
    }

    std::string refusal(const fs::path &archive, const UnpackLimits &limits = {}) {
        try {
            unpackArchive(Decoder::shared(), archive, m_out.path(), {}, limits);
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::unusable);
            EXPECT_EQ(error.path(), archive);
            return error.reason().english();
        }
        return "unpacked";
    }

    bool isOutEmpty() const { return fs::is_empty(m_out.path()); }
    std::string read(const char *name) const {
        std::ifstream in(m_out / name);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    test::TemporaryFolder m_folder, m_out;
};

} // namespace

TEST_F(Archive, unpacksFilesUnderTheirNames) {
    const fs::path path = make([](auto *w) {
        add(w, "study/one.dcm", "first");
        add(w, "study/series/two", "second");
    });
    EXPECT_TRUE(isArchive(path));
    unpackArchive(Decoder::shared(), path, m_out.path());
    EXPECT_EQ(read("study/one.dcm"), "first");
    EXPECT_EQ(read("study/series/two"), "second");
}

TEST_F(Archive, noNameLeadsOutAndNoLinkIsMade) {
    const fs::path path = make([](auto *w) {
        add(w, "../../evil", "up");
        add(w, "/etc/evil", "root");
        add(w, "a/../../../b", "winding");
        add(w, "link", "/etc/passwd", AE_IFLNK);
        add(w, "same", "1");
        add(w, "./same", "2");
    });
    EXPECT_EQ(unpackArchive(Decoder::shared(), path, m_out.path()),
              (std::vector<LeftOutFile>{{"link", task::because::isALinkInAnArchive}}));
    EXPECT_EQ(read("evil"), "up");
    EXPECT_EQ(read("etc/evil"), "root");
    EXPECT_EQ(read("a/b"), "winding");
    EXPECT_EQ(read("same"), "1"); // no file takes another's place
    EXPECT_FALSE(fs::exists(m_out / "link"));
    EXPECT_FALSE(fs::exists(m_out.path().parent_path() / "evil"));
    int files = 0;
    for (const auto &entry : fs::recursive_directory_iterator(m_out.path()))
        files += entry.is_regular_file() ? 1 : 0;
    EXPECT_EQ(files, 5);
}

TEST_F(Archive, zipBombsAreRefused) {
    const fs::path path =
        make([](auto *w) { add(w, "bomb", std::string(std::size_t(64) << 20, '\0')); });
    EXPECT_LT(fs::file_size(path), std::uintmax_t(1) << 20);
    EXPECT_THAT(refusal(path, {.bytes = 1 << 20}), testing::HasSubstr("more than"));
    EXPECT_TRUE(isOutEmpty());
    EXPECT_THAT(refusal(make([](auto *w) {
                            for (int n = 0; n < 20; ++n)
                                add(w, ("f" + std::to_string(n)).c_str(), "x");
                        }),
                        {.files = 10}),
                testing::HasSubstr("more than 10 files"));
    EXPECT_TRUE(isOutEmpty());
}

// The directory states ten bytes, but the file has a mebibyte.
TEST_F(Archive, aFalseSizeUnpacksNoMoreThanTheLimit) {
    const fs::path path =
        make([](auto *w) { add(w, "liar", std::string(std::size_t(1) << 20, '\0')); }, "zip:store");
    std::string bytes;
    {
        std::ifstream in(path, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    const std::string size{"\0\0\x10\0", 4};
    const auto at = bytes.find("PK\1\2"); // the file's entry in the directory
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(bytes.find("PK\1\2", at + 4), std::string::npos);
    ASSERT_EQ(bytes.substr(at + 24, 4), size);
    bytes.replace(at + 24, 4, std::string{"\x0a\0\0\0", 4}); // uncompressed size
    std::ofstream(path, std::ios::binary) << bytes;
    const std::string refused = refusal(path, {.bytes = 1000});
    EXPECT_NE(refused, "unpacked");
    for (const auto &entry : fs::recursive_directory_iterator(m_out.path()))
        EXPECT_LE(entry.file_size(), 1U << 16);
}

TEST_F(Archive, encryptedAndDamagedArchivesAreRefused) {
    EXPECT_EQ(refusal(make([](auto *w) { add(w, "secret", "text"); }, "zip:encryption=traditional",
                           "password")),
              "is encrypted");
    const fs::path path = make([](auto *w) { add(w, "file", std::string(100000, 'x')); });
    fs::resize_file(path, fs::file_size(path) / 2);
    EXPECT_THAT(refusal(path), testing::HasSubstr("damaged"));
}

// One file has a wrong checksum, and another cannot be decompressed.
TEST_F(Archive, aDamagedFileCostsItself) {
    const auto content = [](int n) { return std::string(50000, char('a' + n)); };
    const fs::path path = make([&](auto *w) {
        for (int n = 0; n < 5; ++n)
            add(w, ("f" + std::to_string(n)).c_str(), content(n));
    });
    std::string bytes;
    {
        std::ifstream in(path, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    const auto dataOf = [&](const std::string &name) {
        const auto at = bytes.find(name); // data follows the name and the extra field
        return at + name.size() + std::size_t(static_cast<unsigned char>(bytes[at - 2])) +
               256U * static_cast<unsigned char>(bytes[at - 1]);
    };
    bytes[dataOf("f1") + 12] ^= 0x10;
    for (std::size_t n = 0; n < 8; ++n)
        bytes[dataOf("f3") + n] = char(0xff);
    std::ofstream(path, std::ios::binary) << bytes;
    const auto leftOut = unpackArchive(Decoder::shared(), path, m_out.path());
    ASSERT_EQ(leftOut.size(), 2U);
    for (const std::size_t n : {0U, 1U}) {
        EXPECT_EQ(leftOut[n].name, n == 0 ? "f1" : "f3");
        EXPECT_TRUE(leftOut[n].reason.is(task::because::isDamagedInTheArchive));
        EXPECT_THAT(leftOut[n].reason.english(),
                    testing::StartsWith("is damaged in the archive: ZIP"));
    }
    for (const int n : {0, 2, 4})
        EXPECT_EQ(read(("f" + std::to_string(n)).c_str()), content(n));
    EXPECT_FALSE(fs::exists(m_out.path() / "f1"));
    EXPECT_FALSE(fs::exists(m_out.path() / "f3"));
}

TEST_F(Archive, cancelStopsIt) {
    const fs::path path = make([](auto *w) { add(w, "file", "text"); });
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(
        unpackArchive(Decoder::shared(), path, m_out.path(), task::Progress(stop.get_token())),
        task::Cancelled);
}

} // namespace pellucid::decoding
