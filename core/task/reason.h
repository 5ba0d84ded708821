// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace pellucid::task {

template <int Places> struct Because;
struct Argument;

/// Why something failed or was left out, or a warning: a sentence of reasons.inc and its arguments.
/// Code compares Ids, never texts; the window translates by Id.
class Reason {
public:
    enum class Id : std::uint16_t {
#define PELLUCID_REASON(name, english) name,
#include "core/task/reasons.inc"
#undef PELLUCID_REASON
        count
    };

    // NOLINTNEXTLINE(google-explicit-constructor): a reason without arguments is complete.
    Reason(Because<0> because);

    Id id() const {
        return m_id;
    }
    const std::vector<Argument> &arguments() const {
        return m_arguments;
    }
    template <int Places> bool is(Because<Places> because) const {
        return m_id == because.id;
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
    Reason(Id id, std::vector<Argument> arguments);

    Id m_id;
    std::vector<Argument> m_arguments;
};

/// The English sentence, with placeholders %1 to %9.
std::string_view englishTemplate(Reason::Id id);

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

/// A sentence of reasons.inc without its arguments. *Shape*: one argument per placeholder.
template <int Places> struct Because {
    Reason::Id id;

    template <class... A>
    requires(sizeof...(A) == Places && Places > 0) Reason operator()(A &&...arguments) const {
        return Reason(id, {Argument(std::forward<A>(arguments))...});
    }
};

constexpr int placesIn(std::string_view english) {
    int places = 0;
    for (std::size_t n = 0; n + 1 < english.size(); ++n)
        if (english[n] == '%' && english[n + 1] >= '1' && english[n + 1] <= '9')
            places = places < english[n + 1] - '0' ? english[n + 1] - '0' : places;
    return places;
}

/// One for each sentence: `because::isEmpty`, `because::gapBetween(mm, a, b)`.
namespace because {
#define PELLUCID_REASON(name, english)                                                             \
    inline constexpr Because<placesIn(english)> name{Reason::Id::name}; // NOLINT: a name
#include "core/task/reasons.inc"
#undef PELLUCID_REASON
} // namespace because

inline Reason::Reason(Because<0> because) : m_id(because.id) {}

/// The system's text for an `errno`.
Reason systemReason(int error);
Reason systemReason(const std::error_code &error);

} // namespace pellucid::task
