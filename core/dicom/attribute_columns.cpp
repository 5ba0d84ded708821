// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/attribute_columns.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/decoding/client/instance.h"
#include "core/dicom/reasons.h"
#include "core/task/error.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using decoding::Attribute;
using decoding::ValueKind;

std::optional<double> parsed(std::string_view text) {
    if (!text.empty() && text.front() == '+')
        text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool isNumber =
        error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
    return isNumber ? std::optional(value) : std::nullopt;
}

// The number of an item, as a list writes it.
std::uint32_t itemNumber(const Attribute &item) {
    std::uint32_t number = 0;
    std::from_chars(item.name.data(), item.name.data() + item.name.size(), number);
    return number;
}

// Seconds of a time, or of a date with its time, of which nothing is left out: HHMMSS.FFFFFF.
std::optional<double> secondsIn(std::string_view text) {
    constexpr std::size_t digitsOfDate = 8, digitsOfTime = 6;
    double days = 0.0;
    const std::size_t digits = std::min(text.find('.'), text.size());
    if (digits == digitsOfDate + digitsOfTime) {
        // Any count of days that grows by one each day of a month will do: scans end the same day.
        days = parsed(text.substr(0, digitsOfDate)).value_or(0.0);
        text.remove_prefix(digitsOfDate);
    } else if (digits != digitsOfTime) {
        return std::nullopt;
    }
    const auto hours = parsed(text.substr(0, 2)), minutes = parsed(text.substr(2, 2)),
               seconds = parsed(text.substr(4));
    if (!hours || !minutes || !seconds)
        return std::nullopt;
    return ((days * 24.0 + *hours) * 60.0 + *minutes) * 60.0 + *seconds;
}

// "Flip Angle" from the keyword "FlipAngle".
std::string wordsOf(const std::string &keyword) {
    std::string words;
    for (std::size_t n = 0; n < keyword.size(); ++n) {
        const auto isUpper = [&](std::size_t at) {
            return at < keyword.size() && std::isupper((unsigned char)(keyword[at])) != 0;
        };
        if (n > 0 && isUpper(n) && (!isUpper(n - 1) || (n + 1 < keyword.size() && !isUpper(n + 1))))
            words += ' ';
        words += keyword[n];
    }
    return words;
}

// The first of several values, to which some scanners add 10^9.
std::string bValueOfGe(const std::string &values) {
    constexpr double added = 1e5; // a b-value is less
    const std::string first = values.substr(0, values.find('\\'));
    const auto number = parsed(first);
    return number ? fmt::format("{:g}", std::fmod(*number, added)) : first;
}

// The order in which attributes are tried.
enum class Trust { standard, aboutPixels, uid, privateOne };

constexpr std::uint32_t groupOf(std::uint32_t tag) {
    return tag >> 16;
}

Trust trustIn(const Attribute &attribute) {
    constexpr std::uint32_t pixelGroup = 0x0028;
    if (groupOf(attribute.tag) % 2 == 1)
        return Trust::privateOne;
    if (attribute.vr == "UI")
        return Trust::uid;
    return groupOf(attribute.tag) == pixelGroup ? Trust::aboutPixels : Trust::standard;
}

ValueKind kindOf(const Attribute &attribute) {
    constexpr std::array numbers{"DS", "IS", "FD", "FL", "US", "SS", "UL", "SL"};
    // Values that scanners compute from an image say nothing about its neighbours.
    const bool isOfImage = trustIn(attribute) != Trust::standard;
    if (!isOfImage && (attribute.vr == "TM" || attribute.vr == "DT"))
        return ValueKind::driftingTime;
    if (std::find(numbers.begin(), numbers.end(), attribute.vr) == numbers.end())
        return ValueKind::text;
    return isOfImage ? ValueKind::number : ValueKind::driftingNumber;
}

// Numbers of images are used only as a last resort. A place is what the frames have in common.
bool isIgnored(const Attribute &attribute) {
    constexpr std::array<std::uint32_t, 9> ignored{
        0x00200013, // Instance Number
        0x00541330, // Image Index
        0x00080018, // SOP Instance UID
        0x00020003, // the same in the meta header
        0x00020000, // the length of that
        0x00200032, // Image Position (Patient)
        0x00201041, // Slice Location
        0x00209157, // Dimension Index Values
        0x00209057, // In-Stack Position Number
    };
    constexpr std::uint32_t pixelData = 0x7FE0;
    return std::find(ignored.begin(), ignored.end(), attribute.tag) != ignored.end() ||
           groupOf(attribute.tag) >= pixelData || attribute.vr.empty() || attribute.vr == "SQ" ||
           std::any_of(decoding::dimensions.begin(), decoding::dimensions.end(),
                       [&](const auto &dimension) { return dimension.tag == attribute.tag; });
}

// The functional groups of all frames, and of each.
constexpr std::uint32_t perFrameGroups = 0x52009230;

// Calls `take` with each value of a list, the tags that lead to it, and its frame in the file, or
// nothing for values of the whole file. Of sequences, only single items have a meaning here.
template <class F> void forEachValue(const decoding::AttributeList &list, F &&take) {
    std::vector<std::uint32_t> path; // the tags and item numbers above, by depth
    std::optional<int> frame;
    for (const Attribute &attribute : list.attributes) {
        path.resize(std::size_t(attribute.depth));
        if (attribute.depth <= 1)
            frame.reset();
        const bool isItem = attribute.vr.empty();
        if (isItem && attribute.depth == 1 && path.front() == perFrameGroups)
            frame = int(std::min<std::uint32_t>(itemNumber(attribute), decoding::maxFrames)) - 1;
        if (!isItem && attribute.vr != "SQ")
            take(attribute, path, frame);
        const bool isFrame = isItem && frame && attribute.depth == 1;
        path.push_back(!isItem ? attribute.tag : isFrame ? 0 : itemNumber(attribute));
    }
}

