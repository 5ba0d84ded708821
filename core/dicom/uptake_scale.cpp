// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/uptake_scale.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>

#include "core/dicom/reasons.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using decoding::InstanceHeader;
using decoding::PetHeader;
using volume::ValueUnit;

constexpr double secondsPerDay = 86400.0;
// A clock or a date is wrong if less than a thousandth of the activity is left.
constexpr double maxHalfLives = 10.0;
// A typing error, such as grams in place of kilograms, would give plausible pictures with wrong
// values.
constexpr double minWeightKg = 0.5, maxWeightKg = 500.0;
// Some writers state MBq or kBq. Animals get less than humans.
constexpr double minInjectedBq = 1e5, minHumanBq = 1e6, humanKg = 20.0, maxInjectedBq = 1e11;
// The date of an injection that is further away has been changed by an anonymiser.
constexpr double maxStatedDays = 60.0;
// With a longer half-life, an injection without a date may have been days earlier.
constexpr double longestWithoutDateS = 4.0 * 3600.0;

UptakeScale refused(ValueUnit unit, double factor, const task::Reason &reason) {
    return {unit, factor, reason};
}

// The first `count` characters from `at` as a number; nothing if they are not digits.
std::optional<int> digits(const std::string &text, std::size_t at, std::size_t count) {
    if (text.size() < at + count)
        return std::nullopt;
    int number = 0;
    for (const char c : text.substr(at, count)) {
        if (c < '0' || c > '9')
            return std::nullopt;
        number = 10 * number + (c - '0');
    }
    return number;
}

// Seconds east of UTC of "+HHMM" or "-HHMM" at the end of a text; nothing if there is none.
std::optional<double> zoneOf(const std::string &text) {
    const auto sign = text.find_first_of("+-");
    if (sign == std::string::npos)
        return std::nullopt;
    const auto hours = digits(text, sign + 1, 2), minutes = digits(text, sign + 3, 2);
    if (!hours || !minutes)
        return std::nullopt;
    return (text[sign] == '-' ? -1.0 : 1.0) * (3600.0 * *hours + 60.0 * *minutes);
}

// The injection as its date and time state it, in the time zone of the file; nothing if that is not
// known.
std::optional<double> statedInjection(const PetHeader &pet) {
    const std::string local =
        pet.injectionDateTime.substr(0, pet.injectionDateTime.find_first_of("+-"));
    if (local.size() <= 8)
        return std::nullopt;
    auto at = secondsAt(local.substr(0, 8), local.substr(8));
    const auto zone = zoneOf(pet.injectionDateTime), zoneOfFile = zoneOf(pet.timezone);
    if (at && zone && zoneOfFile)
        *at += *zoneOfFile - *zone;
    else if (zone && !zoneOfFile && pet.injectionTime.empty())
        return std::nullopt; // the other times may be of another zone
    return at;
}

// The difference of two times of day, from -12 to 12 hours.
double betweenTimesOfDay(double a, double b) {
    return std::remainder(a - b, secondsPerDay);
}

// Half-lives from the injection to `referenceS`, slightly negative if a dynamic scan began before
// the injection; nothing if the times are missing or contradictory.
std::optional<double> halfLivesSince(const PetHeader &pet, double referenceS) {
    const double mostBeforeS = pet.isDynamic ? std::min(1800.0, pet.halfLifeS) : 0.0;
    constexpr double sameS = 60.0;
    const auto accepted = [&](double at) -> std::optional<double> {
        const double halfLives = (referenceS - at) / pet.halfLifeS;
        if (referenceS - at >= -mostBeforeS && halfLives <= maxHalfLives)
            return halfLives;
        return std::nullopt;
    };
    const auto stated = statedInjection(pet);
    const auto ofDay = secondsAt(pet.seriesDate, pet.injectionTime);
    if (stated && std::abs(referenceS - *stated) < maxStatedDays * secondsPerDay) {
        if (ofDay && std::abs(betweenTimesOfDay(*stated, *ofDay)) > sameS)
            return std::nullopt; // two statements, one of which is wrong
        if (const auto halfLives = accepted(*stated))
            return halfLives;
    }
    // Anonymisers shift some dates and forget others, but keep the times of day. Such a time
    // belongs to the day of the series or to the night before; which one is clear for short
    // half-lives only.
    if (pet.halfLifeS > longestWithoutDateS)
        return std::nullopt;
    if (!ofDay && !stated)
        return std::nullopt;
    const double nearest = referenceS + betweenTimesOfDay(ofDay ? *ofDay : *stated, referenceS);
    return accepted(nearest > referenceS + mostBeforeS ? nearest - secondsPerDay : nearest);
}

