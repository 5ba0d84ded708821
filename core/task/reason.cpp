// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/reason.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <iterator>

#include "core/platform/file.h"
#include "core/task/reasons.h"

namespace pellucid::task {

namespace {

// Not std::array, whose size Clang cannot deduce from so many.
constexpr Sentence sentences[]{
#include "core/task/sentences.inc" // the build collects it
};

std::string english(const Argument &argument) {
    std::string all = argument.text;
    for (const Reason &reason : argument.reasons)
        all += (all.empty() ? "" : "; ") + reason.english();
    return all;
}

} // namespace

std::span<const Sentence> allSentences() {
    return sentences;
}

Reason::Reason(Sentence sentence, std::vector<Argument> arguments)
    : m_sentence(sentence), m_arguments(std::move(arguments)) {}

bool operator==(const Reason &a, const Reason &b) {
    return a.m_sentence.name == b.m_sentence.name && a.m_arguments == b.m_arguments;
}

std::string Reason::english() const {
    const std::string_view form = m_sentence.english;
    std::string filled;
    for (std::size_t n = 0; n < form.size(); ++n) {
        const std::size_t place =
            form[n] == '%' && n + 1 < form.size() ? std::size_t(form[n + 1]) - '1' : 9;
        if (place < m_arguments.size()) {
            filled += task::english(m_arguments[place]);
            ++n;
        } else {
            filled += form[n];
        }
    }
    return filled;
}

// The format: name, then for each argument t<bytes>:text or r<count>:reasons, then a semicolon.
std::string Reason::encoded() const {
    std::string out(m_sentence.name);
    for (const Argument &a : m_arguments) {
        if (a.reasons.empty()) {
            out += " t" + std::to_string(a.text.size()) + ":" + a.text;
            continue;
        }
        out += " r" + std::to_string(a.reasons.size()) + ":";
        for (const Reason &reason : a.reasons)
            out += reason.encoded();
    }
    return out + ";";
}

// The text may come from a process that has read untrusted bytes.
class ReasonReader {
public:
    explicit ReasonReader(std::string_view text) : m_rest(text) {}

    std::optional<Reason> reason(int depth = 0) {
        constexpr int deepest = 4;
        if (depth > deepest)
            return std::nullopt;
        const std::string_view name = m_rest.substr(0, m_rest.find_first_of(" ;"));
        const auto known = std::find_if(std::begin(sentences), std::end(sentences),
                                        [&](const Sentence &s) { return s.name == name; });
        if (known == std::end(sentences))
            return std::nullopt;
        m_rest.remove_prefix(name.size());
        std::vector<Argument> arguments;
        for (int left = placesIn(known->english); left > 0; --left) {
            auto argument = this->argument(depth);
            if (!argument)
                return std::nullopt;
            arguments.push_back(std::move(*argument));
        }
        if (!take(";"))
            return std::nullopt;
        return Reason(*known, std::move(arguments));
    }
    bool isAtEnd() const { return m_rest.empty(); }

private:
    bool take(std::string_view word) {
        if (!m_rest.starts_with(word))
            return false;
        m_rest.remove_prefix(word.size());
        return true;
    }

    std::optional<std::size_t> count() {
        std::size_t value = 0;
        const auto [end, error] =
            std::from_chars(m_rest.data(), m_rest.data() + m_rest.size(), value);
        if (error != std::errc())
            return std::nullopt;
        m_rest.remove_prefix(std::size_t(end - m_rest.data()));
        return take(":") ? std::optional(value) : std::nullopt;
    }

    std::optional<Argument> argument(int depth) {
        if (take(" t")) {
            const auto bytes = count();
            if (!bytes || *bytes > m_rest.size())
                return std::nullopt;
            Argument text(m_rest.substr(0, *bytes));
            m_rest.remove_prefix(*bytes);
            return text;
        }
        const auto reasons = take(" r") ? count() : std::nullopt;
        if (!reasons || *reasons > m_rest.size())
            return std::nullopt;
        std::vector<Reason> all;
        for (std::size_t n = 0; n < *reasons; ++n) {
            auto one = reason(depth + 1);
            if (!one)
                return std::nullopt;
            all.push_back(std::move(*one));
        }
        return Argument(std::move(all));
    }

    std::string_view m_rest;
};

std::optional<Reason> Reason::decoded(std::string_view text) {
    ReasonReader reader(text);
    auto reason = reader.reason();
    return reader.isAtEnd() ? reason : std::nullopt;
}

Reason systemReason(int error) {
    if (error == platform::quotaExceeded())
        return because::quotaExceeded;
    switch (error) {
    case ENOENT:
        return because::noSuchFile;
    case EACCES:
        return because::permissionDenied;
    case EPERM:
        return because::notPermitted;
    case ENOSPC:
        return because::noSpaceLeft;
    case EROFS:
        return because::readOnlyFileSystem;
    case EISDIR:
        return because::isADirectory;
    case ENOTDIR:
        return because::isNotADirectory;
    case ENAMETOOLONG:
        return because::nameTooLong;
    case EMFILE:
    case ENFILE:
        return because::tooManyOpenFiles;
    case EIO:
        return because::ioError;
    case ENOMEM:
        return because::notEnoughMemory;
    case EFBIG:
        return because::fileTooLarge;
    case ELOOP:
        return because::tooManyLinks;
    case ETXTBSY:
    case EBUSY:
        return because::isOpenElsewhere;
    default:
        return because::systemReports(std::strerror(error));
    }
}

Reason systemReason(const std::error_code &error) {
    if (const auto common = error.default_error_condition();
        common.category() == std::generic_category())
        return systemReason(common.value());
    return because::systemReports(error.message());
}

} // namespace pellucid::task
