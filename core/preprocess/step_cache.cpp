// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/step_cache.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "core/preprocess/edges.h"
#include "core/preprocess/filters.h"
#include "core/task/error.h"

namespace pellucid::preprocess {

namespace {

using classify::ClassSamples;
using classify::DensityKind;
using classify::Region;
using classify::Step;
using classify::TissueClass;
using Regions = std::shared_ptr<const std::vector<Region>>;

// A 64-bit digest of the samples, whatever the number of threads: blocks are mixed with where they
// stand, and added.
std::uint64_t digest(const std::byte *bytes, std::size_t count) {
    constexpr std::size_t block = 1 << 16;
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15U;
    const std::size_t blocks = (count + block - 1) / block;
    return count + tbb::parallel_reduce(
                       tbb::blocked_range<std::size_t>(0, blocks), std::uint64_t(0),
                       [&](const tbb::blocked_range<std::size_t> &range, std::uint64_t sum) {
                           for (std::size_t b = range.begin(); b != range.end(); ++b) {
                               std::uint64_t hash = (b + 1) * factor;
                               const std::size_t end = std::min(count, (b + 1) * block);
                               for (std::size_t n = b * block; n < end; n += 8) {
                                   std::uint64_t word = 0;
                                   std::memcpy(&word, bytes + n, std::min<std::size_t>(8, end - n));
                                   hash = (hash ^ word) * factor;
                                   hash ^= hash >> 29;
                               }
                               sum += hash;
                           }
                           return sum;
                       },
                       std::plus<>());
}

std::string identity(const volume::Volume &volume) {
    const volume::Lattice &l = volume.lattice();
    const std::uint64_t samples = volume.visit([](auto s) {
        const auto bytes = std::as_bytes(s);
        return digest(bytes.data(), bytes.size());
    });
    std::string text = fmt::format("{:016x} {}x{}x{} {}", samples, l.size().i, l.size().j,
                                   l.size().k, int(volume.unit()));
    for (int d = 0; d < 3; ++d)
        text += fmt::format(" {},{},{}", l.step(d).x, l.step(d).y, l.step(d).z);
    return text;
}

// The samples that belong to a class so far, by more than half.
Mask belonging(const volume::Volume &values, const TissueClass &tissue, const Regions &regions) {
    Mask mask(values.lattice().size().count());
    values.visit([&](auto samples) {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, mask.size(), 1 << 16), [&](const auto &range) {
                for (std::size_t n = range.begin(); n != range.end(); ++n) {
                    const Region where = regions ? (*regions)[n] : Region::inside;
                    mask[n] =
                        where == Region::filled ||
                        (where == Region::inside && tissue.membership(double(samples[n])) >= 0.5);
                }
            });
    });
    return mask;
}

// A part of what belonged to the class, with the rim in which its membership fades. What was
// outside before stays outside, and gaps that were filled stay filled.
std::vector<Region> partOf(const volume::Lattice &lattice, const Mask &before, const Mask &kept,
                           const Regions &former) {
    const volume::GridSize size = lattice.size();
    std::vector<Region> regions(kept.size(), Region::outside);
    tbb::parallel_for(0, size.k, [&](int k) {
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const std::size_t n = (std::size_t(k) * size.j + j) * size.i + i;
                const Region was = former ? (*former)[n] : Region::inside;
                bool touches = kept[n] != 0;
                if (!touches && before[n] == 0 && was != Region::outside)
                    for (int z = std::max(k - 1, 0); z <= std::min(k + 1, size.k - 1); ++z)
                        for (int y = std::max(j - 1, 0); y <= std::min(j + 1, size.j - 1); ++y)
                            for (int x = std::max(i - 1, 0); x <= std::min(i + 1, size.i - 1); ++x)
                                touches = touches ||
                                          kept[(std::size_t(z) * size.j + y) * size.i + x] != 0;
                if (touches)
                    regions[n] = was;
            }
    });
    return regions;
}

std::vector<Region> insideOf(const Mask &mask) {
    std::vector<Region> regions(mask.size());
    std::transform(mask.begin(), mask.end(), regions.begin(),
                   [](std::uint8_t m) { return m != 0 ? Region::inside : Region::outside; });
    return regions;
}

volume::Volume changedValues(const volume::Volume &values, const Step &step,
                             const task::Progress &progress) {
    if (step.kind == "gaussian")
        return gaussian(values, step.at("sigma_mm"), progress);
    if (step.kind == "median")
        return median(values, step.at("radius_mm"), progress);
    if (step.kind == "diffusion")
        return diffusion(values, int(step.at("iterations")), step.at("conductance"), progress);
    const double sigma = step.at("sigma_mm");
    return gradientMagnitude(sigma > 0.0 ? gaussian(values, sigma, progress.part(0.0, 0.8))
                                         : values,
                             progress.part(0.8, 1.0));
}

// Whether what a step finds depends on the class, not on the values alone.
bool looksAtClass(const Step &step) {
    return step.kind == "opening" || step.kind == "closing" || step.kind == "largest";
}