// Gathers the columns of many files.
class ColumnBuilder {
public:
    explicit ColumnBuilder(std::size_t frames) : m_frames(frames) {}

    // `ofFile`: the indices of the file's frames in the stack, by their number in the file.
    void add(const decoding::AttributeList &list, const std::map<int, std::size_t> &ofFile) {
        forEachValue(list, [&](const Attribute &attribute, std::vector<std::uint32_t> path,
                               std::optional<int> frame) {
            if (isIgnored(attribute))
                return;
            path.push_back(attribute.tag);
            const auto trust = trustIn(attribute);
            const auto it = m_columns.try_emplace({trust, std::move(path)}, kindOf(attribute),
                                                  labelFor(attribute), m_frames);
            Column &column = it.first->second;
            if (!frame)
                for (const auto &[number, index] : ofFile)
                    column.set(index, attribute.value);
            else if (const auto at = ofFile.find(*frame); at != ofFile.end())
                column.set(at->second, attribute.value);
        });
    }

    std::vector<Column> take() {
        std::vector<Column> columns;
        for (auto &[key, column] : m_columns)
            if (!column.isConstant())
                columns.push_back(std::move(column));
        return columns;
    }

private:
    static Column::Label labelFor(const Attribute &attribute) {
        const std::string name = trustIn(attribute) == Trust::privateOne
                                     ? fmt::format("{} {}", attribute.name, tagText(attribute))
                                     : wordsOf(attribute.name);
        return [name](const std::string &value) { return because::attributeIs(name, value); };
    }

    std::size_t m_frames;
    std::map<std::pair<Trust, std::vector<std::uint32_t>>, Column> m_columns;
};

} // namespace

Column::Column(ValueKind kind, Label label, std::size_t frames, bool isKnown)
    : m_kind(kind), m_label(std::move(label)), m_isKnown(isKnown), m_ids(frames), m_values(1),
      m_numbers(1) {}

void Column::set(std::size_t frame, const std::string &value) {
    if (value.empty())
        return;
    const std::optional<double> number = m_kind == ValueKind::driftingTime ? secondsIn(value)
                                         : m_kind == ValueKind::text       ? std::nullopt
                                                                           : parsed(value);
    // "80.0" and "8E1" are 80.
    const auto [it, isNew] = m_known.try_emplace(number ? fmt::format("{}", *number) : value,
                                                 std::uint32_t(m_values.size()));
    if (isNew) {
        m_values.push_back(value);
        m_numbers.push_back(number);
    }
    m_ids[frame] = it->second;
}

bool Column::mayDrift() const {
    return m_kind == ValueKind::driftingNumber || m_kind == ValueKind::driftingTime;
}

bool Column::isConstant() const {
    return std::adjacent_find(m_ids.begin(), m_ids.end(), std::not_equal_to()) == m_ids.end();
}

std::vector<Column> headerColumns(const std::vector<PlacedFrame> &frames) {
    std::vector<Column> columns;
    const auto add = [&](Column column) {
        if (!column.isConstant())
            columns.push_back(std::move(column));
    };
    for (const decoding::Dimension &dimension : decoding::dimensions) {
        Column column(
            dimension.kind,
            [&](const std::string &value) {
                const auto number = dimension.kind == ValueKind::number ||
                                            dimension.kind == ValueKind::driftingNumber
                                        ? parsed(value)
                                        : std::nullopt;
                return dimension.label(number ? fmt::format("{:g}", *number) : value);
            },
            frames.size(), true);
        for (std::size_t n = 0; n < frames.size(); ++n)
            if (const auto at = frames[n].header.dimensions.find(dimension.tag);
                at != frames[n].header.dimensions.end())
                column.set(n, dimension.tag == decoding::bValueOfGeTag ? bValueOfGe(at->second)
                                                                       : at->second);
        add(std::move(column));
    }
    Column files(
        ValueKind::text,
        [](const std::string &path) {
            return because::fileNamed(std::filesystem::path(path).filename().string());
        },
        frames.size(), true);
    for (std::size_t n = 0; n < frames.size(); ++n)
        if (frames[n].framesOfFile > 1)
            files.set(n, frames[n].reference.path.string());
    add(std::move(files));
    return columns;
}

std::vector<Column> otherColumns(const std::vector<PlacedFrame> &frames, const ReadAttributes &read,
                                 const task::Progress &progress) {
    std::map<std::filesystem::path, std::map<int, std::size_t>> indices;
    for (std::size_t n = 0; n < frames.size(); ++n)
        indices[frames[n].reference.path][frames[n].reference.frame] = n;
    std::vector<const std::pair<const std::filesystem::path, std::map<int, std::size_t>> *> files;
    for (const auto &file : indices)
        files.push_back(&file);
    ColumnBuilder builder(frames.size());
    // A list takes some 20 kB: not all are held at once.
    constexpr std::size_t atOnce = 64;
    try {
        for (std::size_t first = 0; first < files.size(); first += atOnce) {
            std::vector<decoding::AttributeList> lists(std::min(atOnce, files.size() - first));
            tbb::parallel_for(std::size_t(0), lists.size(), [&](std::size_t n) {
                progress.check();
                lists[n] = read(files[first + n]->first);
            });
            if (std::any_of(lists.begin(), lists.end(),
                            [](const auto &list) { return !list.isComplete; }))
                return {};
            for (std::size_t n = 0; n < lists.size(); ++n)
                builder.add(lists[n], files[first + n]->second);
        }
    } catch (const task::Error &error) {
        if (error.code() == task::ErrorCode::internal)
            throw;
        return {};
    }
    return builder.take();
}

} // namespace pellucid::dicom
