// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/json_lines_nlohmann.h"

#include "core/files/reasons.h"

namespace pellucid::files {

namespace {

// No file that people write is nested deeper.
constexpr std::size_t deepest = 32;

// Reads a text and counts lines. The parser reads one character beyond a number, so a line ends
// only when the first character of the next one is read.
struct LineReader {
    using iterator_category = std::forward_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char *;
    using reference = const char &;

    const char *at = nullptr, *begin = nullptr;
    int *line = nullptr;

    reference operator*() const { return *at; }
    LineReader &operator++() {
        if (at != begin && at[-1] == '\n')
            ++*line;
        ++at;
        return *this;
    }
    LineReader operator++(int) {
        LineReader before = *this;
        ++*this;
        return before;
    }
    bool operator==(const LineReader &other) const { return at == other.at; }
};

} // namespace

JsonLines::JsonLines(const std::string &text) {
    const char *const first = text.data();
    nlohmann::json::sax_parse(LineReader{first, first, &m_line},
                              LineReader{first + text.size(), first, &m_line},
                              static_cast<nlohmann::json::json_sax_t *>(this));
}

int JsonLines::of(std::string pointer) const {
    for (;;) {
        const auto found = m_lines.find(pointer);
        if (found != m_lines.end())
            return found->second;
        const auto slash = pointer.rfind('/');
        if (slash == std::string::npos)
            return 1;
        pointer.resize(slash);
    }
}

bool JsonLines::key(string_t &name) {
    m_levels.back().key = name;
    // Only one of the two would be used, without notice.
    if (!m_levels.back().names.insert(name).second) {
        m_failure = task::because::memberIsGivenTwice(name);
        return false;
    }
    return true;
}

bool JsonLines::parse_error(std::size_t, const std::string &,
                            const nlohmann::json::exception &error) {
    // "parse error at line 3, column 5: what", or "what".
    std::string fault = jsonFault(error);
    if (fault.rfind("parse error at", 0) == 0)
        fault = fault.substr(fault.find(": ") + 2);
    m_failure = task::because::isNoJson(fault);
    return false;
}

std::string JsonLines::pointer() const {
    std::string text;
    for (const Level &level : m_levels)
        text += "/" + (level.isArray ? std::to_string(level.index) : level.key);
    return text;
}

void JsonLines::next() {
    if (!m_levels.empty() && m_levels.back().isArray)
        ++m_levels.back().index;
}

bool JsonLines::value() {
    m_lines[pointer()] = m_line;
    next();
    return true;
}

bool JsonLines::open(bool isArray) {
    if (m_levels.size() >= deepest) {
        m_failure = task::because::nestsTooDeeply;
        return false;
    }
    m_lines[pointer()] = m_line;
    m_levels.push_back({isArray, 0, {}, {}});
    return true;
}

bool JsonLines::close() {
    m_levels.pop_back();
    next();
    return true;
}

} // namespace pellucid::files