std::vector<Region> foundRegions(const volume::Volume &values, const Step &step,
                                 const TissueClass &tissue, const Regions &before,
                                 const task::Progress &progress) {
    const volume::Lattice &lattice = values.lattice();
    if (step.kind == "edges") {
        const CannyOptions options{step.at("sigma_mm"), step.at("low"), step.at("high")};
        return insideOf(step.at("itk") == 1.0 ? cannyEdgesByItk(values, options, progress)
                                              : cannyEdges(values, options, progress));
    }
    if (step.kind == "binarise") {
        Mask mask(lattice.size().count());
        const double from = step.at("from");
        values.visit([&](auto samples) {
            for (std::size_t n = 0; n < mask.size(); ++n)
                mask[n] = double(samples[n]) >= from;
        });
        return insideOf(mask);
    }
    if (step.kind == "body")
        return insideOf(body(values, step.at("margin_mm"), progress));
    if (step.kind == "skin")
        return insideOf(skin(values, step.at("depth_mm"), step.at("margin_mm"), progress));
    if (step.kind == "threshold") {
        Mask mask(lattice.size().count());
        const double low = step.at("low"), high = step.at("high");
        values.visit([&](auto samples) {
            for (std::size_t n = 0; n < mask.size(); ++n)
                mask[n] = double(samples[n]) >= low && double(samples[n]) <= high;
        });
        return insideOf(mask);
    }
    const Mask now = belonging(values, tissue, before);
    if (step.kind == "largest")
        return partOf(lattice, now, largestPart(lattice, now, step.at("share"), progress), before);
    const double radius = step.at("radius_mm");
    if (step.kind == "opening")
        return partOf(lattice, now,
                      step.at("itk") == 1.0 ? openingByItk(lattice, now, radius, progress)
                                            : opening(lattice, now, radius, progress),
                      before);
    const Mask closed = step.at("itk") == 1.0 ? closingByItk(lattice, now, radius, progress)
                                              : closing(lattice, now, radius, progress);
    std::vector<Region> regions =
        before ? *before : std::vector<Region>(closed.size(), Region::inside);
    for (std::size_t n = 0; n < closed.size(); ++n)
        if (closed[n] != 0 && now[n] == 0)
            regions[n] = Region::filled;
    return regions;
}

// What both leave.
Regions both(const Regions &a, const Regions &b) {
    if (!a)
        return b;
    std::vector<Region> joined(a->size());
    for (std::size_t n = 0; n < joined.size(); ++n)
        joined[n] = (*a)[n] == Region::outside || (*b)[n] == Region::outside
                        ? Region::outside
                        : std::max((*a)[n], (*b)[n]);
    return std::make_shared<const std::vector<Region>>(std::move(joined));
}

} // namespace

struct StepCache::Store {
    using Value = std::variant<volume::Volume, Regions>;
    struct Entry {
        std::string key;
        Value value;
        std::size_t bytes;
    };

    template <class T, class Make> T find(const std::string &key, const Make &make) {
        {
            const std::lock_guard lock(mutex);
            const auto found = std::find_if(entries.begin(), entries.end(),
                                            [&](const Entry &e) { return e.key == key; });
            if (found != entries.end()) {
                entries.splice(entries.begin(), entries, found);
                return std::get<T>(entries.front().value);
            }
        }
        T made = make();
        const std::lock_guard lock(mutex);
        ++computed;
        std::size_t size = 0;
        if constexpr (std::is_same_v<T, volume::Volume>)
            size = made.bytes();
        else
            size = made->size();
        entries.push_front({key, made, size});
        bytes += size;
        drop(budget);
        return made;
    }
    void drop(std::size_t most) {
        while (bytes > most && !entries.empty()) {
            bytes -= entries.back().bytes;
            entries.pop_back();
        }
    }

    mutable std::mutex mutex;
    std::size_t budget = 0, bytes = 0, computed = 0;
    std::list<Entry> entries; ///< used last first
};

StepCache::StepCache(std::size_t budgetBytes) : m_store(std::make_unique<Store>()) {
    m_store->budget = budgetBytes;
}
StepCache::~StepCache() = default;

std::size_t StepCache::bytes() const {
    const std::lock_guard lock(m_store->mutex);
    return m_store->bytes;
}

std::size_t StepCache::computedCount() const {
    const std::lock_guard lock(m_store->mutex);
    return m_store->computed;
}

void StepCache::trim(std::size_t budgetBytes) {
    const std::lock_guard lock(m_store->mutex);
    m_store->drop(budgetBytes);
}

ClassSamples StepCache::run(const volume::Volume &volume, const TissueClass &tissue,
                            const task::Progress &progress) {
    ClassSamples result{volume, DensityKind::window, nullptr};
    task::orOutOfMemory(task::because::noMemoryForTheSteps(tissue.name), [&] {
        std::string valuesKey = identity(volume), regionsKey;
        for (std::size_t n = 0; n < tissue.steps.size(); ++n) {
            const Step &step = tissue.steps[n];
            const task::Progress part =
                progress.part(double(n) / tissue.steps.size(), double(n + 1) / tissue.steps.size());
            const std::string text = " | " + classify::stepText(step);
            if (classify::stepKind(step.kind).effect == classify::StepEffect::values) {
                valuesKey += text;
                result.values = m_store->find<volume::Volume>(
                    valuesKey, [&] { return changedValues(result.values, step, part); });
                if (step.kind == "gradient")
                    result.density = DensityKind::range;
                continue;
            }
            std::string key = valuesKey + text;
            if (looksAtClass(step))
                key += fmt::format(" of {} {} {} {}", tissue.low, tissue.high, tissue.softness,
                                   regionsKey);
            const Regions found = m_store->find<Regions>(key, [&] {
                return std::make_shared<const std::vector<Region>>(
                    foundRegions(result.values, step, tissue, result.regions, part));
            });
            // What looks at the class has seen the regions before it.
            result.regions = looksAtClass(step) ? found : both(result.regions, found);
            regionsKey += text;
            if (step.kind == "edges" || step.kind == "binarise")
                result.density = DensityKind::one;
        }
    });
    return result;
}

} // namespace pellucid::preprocess
