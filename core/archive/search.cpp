// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/search.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <exception>
#include <iterator>
#include <map>
#include <mutex>
#include <thread>

#include "core/archive/login.h"
#include "core/archive/reasons.h"
#include "core/network/client/link.h"
#include "core/system/utf8.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
namespace tag = network::tag;
using network::Level;
using task::Error;
using task::ErrorCode;

const char *nameOf(Level level) {
    switch (level) {
    case Level::study:
        return "study";
    case Level::series:
        return "series";
    case Level::image:
        return "image";
    }
    return "";
}

void requirePlain(const std::string &text) {
    if (!system::isUtf8(text))
        throw Error(ErrorCode::usage, because::searchTextIsNotUtf8(text));
    if (text.find('\\') != std::string::npos ||
        std::any_of(text.begin(), text.end(), [](char c) { return (unsigned char)(c) < 0x20; }))
        throw Error(ErrorCode::usage, because::searchTextHasABackslash(text));
}

void requireDate(const std::string &date) {
    const auto dash = date.find('-');
    const std::string from = date.substr(0, dash),
                      to = dash == std::string::npos ? from : date.substr(dash + 1);
    if (from.empty() && to.empty())
        throw Error(ErrorCode::usage, because::isNoDateRange(date));
    for (const std::string &day : {from, to}) {
        if (day.empty() || isDay(day))
            continue;
        const bool isWritten =
            day.size() == 8 && day.find_first_not_of("0123456789") == std::string::npos;
        throw Error(ErrorCode::usage,
                    isWritten ? because::thereIsNoDay(day) : because::isNoDateRange(date));
    }
    if (!from.empty() && !to.empty() && to < from)
        throw Error(ErrorCode::usage, because::rangeEndsBeforeItBegins(date));
}

// A server would ignore a term of another level, and answer with more than was asked for.
void requireTermsOfTheLevel(const SearchTerms &terms) {
    struct Term {
        const std::string &text;
        const char *option;
        Level first, last; // to which it applies
    };
    for (const Term &term : {Term{terms.patientName, "--name", Level::study, Level::study},
                             Term{terms.patientId, "--id", Level::study, Level::study},
                             Term{terms.accession, "--accession", Level::study, Level::study},
                             Term{terms.date, "--date", Level::study, Level::study},
                             Term{terms.modality, "--modality", Level::study, Level::series},
                             Term{terms.seriesUid, "--series", Level::series, Level::image}})
        if (!term.text.empty() && (terms.level < term.first || terms.level > term.last))
            throw Error(ErrorCode::usage,
                        because::termDoesNotApply(term.option, nameOf(terms.level)));
}

// Folds the answers of all servers.
class Fold {
public:
    Fold(const SearchObserver &observer, Level level) : m_observer(observer), m_level(level) {}

    void add(const std::string &server, network::Attributes attributes) {
        const std::lock_guard lock(m_mutex);
        const std::string uid = attributes[network::uidOf(m_level)];
        if (!network::isUid(uid)) {
            ++m_withoutUid[server];
            return;
        }
        const auto [known, isNew] = m_indices.emplace(uid, m_result.entries.size());
        if (isNew)
            m_result.entries.push_back({std::move(attributes), {}});
        FoundEntry &entry = m_result.entries[known->second];
        if (std::find(entry.servers.begin(), entry.servers.end(), server) == entry.servers.end())
            entry.servers.push_back(server);
        if (m_observer.found)
            m_observer.found(entry, known->second);
    }
    void end(ServerOutcome outcome) {
        const std::lock_guard lock(m_mutex);
        outcome.withoutUid = m_withoutUid[outcome.server];
        m_result.outcomes.push_back(std::move(outcome));
        if (m_observer.ended)
            m_observer.ended(m_result.outcomes.back());
    }
    SearchResult take() { return std::move(m_result); }

private:
    const SearchObserver &m_observer;
    Level m_level;
    std::mutex m_mutex;
    std::map<std::string, std::size_t> m_indices, m_withoutUid; // by UID; by server
    SearchResult m_result;
};

// "ct, mr": CT and MR. At least one, which may be empty.
std::vector<std::string> modalitiesIn(const std::string &text) {
    std::vector<std::string> modalities(1);
    for (const char c : text)
        if (c == ',')
            modalities.emplace_back();
        else if (c != ' ')
            modalities.back() += char(std::toupper((unsigned char)(c)));
    std::erase(modalities, "");
    if (modalities.empty())
        modalities.emplace_back(); // any
    return modalities;
}

// Letters without cases, accents and variants, which no server folds: ideographs and syllables of
// Hangul.
bool isUnfolded(char32_t code) {
    return (code >= 0x3400 && code <= 0x9fff) || (code >= 0xac00 && code <= 0xd7a3) ||
           code >= 0x20000;
}

// Whether a text has such letters of a term, in their order.
bool hasUnfolded(const std::string &text, const std::string &term) {
    std::size_t from = 0;
    for (std::size_t at = 0; at < term.size() && from != std::string::npos;) {
        const system::CodePoint point = system::codePointAt(term, at);
        if (isUnfolded(point.code)) {
            from = text.find(term.substr(at, point.bytes), from);
            from += from == std::string::npos ? 0 : point.bytes;
        }
        at += std::max<std::size_t>(1, point.bytes);
    }
    return from != std::string::npos;
}

bool hasOthersThanAscii(const std::string &text) {
    return std::any_of(text.begin(), text.end(), [](char c) { return (unsigned char)(c) >= 0x80; });
}