// When the scan of an image began, to which the values are decay-corrected: the image refers to a
// moment of its frame at which the activity is the frame's mean.
double scanBegin(const PetHeader &pet, double acquisitionS) {
    double meanS = 0.0;
    if (pet.frameDurationS > 0.0 && pet.halfLifeS > 0.0) {
        const double decay = std::log(2.0) * pet.frameDurationS / pet.halfLifeS;
        meanS = pet.frameDurationS / decay * std::log(decay / -std::expm1(-decay));
    }
    return pet.frameReferenceS > meanS ? acquisitionS - pet.frameReferenceS + meanS : acquisitionS;
}

// The time that the values' decay correction refers to. A series that was reconstructed later
// carries the time of that reconstruction; its scan then began earlier. Nothing if the times
// contradict each other, as dates that do not change at midnight do.
std::optional<double> decayReference(const std::vector<const InstanceHeader *> &files) {
    constexpr double longestScanS = 12.0 * 3600.0, sameBeginS = 60.0;
    const auto series = secondsAt(files.front()->pet->seriesDate, files.front()->pet->seriesTime);
    std::optional<double> first, last, begin, lastBegin;
    for (const InstanceHeader *const h : files)
        if (const auto at = secondsAt(h->pet->acquisitionDate, h->pet->acquisitionTime)) {
            first = first ? std::min(*first, *at) : at;
            last = last ? std::max(*last, *at) : at;
            const double scan = scanBegin(*h->pet, *at);
            begin = begin ? std::min(*begin, scan) : scan;
            lastBegin = lastBegin ? std::max(*lastBegin, scan) : scan;
        }
    if (!first)
        return series;
    if (*last - *first > longestScanS)
        return std::nullopt;
    // A date of the series that is days off has been changed by an anonymiser.
    if (series && *series <= *first && *first - *series <= longestScanS)
        return series;
    // Frame Reference Times are used only if all of them tell the same.
    return *lastBegin - *begin <= sameBeginS ? begin : first;
}

// The share of the injected activity that is left at the time which the values refer to.
std::optional<double> activityLeft(const std::vector<const InstanceHeader *> &files) {
    const PetHeader &pet = *files.front()->pet;
    if (pet.decayCorrection == "ADMIN")
        return 1.0;
    const auto reference = decayReference(files);
    if (!reference || !(pet.halfLifeS > 0.0))
        return std::nullopt;
    const auto halfLives = halfLivesSince(pet, *reference);
    return halfLives ? std::optional(std::exp2(-*halfLives)) : std::nullopt;
}

// Half-lives of the nuclides of PET. *Source*: Evaluated Nuclear Structure Data File.
struct Nuclide {
    const char *element, *mass;
    double halfLifeS;
};
constexpr Nuclide nuclides[]{
    {"luorine", "18", 6586.2}, {"arbon", "11", 1221.8},      {"itrogen", "13", 597.9},
    {"xygen", "15", 122.2},    {"allium", "68", 4062.6},     {"ubidium", "82", 75.5},
    {"opper", "64", 45724.0},  {"irconium", "89", 282276.0}, {"odine", "124", 360806.0},
};

// Some writers state minutes.
bool isHalfLifePlausible(const PetHeader &pet) {
    constexpr double tolerance = 0.05;
    for (const Nuclide &nuclide : nuclides)
        if (pet.radionuclide.find(nuclide.element) != std::string::npos &&
            pet.radionuclide.find(nuclide.mass) != std::string::npos)
            return std::abs(pet.halfLifeS / nuclide.halfLifeS - 1.0) < tolerance;
    return true; // not known here
}

// Whether everything that the scale depends on, except times of acquisition, is the same.
bool isSameScale(const PetHeader &a, const PetHeader &b) {
    const auto of = [](const PetHeader &pet) {
        return std::tie(pet.units, pet.uptakeType, pet.decayCorrection, pet.injectionTime,
                        pet.injectionDateTime, pet.radionuclide, pet.weightKg, pet.injectedBq,
                        pet.halfLifeS, pet.uptakePerCount, pet.injections, pet.isDynamic,
                        pet.corrections);
    };
    return of(a) == of(b);
}

} // namespace

