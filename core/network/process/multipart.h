// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace pellucid::network::process {

/// Splits a multipart body, as of WADO-RS, into its parts while it arrives (RFC 2046, 5.1). Accepts
/// quoted boundaries, parts without headers or bodies, and lines that end with LF alone.
class MultipartReader {
public:
    /// `begin` starts a part, `take` gets its bytes, `end` is called when its closing delimiter has
    /// come. All may throw.
    struct Sink {
        std::function<void()> begin;
        std::function<void(std::span<const std::byte>)> take;
        std::function<void()> end;
    };
    /// `contentType`: of the whole body. With a type other than multipart, or without a boundary,
    /// it is a single part unless it begins with a delimiter.
    MultipartReader(const std::string &contentType, Sink sink);

    void add(std::span<const std::byte> bytes);
    /// Ends the body. *Returns* false if the last part was incomplete.
    bool finish();

private:
    enum class State { untyped, preamble, headers, body, epilogue, single };
    /// Consumes what is certain. Returns false when more bytes are needed.
    bool step();
    void beginBody();
    void beginSingle();
    /// Whether the rest of a delimiter's line, which ends at `end` if it is here, is too long.
    bool lineIsTooLong(std::size_t begin, std::size_t end) const;

    Sink m_sink;
    std::string m_delimiter; ///< with the leading dashes
    std::string m_pending;
    State m_state = State::preamble;
    bool m_isBodyBegin = false; ///< no byte of the body has been judged
};

/// The value of a parameter such as boundary in a header field, without quotes; empty if it is
/// missing.
std::string parameterOf(const std::string &field, const std::string &name);

} // namespace pellucid::network::process
