// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/files/json_value_nlohmann.h"
#include "core/files/reasons.h"

namespace pellucid::files {

/// The line of every value of a JSON text, by JSON pointer, so that what is wrong with a file that
/// people write can be found.
class JsonLines : private nlohmann::json::json_sax_t {
public:
    explicit JsonLines(const std::string &text);
    /// The line of a value, or of the nearest enclosing one.
    int of(std::string pointer) const;
    /// Why parsing stopped, if it did.
    const std::optional<task::Reason> &failure() const { return m_failure; }
    /// The last line that was read.
    int line() const { return m_line; }

private:
    struct Level {
        bool isArray = false;
        std::size_t index = 0;
        std::string key;             ///< of an object: the last one
        std::set<std::string> names; ///< of an object: all so far
    };
    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t &) override { return value(); }
    bool string(string_t &) override { return value(); }
    bool binary(binary_t &) override { return value(); }
    bool start_object(std::size_t) override { return open(false); }
    bool start_array(std::size_t) override { return open(true); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t &name) override;
    bool parse_error(std::size_t position, const std::string &token,
                     const nlohmann::json::exception &error) override;
    std::string pointer() const;
    void next();
    bool value();
    bool open(bool isArray);
    bool close();

    int m_line = 1;
    std::vector<Level> m_levels;
    std::map<std::string, int> m_lines;
    std::optional<task::Reason> m_failure;
};

/// What `read` makes of the whole of a JSON text. *Throws* Error{unusable}, naming the line, for
/// whatever `read` refuses or the text is no JSON.
template <class F> auto readJson(const std::string &text, F &&read) {
    using task::Error;
    using task::ErrorCode;
    const JsonLines lines(text);
    if (lines.failure())
        throw Error(ErrorCode::unusable, task::because::atLine(lines.line(), *lines.failure()));
    try {
        const nlohmann::json whole = nlohmann::json::parse(text);
        return read(JsonValue(whole));
    } catch (const Error &error) {
        const task::Reason &reason = error.reason();
        throw Error(ErrorCode::unusable,
                    task::because::atLine(lines.of(jsonPointer(reason)), reason));
    }
}

} // namespace pellucid::files
