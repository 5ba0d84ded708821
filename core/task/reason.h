// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace pellucid::task {

template <int Places> struct Because;
struct Argument;

/// A kind of reason: the name by which code and other processes know it, and what a reader sees in
/// English, with placeholders %1 to %9. Both live as long as the program.
struct Sentence {
    std::string_view name, english;
};

/// Every sentence of the program, from the `reasons.h` of all rooms.
std::span<const Sentence> allSentences();

/// Why something failed or was left out, or a warning: a sentence of a room's `reasons.h`, and its
/// arguments. Code compares names, never texts; the window translates the English text of the
/// sentence.
class Reason {
public:
    // NOLINTNEXTLINE(google-explicit-constructor): a reason without arguments is complete.
    Reason(Because<0> because);

    const Sentence &sentence() const { return m_sentence; }
    const std::vector<Argument> &arguments() const { return m_arguments; }
    template <int Places> bool is(Because<Places> because) const {
        return m_sentence.name == because.sentence.name;
    }
    /// The complete sentence. Reasons within it are separated by semicolons.
    std::string english() const;
    friend bool operator==(const Reason &a, const Reason &b);

    /// As one line for a file or another process, and back. Empty if the text is not a reason.
    std::string encoded() const;
    static std::optional<Reason> decoded(std::string_view text);

private:
    template <int Places> friend struct Because;
    friend class ReasonReader;
    Reason(Sentence sentence, std::vector<Argument> arguments);

    Sentence m_sentence;
    std::vector<Argument> m_arguments;
};

/// The argument for a placeholder: a text that is the same in every language, or reasons. The
/// caller rounds numbers that are not integers.
struct Argument {
    // NOLINTBEGIN(google-explicit-constructor)
    Argument(std::string value) : text(std::move(value)) {}
    Argument(const char *value) : text(value) {}
    Argument(std::string_view value) : text(value) {}
    template <std::integral T>
    requires(!std::same_as<T, bool> && !std::same_as<T, char>) Argument(T value)
        : text(std::to_string(value)) {}
    Argument(Reason value) : reasons{std::move(value)} {}
    template <int Places>
    requires(Places == 0) Argument(Because<Places> value) : reasons{Reason(value)} {}
    Argument(std::vector<Reason> values) : reasons(std::move(values)) {}
    // NOLINTEND(google-explicit-constructor)
    Argument(double) = delete;

    std::string text;
    std::vector<Reason> reasons;
    friend bool operator==(const Argument &, const Argument &) = default;
};

/// A sentence without its arguments: `because::gapBetween(mm, a, b)`. *Shape*: one argument per
/// placeholder.
template <int Places> struct Because {
    Sentence sentence;

    template <class... A>
    requires(sizeof...(A) == Places && Places > 0) Reason operator()(A &&...arguments) const {
        return Reason(sentence, {Argument(std::forward<A>(arguments))...});
    }
};

constexpr int placesIn(std::string_view english) {
    int places = 0;
    for (std::size_t n = 0; n + 1 < english.size(); ++n)
        if (english[n] == '%' && english[n + 1] >= '1' && english[n + 1] <= '9')
            places = places < english[n + 1] - '0' ? english[n + 1] - '0' : places;
    return places;
}

/// Declares a sentence of a room in its `reasons.h`, on one line: the build and `./dev
/// translations` collect them.
#define PELLUCID_REASON(name, english)                                                             \
    inline constexpr ::pellucid::task::Because<::pellucid::task::placesIn(english)> name{          \
        {#name, english}}; // NOLINT: a name

inline Reason::Reason(Because<0> because) : m_sentence(because.sentence) {}

/// The system's text for an `errno`.
Reason systemReason(int error);
Reason systemReason(const std::error_code &error);

} // namespace pellucid::task
