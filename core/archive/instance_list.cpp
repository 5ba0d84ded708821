// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/instance_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/archive/login.h"
#include "core/archive/reasons.h"
#include "core/network/client/link.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
namespace tag = network::tag;
using network::Attributes;
using network::Level;

constexpr auto maxObjects = std::uint32_t(maxObjectsOfStudy);

std::string textOf(const Attributes &attributes, std::uint32_t tag) {
    const auto at = attributes.find(tag);
    return at == attributes.end() ? std::string() : at->second;
}

int numberOf(const std::string &text) {
    int number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

std::vector<double> numbersOf(const std::string &text) {
    std::vector<double> numbers;
    std::istringstream each(text);
    for (std::string part; std::getline(each, part, '\\');) {
        double value = 0.0;
        const char *const begin = part.data() + (part.find_first_not_of(" +") % (part.size() + 1));
        if (std::from_chars(begin, part.data() + part.size(), value).ec == std::errc())
            numbers.push_back(value);
    }
    return numbers;
}

// The place along the normal of the slices; nothing if the server does not say.
std::optional<double> heightOf(const Attributes &attributes) {
    const auto position = numbersOf(textOf(attributes, tag::position));
    const auto axes = numbersOf(textOf(attributes, tag::orientation));
    if (position.size() != 3)
        return std::nullopt;
    const glm::dvec3 normal = axes.size() == 6 ? glm::cross(glm::dvec3(axes[0], axes[1], axes[2]),
                                                            glm::dvec3(axes[3], axes[4], axes[5]))
                                               : glm::dvec3(0.0, 0.0, 1.0);
    const double height = glm::dot(normal, glm::dvec3(position[0], position[1], position[2]));
    // Only finite numbers can be sorted.
    return std::isfinite(height) ? std::optional(height) : std::nullopt;
}

struct Listed {
    Instance instance;
    std::optional<double> height;
};

// A series as the list of the study's series describes it.
struct ListedSeries {
    std::string uid;
    int number = 0;
    std::optional<std::size_t> objects;
};

std::optional<std::size_t> countOf(const std::string &text) {
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    return error == std::errc() && count <= maxObjects ? std::optional(count) : std::nullopt;
}

// Lists the objects of a study, and where the server lists less than it has.
class Lister {
public:
    Lister(network::Link &link, const Wanted &wanted, const task::Progress &progress)
        : m_link(link), m_wanted(wanted), m_progress(progress) {}

    Listing list() {
        Listing listing;
        listing.patient = m_wanted.patient;
        if (!listing.patient.isKnown() || m_wanted.seriesUids.empty())
            describeStudy(listing);
        std::vector<std::vector<Instance>> bySeries;
        for (const ListedSeries &series : seriesOfStudy())
            bySeries.push_back(instancesOf(series));
        // The series that is opened by default comes first.
        std::stable_sort(bySeries.begin(), bySeries.end(),
                         [](const auto &a, const auto &b) { return a.size() > b.size(); });
        for (std::vector<Instance> &series : bySeries)
            listing.instances.insert(listing.instances.end(),
                                     std::make_move_iterator(series.begin()),
                                     std::make_move_iterator(series.end()));
        addRestOfStudy();
        if (listing.instances.empty() && m_short.empty())
            throw task::Error(task::ErrorCode::unusable, because::serverHasNoSuchStudy);
        // A server may count what it likes, and each missing object is reported.
        std::size_t all = m_known.size();
        for (const ShortSeries &series : m_short)
            all += series.unlisted;
        if (all > maxObjectsOfStudy)
            throw task::Error(task::ErrorCode::unusable,
                              because::studyHasTooManyObjects(maxObjects));
        listing.shortSeries = std::move(m_short);
        return listing;
    }

private:
    // Empty if the server cannot list series or objects. They are then retrieved as a whole.
    std::optional<network::QueryEnd> find(Level level, const network::Attributes &keys,
                                          const std::function<void(const Attributes &)> &take) {
        try {
            return m_link.find({.level = level, .keys = keys, .limit = maxObjects}, take,
                               m_progress);
        } catch (const task::Error &error) {
            const task::Reason &why = error.reason();
            if (level == Level::study || error.code() != task::ErrorCode::unusable ||
                !(why.is(because::serverStatus) || why.is(because::serverStatusWithComment) ||
                  why.is(because::serverHasNothingThere) || why.is(because::serverAnswersHttp) ||
                  why.is(because::serverSays)))
                throw;
            return std::nullopt;
        }
    }

    // The patient, unless the user has been shown one, the date, and the numbers of series and
    // objects.
    void describeStudy(Listing &listing) {
        Patient &patient = listing.patient;
        bool isFirst = true;
        const bool isKnown = patient.isKnown();
        find(Level::study,
             {{tag::studyUid, m_wanted.studyUid},
              {tag::patientName, ""},
              {tag::patientId, ""},
              {tag::birthDate, ""},
              {tag::studyDate, ""},
              {tag::seriesInStudy, ""},
              {tag::instancesInStudy, ""}},
             [&](const Attributes &match) {
                 if (!isKnown && !patient.isKnown())
                     patient = {textOf(match, tag::patientName), textOf(match, tag::patientId),
                                textOf(match, tag::birthDate)};
                 if (std::exchange(isFirst, false)) {
                     listing.studyDate = textOf(match, tag::studyDate);
                     m_seriesInStudy = countOf(textOf(match, tag::seriesInStudy));
                     m_objectsInStudy = countOf(textOf(match, tag::instancesInStudy));
                 }
             });
    }

    // Those that are wanted, in the order of their numbers.
    std::vector<ListedSeries> seriesOfStudy() {
        std::map<std::string, ListedSeries> known;
        const auto end = find(
            Level::series,
            {{tag::studyUid, m_wanted.studyUid},
             {tag::seriesUid, m_wanted.seriesUids.size() == 1 ? m_wanted.seriesUids.front() : ""},
             {tag::seriesNumber, ""},
             {tag::instancesInSeries, ""}},
            [&](const Attributes &match) {
                const std::string uid = textOf(match, tag::seriesUid);
                if (network::isUid(uid))
                    known[uid] = {uid, numberOf(textOf(match, tag::seriesNumber)),
                                  countOf(textOf(match, tag::instancesInSeries))};
                else
                    m_invalidSeries = true;
            });
        std::vector<ListedSeries> series;
        if (m_wanted.seriesUids.empty()) {
            m_isSeriesListShort = !end || end->mayBeIncomplete || m_invalidSeries ||
                                  (m_seriesInStudy && *m_seriesInStudy > known.size());
            for (const auto &[uid, one] : known)
                series.push_back(one);
            std::stable_sort(series.begin(), series.end(),
                             [](const auto &a, const auto &b) { return a.number < b.number; });
        } else {
            for (const std::string &uid : m_wanted.seriesUids)
                series.push_back(known.contains(uid) ? known[uid] : ListedSeries{uid, 0, {}});
        }
        return series;
    }

    std::vector<Instance> instancesOf(const ListedSeries &series) {
        std::vector<Listed> listed;
        std::size_t invalid = 0;
        const auto end =
            find(Level::image,
                 {{tag::studyUid, m_wanted.studyUid},
                  {tag::seriesUid, series.uid},
                  {tag::sopInstanceUid, ""},
                  {tag::sopClassUid, ""},
                  {tag::instanceNumber, ""},
                  {tag::position, ""},
                  {tag::orientation, ""}},
                 [&](const Attributes &match) {
                     const std::string uid = textOf(match, tag::sopInstanceUid);
                     if (!network::isUid(uid)) {
                         ++invalid;
                         return;
                     }
                     if (!m_known.insert(uid).second)
                         return;
                     const std::string sopClass = textOf(match, tag::sopClassUid);
                     listed.push_back({{m_wanted.studyUid, series.uid, uid,
                                        network::isUid(sopClass) ? sopClass : std::string(),
                                        numberOf(textOf(match, tag::instanceNumber))},
                                       heightOf(match)});
                 });
        if ((end && end->reachedLimit) || m_known.size() > maxObjects)
            throw task::Error(task::ErrorCode::unusable,
                              because::studyHasTooManyObjects(maxObjects));
        const std::size_t told = std::max(series.objects.value_or(0), listed.size() + invalid);
        const bool mayHaveMore =
            !end || (end->mayBeIncomplete && !(series.objects && listed.size() >= told));
        if (told > listed.size() || mayHaveMore)
            m_short.push_back({m_wanted.studyUid, series.uid, told - listed.size(), invalid,
                               mayHaveMore && told == listed.size()});
        const bool havePlaces = std::all_of(
            listed.begin(), listed.end(), [](const Listed &one) { return one.height.has_value(); });
        std::stable_sort(listed.begin(), listed.end(), [&](const Listed &a, const Listed &b) {
            return havePlaces ? *a.height < *b.height : a.instance.number < b.instance.number;
        });
        std::vector<Instance> instances;
        for (Listed &one : listed)
            instances.push_back(std::move(one.instance));
        return instances;
    }

    // Adds the objects that the server counts in the study but not in the series that it lists.
    void addRestOfStudy() {
        std::size_t told = m_known.size();
        for (const ShortSeries &series : m_short)
            told += series.unlisted;
        const bool hasMore = m_wanted.seriesUids.empty() && m_objectsInStudy.value_or(0) > told;
        if (hasMore || m_isSeriesListShort)
            m_short.push_back(
                {m_wanted.studyUid, "", hasMore ? *m_objectsInStudy - told : 0, 0, !hasMore});
    }

    network::Link &m_link;
    const Wanted &m_wanted;
    const task::Progress &m_progress;
    std::optional<std::size_t> m_seriesInStudy, m_objectsInStudy;
    bool m_invalidSeries = false, m_isSeriesListShort = false;
    std::set<std::string> m_known;
    std::vector<ShortSeries> m_short;
};

} // namespace

std::vector<std::size_t> coarseToFine(std::size_t n) {
    std::vector<std::size_t> order;
    if (n == 0)
        return order;
    std::size_t stride = 1;
    while (stride * 2 < n)
        stride *= 2;
    std::vector<bool> isTaken(n, false);
    const auto take = [&](std::size_t index) {
        if (!isTaken[index])
            order.push_back(index);
        isTaken[index] = true;
    };
    take(0);
    take(n - 1);
    for (; stride > 0; stride /= 2)
        for (std::size_t index = 0; index < n; index += stride)
            take(index);
    return order;
}

Listing listInstances(const Server &server, const Wanted &wanted, const task::Progress &progress) {
    return withLogin(server, progress, [&](const network::Peer &peer) {
        network::Link link({.peer = peer, .purpose = network::Purpose::find}, progress);
        return Lister(link, wanted, progress).list();
    });
}

} // namespace pellucid::archive
