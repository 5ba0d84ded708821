// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tests/support/files.h"

namespace pellucid::test {

/// A DICOM file written byte by byte, without any library that could correct its errors.
class DicomWriter {
public:
    using Tag = std::pair<std::uint16_t, std::uint16_t>;

    /// The form of a file, which may deviate from the standard.
    struct Form {
        std::string syntax = "1.2.840.10008.1.2.1"; ///< as stated in the meta header
        bool isImplicit = false;                    ///< the data set, whatever is stated
        bool hasDelimiter = true;                   ///< at the end of fragments
        bool hasOffsetTable = false;
    };

    void put(Tag tag, const std::string &vr, std::string value) {
        const bool isText = vr != "OB" && vr != "OW" && vr != "UN" && vr != "SQ";
        if (value.size() % 2 != 0)
            value += isText && vr != "UI" ? ' ' : '\0';
        m_elements[tag] = {vr, std::move(value)};
    }
    void putNumbers(Tag tag, const std::vector<double> &values) {
        std::string text;
        for (const double v : values)
            text += (text.empty() ? "" : "\\") + fmt::format("{:.10g}", v);
        put(tag, "DS", text);
    }
    void putShort(Tag tag, int value, const char *vr = "US") {
        put(tag, vr, number(std::uint16_t(value)));
    }
    void remove(Tag tag) { m_elements.erase(tag); }
    bool has(Tag tag) const { return m_elements.contains(tag); }

    /// Items of a sequence, each the data set of another writer.
    void putSequence(Tag tag, const std::vector<DicomWriter> &items) {
        m_sequences[tag] = items;
        m_elements[tag] = {"SQ", {}};
    }
    /// Pixels in fragments: a compressed syntax.
    void putFragments(std::vector<std::string> fragments) { m_fragments = std::move(fragments); }

    std::string dataset(const Form &form) const {
        std::string bytes;
        for (const auto &[tag, element] : m_elements) {
            std::string value = element.second;
            if (element.first == "SQ") {
                value.clear();
                for (const DicomWriter &item : m_sequences.at(tag)) {
                    const std::string inside = item.dataset(form);
                    value += raw({0xFFFE, 0xE000}) + number(std::uint32_t(inside.size())) + inside;
                }
            }
            bytes += header(tag, element.first, std::uint32_t(value.size()), form) + value;
        }
        if (m_fragments.empty())
            return bytes;
        bytes += header(pixelData, "OB", 0xFFFFFFFF, form);
        std::string offsets;
        std::uint32_t at = 0;
        for (const std::string &fragment : m_fragments) {
            offsets += number(at);
            at += std::uint32_t(fragment.size() + fragment.size() % 2 + 8);
        }
        bytes += item(form.hasOffsetTable ? offsets : std::string());
        for (const std::string &fragment : m_fragments)
            bytes += item(fragment);
        if (form.hasDelimiter)
            bytes += raw({0xFFFE, 0xE0DD}) + number(std::uint32_t(0));
        return bytes;
    }

    std::string file(const Form &form) const {
        DicomWriter meta;
        meta.put({0x0002, 0x0001}, "OB", std::string("\0\1", 2));
        meta.put({0x0002, 0x0002}, "UI", text({0x0008, 0x0016}));
        meta.put({0x0002, 0x0003}, "UI", text({0x0008, 0x0018}));
        meta.put({0x0002, 0x0010}, "UI", form.syntax);
        const std::string rest = meta.dataset({});
        DicomWriter length;
        length.put({0x0002, 0x0000}, "UL", number(std::uint32_t(rest.size())));
        return std::string(128, '\0') + "DICM" + length.dataset({}) + rest + dataset(form);
    }

    void write(const std::filesystem::path &path, const Form &form) const {
        writeText(path, file(form));
    }
    void write(const std::filesystem::path &path) const { write(path, Form()); }

    std::string text(Tag tag) const {
        const auto it = m_elements.find(tag);
        return it == m_elements.end() ? std::string() : it->second.second;
    }

    static constexpr Tag pixelData{0x7FE0, 0x0010};

    template <class T> static std::string number(T value) {
        std::string bytes;
        for (std::size_t n = 0; n < sizeof(T); ++n)
            bytes += char((value >> (8 * n)) & 0xFF);
        return bytes;
    }

private:
    static std::string raw(Tag tag) { return number(tag.first) + number(tag.second); }
    static std::string item(std::string bytes) {
        if (bytes.size() % 2 != 0)
            bytes += '\0';
        return raw({0xFFFE, 0xE000}) + number(std::uint32_t(bytes.size())) + bytes;
    }
    static std::string header(Tag tag, const std::string &vr, std::uint32_t bytes,
                              const Form &form) {
        if (form.isImplicit)
            return raw(tag) + number(bytes);
        const bool isLong = vr == "OB" || vr == "OW" || vr == "UN" || vr == "SQ" || vr == "UT";
        return raw(tag) + vr +
               (isLong ? std::string(2, '\0') + number(bytes) : number(std::uint16_t(bytes)));
    }