std::optional<double> secondsAt(const std::string &date, const std::string &time) {
    namespace chr = std::chrono;
    const auto year = digits(date, 0, 4), month = digits(date, 4, 2), day = digits(date, 6, 2);
    const auto hour = digits(time, 0, 2);
    if (!year || !month || !day || !hour)
        return std::nullopt;
    const chr::year_month_day calendar{chr::year(*year), chr::month(unsigned(*month)),
                                       chr::day(unsigned(*day))};
    const std::size_t whole = std::min(time.size(), time.find('.'));
    const auto minute = whole >= 4 ? digits(time, 2, 2) : std::optional(0);
    const auto second = whole >= 6 ? digits(time, 4, 2) : std::optional(0);
    // Colons of an old form, or anything else, would be taken for missing parts.
    if ((whole != 2 && whole != 4 && whole != 6) || !minute || !second)
        return std::nullopt;
    if (!calendar.ok() || *hour > 23 || *minute > 59 || *second > 60)
        return std::nullopt;
    double fraction = 0.0, place = 0.1;
    if (time.size() > 7 && time[6] == '.')
        for (std::size_t at = 7; at < time.size() && digits(time, at, 1); ++at, place *= 0.1)
            fraction += place * *digits(time, at, 1);
    return double(chr::sys_days(calendar).time_since_epoch().count()) * secondsPerDay +
           3600.0 * *hour + 60.0 * *minute + *second + fraction;
}

UptakeScale uptakeScale(const std::vector<const InstanceHeader *> &files) {
    const InstanceHeader &h = *files.front();
    if (!h.pet)
        return {};
    const PetHeader &pet = *h.pet;
    const bool isSame = std::all_of(files.begin(), files.end(), [&](const InstanceHeader *other) {
        return other->pet && isSameScale(*other->pet, pet);
    });
    if (!isSame)
        return refused(pet.units == "BQML" ? ValueUnit::activity : ValueUnit::none, 1.0,
                       because::petFilesDiffer);
    const bool isActivity = pet.units == "BQML";
    const auto missing = [&](const task::Reason &reason) {
        return refused(isActivity ? ValueUnit::activity : ValueUnit::none, 1.0, reason);
    };
    const bool isUptake = pet.units == "GML";
    // Philips writes counts, with the factors in elements of its own.
    const bool isCounts = pet.units == "CNTS" && pet.uptakePerCount > 0.0;
    if (!isActivity && !isUptake && !isCounts)
        return missing(because::petUnitIs(pet.units));
    const auto isCorrectedFor = [&](const char *what) {
        return pet.corrections.find(what) != std::string::npos;
    };
    // Values that are SUV already may come from programs that drop the list of corrections.
    if (!isCorrectedFor("ATTN") && !(isUptake && pet.corrections.empty()))
        return missing(because::notAttenuationCorrected);
    if (isUptake)
        return pet.uptakeType.empty() || pet.uptakeType == "BW"
                   ? UptakeScale{ValueUnit::uptake, 1.0, std::nullopt}
                   : missing(because::uptakeIsOfType(pet.uptakeType));
    if ((pet.decayCorrection != "ADMIN" && pet.decayCorrection != "START") ||
        !isCorrectedFor("DECY"))
        return missing(because::notDecayCorrected);
    if (isCounts)
        return {ValueUnit::uptake, pet.uptakePerCount, std::nullopt};
    if (pet.injections > 1)
        return missing(because::severalInjections);
    if (!(pet.weightKg >= minWeightKg && pet.weightKg <= maxWeightKg))
        return missing(because::noPlausibleWeight);
    const double leastBq = pet.weightKg >= humanKg ? minHumanBq : minInjectedBq;
    if (!(pet.injectedBq >= leastBq && pet.injectedBq <= maxInjectedBq))
        return missing(because::noInjectedActivity);
    const bool needsHalfLife = pet.decayCorrection != "ADMIN";
    if (needsHalfLife && pet.halfLifeS > 0.0 && !isHalfLifePlausible(pet))
        return missing(because::halfLifeIsWrong);
    const auto left = activityLeft(files);
    if (!left)
        return missing(because::noDecayTime);
    constexpr double gramsPerKg = 1000.0;
    return {ValueUnit::uptake, pet.weightKg * gramsPerKg / (pet.injectedBq * *left), std::nullopt};
}

} // namespace pellucid::dicom
