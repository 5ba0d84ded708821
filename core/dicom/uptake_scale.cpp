// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/uptake_scale.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using decoder::InstanceHeader;
using decoder::PetHeader;
using volume::ValueUnit;

constexpr double secondsPerDay = 86400.0;
// A clock or a date is wrong if less than a thousandth of the activity is left.
constexpr double maxHalfLives = 10.0;
// A typing error, such as grams in place of kilograms, would give plausible pictures with wrong
// values.
constexpr double minWeightKg = 0.5, maxWeightKg = 500.0;
// Some writers state MBq.
constexpr double minInjectedBq = 1e5, maxInjectedBq = 1e11;

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

// When the radiopharmaceutical may have been injected, the best statement first. A time without a
// date belongs to the day of the series or, if it is later than `referenceS`, to the day before.
// Anonymisers shift some dates and forget others, but keep the times of day.
std::vector<double> injectionsOf(const PetHeader &pet, double referenceS) {
    std::vector<double> found;
    std::string time = pet.injectionTime;
    // With an offset from UTC it is in another zone than the times of the series may be.
    const bool hasZone = pet.injectionDateTime.find_first_of("+-") != std::string::npos;
    if (pet.injectionDateTime.size() > 8 && !hasZone) {
        const std::string ofDay = pet.injectionDateTime.substr(8);
        if (const auto at = secondsAt(pet.injectionDateTime.substr(0, 8), ofDay))
            found.push_back(*at);
        if (time.empty())
            time = ofDay;
    }
    if (const auto at = secondsAt(pet.seriesDate, time))
        found.push_back(*at > referenceS ? *at - secondsPerDay : *at);
    return found;
}

// The time that the values' decay correction refers to. A series that was reconstructed later
// carries the time of that reconstruction; its acquisitions then began earlier.
std::optional<double> decayReference(const std::vector<const InstanceHeader *> &files) {
    const auto series = secondsAt(files.front()->pet->seriesDate, files.front()->pet->seriesTime);
    std::optional<double> first;
    for (const InstanceHeader *const h : files)
        if (const auto at = secondsAt(h->pet->acquisitionDate, h->pet->acquisitionTime))
            first = first ? std::min(*first, *at) : at;
    if (series && first)
        return std::min(*series, *first);
    return series ? series : first;
}

// The share of the injected activity that is left at the time which the values refer to.
std::optional<double> activityLeft(const std::vector<const InstanceHeader *> &files) {
    const PetHeader &pet = *files.front()->pet;
    if (pet.decayCorrection == "ADMIN")
        return 1.0;
    const auto reference = decayReference(files);
    if (!reference || !(pet.halfLifeS > 0.0))
        return std::nullopt;
    for (const double injection : injectionsOf(pet, *reference))
        if (const double halfLives = (*reference - injection) / pet.halfLifeS;
            halfLives >= 0.0 && halfLives <= maxHalfLives)
            return std::exp2(-halfLives);
    return std::nullopt;
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
        return other->pet && other->pet->units == pet.units &&
               other->pet->weightKg == pet.weightKg && other->pet->injectedBq == pet.injectedBq &&
               other->pet->uptakePerCount == pet.uptakePerCount;
    });
    if (!isSame)
        return refused(pet.units == "BQML" ? ValueUnit::activity : ValueUnit::none, 1.0,
                       because::petFilesDiffer);
    if (pet.units == "GML") {
        if (pet.uptakeType.empty() || pet.uptakeType == "BW")
            return {ValueUnit::uptake, 1.0, std::nullopt};
        return refused(ValueUnit::none, 1.0, because::uptakeIsOfType(pet.uptakeType));
    }
    // Philips writes counts, with the factors in elements of its own.
    if (pet.units == "CNTS" && pet.uptakePerCount > 0.0)
        return {ValueUnit::uptake, pet.uptakePerCount, std::nullopt};
    if (pet.units != "BQML")
        return refused(ValueUnit::none, 1.0, because::petUnitIs(pet.units));
    const auto lacking = [](const task::Reason &reason) {
        return refused(ValueUnit::activity, 1.0, reason);
    };
    if (!(pet.weightKg >= minWeightKg && pet.weightKg <= maxWeightKg))
        return lacking(because::noPlausibleWeight);
    if (!(pet.injectedBq >= minInjectedBq && pet.injectedBq <= maxInjectedBq))
        return lacking(because::noInjectedActivity);
    if (!pet.isAttenuationCorrected)
        return lacking(because::notAttenuationCorrected);
    if (pet.decayCorrection != "ADMIN" && pet.decayCorrection != "START")
        return lacking(because::notDecayCorrected);
    const auto left = activityLeft(files);
    if (!left)
        return lacking(because::noDecayTime);
    constexpr double gramsPerKg = 1000.0;
    return {ValueUnit::uptake, pet.weightKg * gramsPerKg / (pet.injectedBq * *left), std::nullopt};
}

} // namespace pellucid::dicom
