// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/multipart.h"

#include <algorithm>

namespace pellucid::network {

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
    const std::string lower = lowered(field);
    for (std::size_t at = lower.find(';'); at != std::string::npos; at = lower.find(';', at + 1)) {
        std::size_t begin = lower.find_first_not_of(" \t", at + 1);
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
        m_state = State::single;
        m_sink.begin();
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
            m_state = State::body;
            m_sink.begin();
            return true;
        }
        if (m_pending.size() > longestHeaders) {
            m_state = State::body;
            m_sink.begin();
            return true;
        }
        return false;
    }
    case State::body: {
        const std::size_t at = m_pending.find("\n" + m_delimiter);
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

bool MultipartReader::finish() {
    if (m_state == State::single) {
        m_sink.end();
        return true;
    }
    return m_state == State::epilogue || m_state == State::preamble;
}

} // namespace pellucid::network