    std::map<Tag, std::pair<std::string, std::string>> m_elements;
    std::map<Tag, std::vector<DicomWriter>> m_sequences;
    std::vector<std::string> m_fragments;
};

/// A series as scanners, anonymisers and converters write it; each knob is one of their habits.
struct SeriesKnobs {
    int slices = 6, rows = 8, columns = 10;
    glm::dvec2 pixelMm{1.0, 1.0};
    double stepMm = 2.0;
    std::string modality = "CT";
    /// Positions are rounded to this, mm; 0: written with ten digits.
    double positionDigit = 0.0;
    std::vector<int> missing; ///< slices that no file is written for
    bool ownFrames = false;   ///< each slice its own frame of reference
    bool ownStudies = false;  ///< each slice its own study
    bool oneInstance = false; ///< one instance UID in all
    double axisJitterRad = 0.0;
    double pixelJitter = 0.0; ///< relative
    /// The (centre, width) of each slice; none by default.
    std::function<glm::dvec2(int slice)> window;
    /// The stored values, 16 bits signed.
    std::function<int(int column, int row, int slice)> value = [](int i, int j, int k) {
        return 100 * k + 10 * j + i;
    };
    /// Changes each file last.
    std::function<void(DicomWriter &, int slice)> change;
};

inline DicomWriter sliceOf(const SeriesKnobs &knobs, int k) {
    DicomWriter w;
    const std::string slice = std::to_string(k + 1);
    const std::string root = "1.2.826.0.1.3680043.8.498.";
    w.put({0x0008, 0x0008}, "CS", std::string("ORIGINAL\\PRIMARY\\AXIAL"));
    w.put({0x0008, 0x0016}, "UI",
          std::string(knobs.modality == "MR" ? "1.2.840.10008.5.1.4.1.1.4"
                                             : "1.2.840.10008.5.1.4.1.1.2"));
    w.put({0x0008, 0x0018}, "UI", root + "1" + (knobs.oneInstance ? "" : "." + slice));
    w.put({0x0008, 0x0060}, "CS", knobs.modality);
    w.put({0x0010, 0x0020}, "LO", std::string("knobs"));
    w.put({0x0020, 0x000D}, "UI", root + "2" + (knobs.ownStudies ? "." + slice : ""));
    w.put({0x0020, 0x000E}, "UI", root + "3");
    w.put({0x0020, 0x0052}, "UI", root + "4" + (knobs.ownFrames ? "." + slice : ""));
    w.put({0x0020, 0x0013}, "IS", slice);
    const double turn = knobs.axisJitterRad * std::sin(1.7 * k);
    const glm::dvec3 row = glm::normalize(glm::dvec3(1.0, turn, -turn));
    const glm::dvec3 column = glm::normalize(glm::cross(glm::dvec3(0.0, 0.0, 1.0), row));
    w.putNumbers({0x0020, 0x0037}, {row.x, row.y, row.z, column.x, column.y, column.z});
    const double z = -31.7 + k * knobs.stepMm, digit = knobs.positionDigit;
    w.putNumbers({0x0020, 0x0032}, {-5.0, 7.0, digit > 0.0 ? std::round(z / digit) * digit : z});
    w.putNumbers({0x0018, 0x0050}, {knobs.stepMm});
    const glm::dvec2 pixel = knobs.pixelMm * (1.0 + knobs.pixelJitter * std::cos(2.3 * k));
    w.putNumbers({0x0028, 0x0030}, {pixel.y, pixel.x});
    w.putShort({0x0028, 0x0002}, 1);
    w.put({0x0028, 0x0004}, "CS", std::string("MONOCHROME2"));
    w.putShort({0x0028, 0x0010}, knobs.rows);
    w.putShort({0x0028, 0x0011}, knobs.columns);
    w.putShort({0x0028, 0x0100}, 16);
    w.putShort({0x0028, 0x0101}, 16);
    w.putShort({0x0028, 0x0102}, 15);
    w.putShort({0x0028, 0x0103}, 1);
    w.putNumbers({0x0028, 0x1052}, {0.0});
    w.putNumbers({0x0028, 0x1053}, {1.0});
    if (knobs.window) {
        const glm::dvec2 window = knobs.window(k);
        w.putNumbers({0x0028, 0x1050}, {window.x});
        w.putNumbers({0x0028, 0x1051}, {window.y});
    }
    std::string pixels;
    for (int j = 0; j < knobs.rows; ++j)
        for (int i = 0; i < knobs.columns; ++i)
            pixels += DicomWriter::number(std::uint16_t(knobs.value(i, j, k)));
    w.put(DicomWriter::pixelData, "OW", pixels);
    if (knobs.change)
        knobs.change(w, k);
    return w;
}

/// Writes files S001.dcm, S002.dcm, ...
inline void writeSeries(const std::filesystem::path &folder, const SeriesKnobs &knobs,
                        const DicomWriter::Form &form = DicomWriter::Form()) {
    std::filesystem::create_directories(folder);
    for (int k = 0; k < knobs.slices; ++k)
        if (std::find(knobs.missing.begin(), knobs.missing.end(), k) == knobs.missing.end())
            sliceOf(knobs, k).write(folder / fmt::format("S{:03}.dcm", k + 1), form);
}

} // namespace pellucid::test
