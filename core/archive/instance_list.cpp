// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/instance_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/archive/login.h"
#include "core/exchange/link.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
namespace tag = exchange::tag;
using exchange::Attributes;
using exchange::Level;

// Each takes about 800 bytes while it is retrieved. The largest studies have a tenth of that.
constexpr std::uint32_t maxObjects = 100000;

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

// The place along the normal of the slices; nothing if the server does not tell.
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

// Asked for once, where the user has not been shown a patient.
Patient patientOf(exchange::Link &link, const std::string &studyUid,
                  const task::Progress &progress) {
    Patient patient;
    link.find(
        {.level = Level::study,
         .keys = {{tag::studyUid, studyUid},
                  {tag::patientName, ""},
                  {tag::patientId, ""},
                  {tag::birthDate, ""}},
         .limit = maxObjects},
        [&](const Attributes &match) {
            if (!patient.isKnown())
                patient = {textOf(match, tag::patientName), textOf(match, tag::patientId),
                           textOf(match, tag::birthDate)};
        },
        progress);
    return patient;
}

Listing listAt(const exchange::Peer &peer, const Wanted &wanted, const task::Progress &progress) {
    exchange::Link link({.peer = peer, .purpose = exchange::Purpose::find}, progress);
    const Patient patient =
        wanted.patient.isKnown() ? wanted.patient : patientOf(link, wanted.studyUid, progress);
    std::vector<std::string> seriesUids = wanted.seriesUids;
    if (seriesUids.empty()) {
        std::map<int, std::set<std::string>> byNumber;
        link.find(
            {.level = Level::series,
             .keys = {{tag::studyUid, wanted.studyUid},
                      {tag::seriesUid, ""},
                      {tag::seriesNumber, ""}},
             .limit = maxObjects},
            [&](const Attributes &match) {
                if (const std::string uid = textOf(match, tag::seriesUid); exchange::isUid(uid))
                    byNumber[numberOf(textOf(match, tag::seriesNumber))].insert(uid);
            },
            progress);
        for (const auto &[number, uids] : byNumber)
            seriesUids.insert(seriesUids.end(), uids.begin(), uids.end());
    }
    std::vector<std::vector<Instance>> bySeries;
    std::set<std::string> known;
    for (const std::string &series : seriesUids) {
        std::vector<Listed> listed;
        const exchange::QueryEnd end = link.find(
            {.level = Level::image,
             .keys = {{tag::studyUid, wanted.studyUid},
                      {tag::seriesUid, series},
                      {tag::sopInstanceUid, ""},
                      {tag::sopClassUid, ""},
                      {tag::instanceNumber, ""},
                      {tag::position, ""},
                      {tag::orientation, ""}},
             .limit = maxObjects},
            [&](const Attributes &match) {
                const std::string uid = textOf(match, tag::sopInstanceUid);
                if (!exchange::isUid(uid) || !known.insert(uid).second)
                    return;
                const std::string sopClass = textOf(match, tag::sopClassUid);
                listed.push_back({{wanted.studyUid, series, uid,
                                   exchange::isUid(sopClass) ? sopClass : std::string(),
                                   numberOf(textOf(match, tag::instanceNumber))},
                                  heightOf(match)});
            },
            progress);
        if (end.reachedLimit || known.size() > maxObjects)
            throw task::Error(task::ErrorCode::unusable,
                              because::studyHasTooManyObjects(maxObjects));
        const bool havePlaces = std::all_of(
            listed.begin(), listed.end(), [](const Listed &one) { return one.height.has_value(); });
        std::stable_sort(listed.begin(), listed.end(), [&](const Listed &a, const Listed &b) {
            return havePlaces ? *a.height < *b.height : a.instance.number < b.instance.number;
        });
        bySeries.emplace_back();
        for (Listed &one : listed)
            bySeries.back().push_back(std::move(one.instance));
    }
    // The series that is opened by default comes first.
    std::stable_sort(bySeries.begin(), bySeries.end(),
                     [](const auto &a, const auto &b) { return a.size() > b.size(); });
    std::vector<Instance> instances;
    for (std::vector<Instance> &series : bySeries)
        instances.insert(instances.end(), std::make_move_iterator(series.begin()),
                         std::make_move_iterator(series.end()));
    if (instances.empty())
        throw task::Error(task::ErrorCode::unusable, because::serverHasNoSuchStudy);
    return {std::move(instances), patient};
}

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
    return withLogin(server, progress,
                     [&](const exchange::Peer &peer) { return listAt(peer, wanted, progress); });
}

} // namespace pellucid::archive
