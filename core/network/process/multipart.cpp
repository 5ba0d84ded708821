// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/multipart.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pellucid::network::process {

namespace {

constexpr std::size_t longestHeaders = 16384; // of a part; longer ones belong to its body
constexpr std::size_t longestLine = 1024;     // of a delimiter; a longer one is none

std::string lowered(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::span<const std::byte> bytesOf(const std::string &text, std::size_t count) {
    return std::as_bytes(std::span(text)).first(count);
}

} // namespace

std::string parameterOf(const std::string &field, const std::string &name) {
    // The semicolons outside of quotes.
    std::vector<std::size_t> starts;
    for (std::size_t at = 0, isQuoted = 0; at < field.size(); ++at) {
        isQuoted ^= field[at] == '"' ? 1 : 0;
        if (field[at] == ';' && isQuoted == 0)
            starts.push_back(at + 1);
    }
    const std::string lower = lowered(field);
    for (const std::size_t start : starts) {
        std::size_t begin = lower.find_first_not_of(" \t", start);
        if (begin == std::string::npos || lower.compare(begin, name.size(), name) != 0)
            continue;
        begin = lower.find_first_not_of(" \t", begin + name.size());
        if (begin == std::string::npos || lower[begin] != '=')
            continue;
        begin = lower.find_first_not_of(" \t", begin + 1);
        if (begin == std::string::npos)
            return {};
        if (field[begin] == '"') {
            const std::size_t end = field.find('"', begin + 1);
            return field.substr(begin + 1,
                                end == std::string::npos ? std::string::npos : end - begin - 1);
        }
        return field.substr(begin, field.find_first_of("; \t", begin) - begin);
    }
    return {};
}

MultipartReader::MultipartReader(const std::string &contentType, Sink sink)
    : m_sink(std::move(sink)) {
    const std::string boundary = parameterOf(contentType, "boundary");
    if (lowered(contentType).find("multipart/") == std::string::npos || boundary.empty()) {
        m_state = State::untyped;
    } else {
        m_delimiter = "--" + boundary;
    }
}

void MultipartReader::add(std::span<const std::byte> bytes) {
    if (m_state == State::single) {
        m_sink.take(bytes);
        return;
    }
    m_pending.append(reinterpret_cast<const char *>(bytes.data()), bytes.size());
    while (step()) {
    }
}

bool MultipartReader::lineIsTooLong(std::size_t begin, std::size_t end) const {
    return std::min(end, m_pending.size()) - begin > longestLine;
}

bool MultipartReader::step() {
    switch (m_state) {
    case State::untyped: {
        const std::string dashes = m_pending.substr(0, 2);
        const std::size_t line = m_pending.find('\n');
        const bool mayBegin =
            dashes == std::string("--").substr(0, dashes.size()) && !lineIsTooLong(0, line);
        if (mayBegin && line == std::string::npos)
            return false;
        if (!mayBegin) {
            beginSingle();
            return false;
        }
        m_delimiter = m_pending.substr(0, m_pending.find_last_not_of("\r \t", line - 1) + 1);
        if (m_delimiter == "--") { // an empty one would be found anywhere
            beginSingle();
            return false;
        }
        m_state = State::preamble;
        return true;
    }
    case State::preamble: {
        // The first delimiter is at the start of a line.
        const std::size_t at = m_pending.find(m_delimiter);
        const std::size_t end =
            at == std::string::npos ? at : m_pending.find('\n', at + m_delimiter.size());
        if (at != std::string::npos && lineIsTooLong(at + m_delimiter.size(), end)) {
            m_pending.erase(0, at + m_delimiter.size());
            return true;
        }
        if (end == std::string::npos) {
            if (at == std::string::npos && m_pending.size() > m_delimiter.size())
                m_pending.erase(0, m_pending.size() - m_delimiter.size());
            return false;
        }
        const bool isLast = m_pending.compare(at + m_delimiter.size(), 2, "--") == 0;
        m_pending.erase(0, end + 1);
        m_state = isLast ? State::epilogue : State::headers;
        return true;
    }
    case State::headers: {
        // An empty line ends the headers; a part without headers begins with it.
        std::size_t begin = 0, end = std::string::npos;
        while ((end = m_pending.find('\n', begin)) != std::string::npos) {
            const std::size_t length = end - begin;
            const bool isEmpty = length == 0 || (length == 1 && m_pending[begin] == '\r');
            begin = end + 1;
            if (!isEmpty)
                continue;
            m_pending.erase(0, begin);
            beginBody();
            return true;
        }
        if (m_pending.size() > longestHeaders) {
            beginBody();
            return true;
        }
        return false;
    }
    case State::body: {
        const std::size_t at = m_pending.find("\n" + m_delimiter);
        // A part may have no body, not even the line break before its delimiter.
        if (m_isBodyBegin && m_pending.size() < m_delimiter.size() &&
            m_delimiter.starts_with(m_pending))
            return false;
        if (std::exchange(m_isBodyBegin, false) && m_pending.starts_with(m_delimiter)) {
            m_pending.insert(0, "\r\n");
            return true;
        }
        if (at == std::string::npos) {
            // The delimiter, or the line break before it, may be coming.
            const std::size_t kept = m_delimiter.size() + 2;
            if (m_pending.size() > kept) {
                m_sink.take(bytesOf(m_pending, m_pending.size() - kept));
                m_pending.erase(0, m_pending.size() - kept);
            }
            return false;
        }
        const std::size_t after = at + 1 + m_delimiter.size();
        if (m_pending.size() < after + 2)
            return false;
        const bool isLast = m_pending.compare(after, 2, "--") == 0;
        const std::size_t line = m_pending.find('\n', after);
        if (!isLast && lineIsTooLong(after, line)) {
            m_sink.take(bytesOf(m_pending, after));
            m_pending.erase(0, after);
            return true;
        }
        if (!isLast && line == std::string::npos)
            return false;
        const std::size_t length = at > 0 && m_pending[at - 1] == '\r' ? at - 1 : at;
        m_sink.take(bytesOf(m_pending, length));
        m_sink.end();
        m_pending.erase(0, isLast ? after : line + 1);
        m_state = isLast ? State::epilogue : State::headers;
        return true;
    }
    case State::epilogue:
    case State::single:
        m_pending.clear();
        return false;
    }
    return false;
}

void MultipartReader::beginBody() {
    m_state = State::body;
    m_isBodyBegin = true;
    m_sink.begin();
}

void MultipartReader::beginSingle() {
    m_state = State::single;
    m_sink.begin();
    m_sink.take(bytesOf(m_pending, m_pending.size()));
    m_pending.clear();
}

bool MultipartReader::finish() {
    if (m_state == State::untyped)
        beginSingle();
    if (m_state == State::single) {
        m_sink.end();
        return true;
    }
    return m_state == State::epilogue || m_state == State::preamble;
}

} // namespace pellucid::network::process