// Some servers ignore letters beyond ASCII, and list whatever has the others. One that returns a
// name in Latin letters only is believed.
bool isAnswer(const SearchTerms &terms, const network::Attributes &match) {
    const std::pair<const std::string &, std::uint32_t> all[]{
        {terms.patientName, tag::patientName},
        {terms.patientId, tag::patientId},
        {terms.accession, tag::accessionNumber}};
    return std::all_of(std::begin(all), std::end(all), [&](const auto &term) {
        const auto found = match.find(term.second);
        return found == match.end() || !hasOthersThanAscii(found->second) ||
               hasUnfolded(found->second, term.first);
    });
}

void searchAt(const Server &server, const SearchTerms &terms, Fold &fold,
              const task::Progress &progress) {
    const auto begin = std::chrono::steady_clock::now();
    ServerOutcome outcome;
    outcome.server = server.name;
    try {
        const auto find = [&](const network::Peer &peer) {
            // Servers match one modality at a time.
            for (const std::string &modality : modalitiesIn(terms.modality)) {
                network::Link link(network::Connection{peer, network::Purpose::find}, progress);
                SearchTerms one = terms;
                one.modality = modality;
                const network::QueryEnd end = link.find(
                    queryOf(one, server.limit),
                    [&](network::Attributes match) {
                        if (isAnswer(terms, match))
                            fold.add(server.name, std::move(match));
                    },
                    progress);
                outcome.reachedLimit = outcome.reachedLimit || end.reachedLimit;
                outcome.mayBeIncomplete = outcome.mayBeIncomplete || end.mayBeIncomplete;
                outcome.warnings.insert(outcome.warnings.end(), end.warnings.begin(),
                                        end.warnings.end());
            }
            return true;
        };
        withLogin(server, progress, find);
    } catch (const Error &error) {
        outcome.failure = error.reason();
        outcome.code = error.code();
    }
    outcome.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    fold.end(std::move(outcome));
}

} // namespace

bool isDay(const std::string &text) {
    if (text.size() != 8 || text.find_first_not_of("0123456789") != std::string::npos)
        return false;
    const auto number = [&](std::size_t at, std::size_t digits) {
        return std::stoi(text.substr(at, digits));
    };
    return std::chrono::year_month_day(std::chrono::year(number(0, 4)),
                                       std::chrono::month(unsigned(number(4, 2))),
                                       std::chrono::day(unsigned(number(6, 2))))
        .ok();
}

std::string FoundEntry::text(std::uint32_t tag) const {
    const auto at = attributes.find(tag);
    return at == attributes.end() ? std::string() : at->second;
}

network::Query queryOf(const SearchTerms &terms, std::uint32_t limit) {
    requireTermsOfTheLevel(terms);
    for (const std::string *const text :
         {&terms.patientName, &terms.patientId, &terms.accession, &terms.modality})
        requirePlain(*text);
    if (!terms.date.empty())
        requireDate(terms.date);
    for (const std::string *const uid : {&terms.studyUid, &terms.seriesUid})
        if (!uid->empty() && !network::isUid(*uid))
            throw Error(ErrorCode::usage, because::isNoUid(*uid));
    if (terms.level != Level::study && terms.studyUid.empty())
        throw Error(ErrorCode::usage, because::levelNeedsAStudy);
    network::Query query{terms.level, {{tag::studyUid, terms.studyUid}}, limit};
    network::Attributes &keys = query.keys;
    switch (terms.level) {
    case Level::study:
        keys.insert({{tag::patientName, terms.patientName},
                     {tag::patientId, terms.patientId},
                     {tag::birthDate, ""},
                     {tag::sex, ""},
                     {tag::studyDate, terms.date},
                     {tag::studyTime, ""},
                     {tag::studyDescription, ""},
                     {tag::accessionNumber, terms.accession},
                     {tag::modalitiesInStudy, terms.modality},
                     {tag::seriesInStudy, ""},
                     {tag::instancesInStudy, ""}});
        break;
    case Level::series:
        keys.insert({{tag::seriesUid, terms.seriesUid},
                     {tag::seriesNumber, ""},
                     {tag::seriesDescription, ""},
                     {tag::modality, terms.modality},
                     {tag::bodyPart, ""},
                     {tag::instancesInSeries, ""}});
        break;
    case Level::image:
        if (terms.seriesUid.empty())
            throw Error(ErrorCode::usage, because::levelNeedsASeries);
        keys.insert({{tag::seriesUid, terms.seriesUid},
                     {tag::sopInstanceUid, ""},
                     {tag::sopClassUid, ""},
                     {tag::instanceNumber, ""}});
        break;
    }
    return query;
}

SearchResult search(const std::vector<Server> &servers, const SearchTerms &terms,
                    const SearchObserver &observer, const task::Progress &progress) {
    queryOf(terms, 0); // the terms make sense before anything is connected
    Fold fold(observer, terms.level);
    std::mutex mutex;
    std::exception_ptr failure;
    {
        std::vector<std::jthread> threads;
        for (const Server &server : servers)
            threads.emplace_back([&, server] {
                try {
                    searchAt(server, terms, fold, progress);
                } catch (...) {
                    const std::lock_guard lock(mutex);
                    failure = std::current_exception();
                }
            });
    }
    if (failure)
        std::rethrow_exception(failure);
    return fold.take();
}

} // namespace pellucid::archive
