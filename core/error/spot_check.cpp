// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error/spot_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <queue>
#include <random>
#include <span>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/error/exact_frequencies.h"
#include "core/error/folded_tails.h"
#include "core/error/picture_slice.h"
#include "core/error/shown_part.h"
#include "core/scene/camera.h"

namespace pellucid::error {

namespace {

using Complex = std::complex<double>;

// Frequencies within so many steps of zero, and so many of the brightest, are always summed: in
// small or smooth fields they have most of the energy, and of the error of rounding.
constexpr double alwaysSteps = 3.0;
constexpr std::size_t alwaysBrightest = 100;

// No more are summed, to limit the memory for them, and so many at once.
constexpr double mostDrawn = 1 << 18;
constexpr std::size_t atOnce = 4096;

// A sine and a cosine take as long as so many multiplications: 44 ns on one thread.
constexpr double perSine = 500.0;

constexpr int tile = 16; // columns and rows that frames read with one kernel

// The limits of the interval, in standard errors: of 240 draws in six pictures of head, chest and
// MR, 1.7 % were outside; with 3, 3.7 %.
constexpr double limits = 3.5;

// A frequency of the half plane and its weight: 2 if its mirror image is another.
struct Frequency {
    int column = 0, row = 0;
    double weight = 2.0;
    double radius = 0.0; ///< 1 at the end of the band
    double energy = 0.0; ///< of the picture
    double chance = 0.0; ///< that a draw takes it
};

using Channels = std::array<Complex, 3>;

struct Energies {
    double error = 0.0, exact = 0.0, shown = 0.0;
    Energies &operator+=(const Energies &other) {
        error += other.error;
        exact += other.exact;
        shown += other.shown;
        return *this;
    }
    friend Energies operator*(double factor, const Energies &e) {
        return {factor * e.error, factor * e.exact, factor * e.shown};
    }
};

// A picture, the slice that it was made from, and what does not depend on exact values.
struct Judged {
    Judged(const picture::PeriodPicture &of, const scene::ImageDefinition &image,
           const ShownRows &rows, const task::Progress &progress)
        : period(of), slice(of, progress), folded(foldedTails(of, slice, image, rows.lattice())),
          share(
              std::max(shownShare(rows.box(), rows.lattice(), of.shownCamera()),
                       double(of.width) * of.height / (double(of.image.width) * of.image.height))),
          mayStandForFiner(of.camera.pixelMm <= scene::finestPixelMm(rows.lattice())) {
        progress.check();
        slice.forEach([&](int column, int row, double weight, double radius) {
            (radius < 1.0 ? inBand : beyondBand) += weight * slice.energy(column, row);
        });
    }
    const picture::PeriodPicture &period;
    PictureSlice slice;
    FoldedTails folded;
    /// The share of the error to expect in the shown part. Aliases are where the body is, and
    /// rounding is everywhere in the period.
    double share;
    /// Smaller pixels are not checked, see `prepare::checkedCamera`: they show the same part, but
    /// not the same places of it.
    bool mayStandForFiner;
    double inBand = 0.0, beyondBand = 0.0; ///< energies; beyond the band, everything is an error
};

// The frequencies of a view, and their exact values.
struct Sums {
    struct Term {
        Frequency at;
        Channels exact{};
    };
    bool isComplete = false;
    std::vector<Term> always; ///< all of them, if complete
    std::vector<Term> drawn;  ///< in pairs, each from a stratum of the same chance

    int count() const { return int(always.size() + drawn.size()); }
    struct Estimate {
        StatedError error;
        double width = 1.0; ///< the factor from the sampled energy of the error to its limits
    };
    Estimate errorOf(const Judged &picture) const;
};

class Sampler {
public:
    Sampler(const picture::PeriodPicture &period, const scene::ImageDefinition &image,
            const ShownRows &rows, const CheckEffort &effort, const task::Progress &progress)
        : m_judged(period, image, rows, progress), m_image(image), m_rows(rows), m_effort(effort),
          m_random(effort.seed) {}

    StatedError run(const task::Progress &progress,
                    const std::function<void(const StatedError &)> &refined) {
        Sums sums;
        std::vector<Frequency> all = frequenciesOfBand();
        const volume::GridSize size = m_rows.box().size();
        const double perFrequency = double(size.count()) * m_rows.images() +
                                    perSine * (double(size.i) / 2.0 + size.j + size.k),
                     paid = m_effort.multiplications / perFrequency;
        const int affordable = int(std::min(paid, mostDrawn));
        // A whole number of pairs in each round.
        const int most = std::max(m_effort.atLeast, affordable) / 8 * 8;
        // Drawing half of a few takes about as long as summing them all.
        sums.isComplete = all.size() <= std::size_t(std::max(m_effort.atLeast, 2 * affordable));
        if (sums.isComplete) {
            add(all, sums.always, progress);
            return sums.errorOf(m_judged).error;
        }
        divide(all);
        progress.check();
        for (int done = 0, count = most / 4;; done = count, count *= 2) {
            count = std::min(count, most);
            // Those that are always summed, and the first draw, are read together.
            std::vector<Frequency> next = std::exchange(all, {});
            const std::size_t always = next.size();
            for (const Frequency &drawn : draw((count - done) / 2))
                next.push_back(drawn);
            std::vector<Sums::Term> terms;
            add(next, terms, progress.part(double(done) / most, double(count) / most));
            const auto firstDrawn = terms.begin() + std::ptrdiff_t(always);
            sums.always.insert(sums.always.end(), terms.begin(), firstDrawn);
            sums.drawn.insert(sums.drawn.end(), firstDrawn, terms.end());
            const auto [error, width] = sums.errorOf(m_judged);
            if (count == most || std::sqrt(width) <= 1.0 + m_effort.within ||
                error.high <= m_effort.enough)
                return error;
            if (refined)
                refined(error);
        }
    }

private:
    // In order of the tiles that frames read with one kernel, so that neighbours are alike.
    std::vector<Frequency> frequenciesOfBand() const {
        const PictureSlice &slice = m_judged.slice;
        const int across = slice.columns() / 2 / tile + 1, half = slice.rows() / 2 / tile + 1;
        const auto visit = [&](const auto &use) {
            slice.forEach([&](int column, int row, double weight, double radius) {
                if (radius < 1.0) // tiles begin at row 0, counted along V
                    use(Frequency{column, row, weight, radius},
                        std::size_t((half * tile - row) / tile * across + column / tile));
            });
        };
        std::vector<std::size_t> next(std::size_t(2 * half + 1) * std::size_t(across) + 1);
        visit([&](const Frequency &, std::size_t at) { ++next[at + 1]; });
        std::partial_sum(next.begin(), next.end(), next.begin());
        std::vector<Frequency> all(next.back());
        visit([&](Frequency f, std::size_t at) {
            f.energy = slice.energy(f.column, f.row);
            all[next[at]++] = f;
        });
        return all;
    }

    // Leaves those that are always summed in `all`, and keeps the others to draw from.
    void divide(std::vector<Frequency> &all) {
        const auto isNearZero = [](const Frequency &f) {
            return double(f.column) * f.column + double(f.row) * f.row <= alwaysSteps * alwaysSteps;
        };
        // A min-heap: the darkest of the brightest is on top.
        using Bright = std::pair<double, std::size_t>;
        std::priority_queue<Bright, std::vector<Bright>, std::greater<>> brightest;
        std::vector<Frequency> always;
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (isNearZero(all[n])) {
                always.push_back(all[n]);
                all[n].weight = 0.0;
            } else if (brightest.size() < alwaysBrightest ||
                       all[n].energy > brightest.top().first) {
                brightest.emplace(all[n].energy, n);
                if (brightest.size() > alwaysBrightest)
                    brightest.pop();
            }
        }
        for (; !brightest.empty(); brightest.pop()) {
            Frequency &bright = all[brightest.top().second];
            always.push_back(bright);
            bright.weight = 0.0;
        }
        std::erase_if(all, [](const Frequency &f) { return f.weight == 0.0; });
        m_others = std::exchange(all, std::move(always));
        tbb::parallel_for(std::size_t(0), m_others.size(), [&](std::size_t n) {
            Frequency &f = m_others[n];
            f.chance = std::sqrt(m_judged.slice.energyAround(f.column, f.row));
        });
        double around = 0.0;
        for (const Frequency &f : m_others)
            around += f.chance;
        const double even = 1.0 / double(m_others.size());
        for (Frequency &f : m_others)
            f.chance = 0.5 * even + 0.5 * (around > 0.0 ? f.chance / around : even);
    }

    std::vector<Frequency> draw(int pairs) {
        std::uniform_real_distribution<double> even;
        std::vector<double> places;
        for (int pair = 0; pair < pairs; ++pair) {
            const double a = (pair + even(m_random)) / pairs, b = (pair + even(m_random)) / pairs;
            places.push_back(std::min(a, b));
            places.push_back(std::max(a, b));
        }
        std::vector<Frequency> taken;
        double passed = 0.0;
        std::size_t next = 0;
        for (const double place : places) {
            while (next + 1 < m_others.size() && passed + m_others[next].chance <= place)
                passed += m_others[next++].chance;
            taken.push_back(m_others[next]);
        }
        return taken;
    }

    // P of the samples, by channel.
    void add(const std::vector<Frequency> &frequencies, std::vector<Sums::Term> &terms,
             const task::Progress &progress) const {
        const double count = double(frequencies.size());
        for (std::size_t first = 0; first < frequencies.size(); first += atOnce) {
            const std::size_t last = std::min(first + atOnce, frequencies.size());
            addTogether(std::span(frequencies).subspan(first, last - first), terms,
                        progress.part(double(first) / count, double(last) / count));
        }
    }

    void addTogether(std::span<const Frequency> frequencies, std::vector<Sums::Term> &terms,
                     const task::Progress &progress) const {
        const PictureSlice &slice = m_judged.slice;
        const glm::dmat3 axes = m_judged.period.camera.axes();
        const volume::Lattice &lattice = m_rows.lattice();
        std::vector<glm::dvec3> at;
        for (const Frequency &f : frequencies)
            at.push_back(slice.columnPerMm() * f.column * axes[0] -
                         slice.rowPerMm() * f.row * axes[1]);
        const auto sums = exactFrequencies(m_rows, at, progress);
        for (std::size_t n = 0; n < frequencies.size(); ++n) {
            double factor = scene::rollOffFactor(m_image.rollOff, frequencies[n].radius) *
                            scene::detailFactor(m_image, glm::length(at[n]));
            for (int d = 0; d < 3; ++d)
                factor *= scene::reconstructionFactor(m_image, glm::dot(lattice.step(d), at[n]));
            Sums::Term term{frequencies[n], {}};
            for (std::size_t image = 0; image < sums.size(); ++image)
                for (int c = 0; c < slice.channels(); ++c)
                    term.exact[std::size_t(c)] +=
                        factor * m_rows.share(int(image), c) * sums[image][n];
            terms.push_back(term);
        }
    }

    const Judged m_judged;
    const scene::ImageDefinition &m_image;
    const ShownRows &m_rows;
    const CheckEffort &m_effort;
    std::mt19937 m_random;
    std::vector<Frequency> m_others;
};

Energies energiesOf(const PictureSlice &slice, const Sums::Term &term) {
    Energies energies;
    for (int c = 0; c < slice.channels(); ++c) {
        const Complex shown = slice.value(c, term.at.column, term.at.row),
                      truth = term.exact[std::size_t(c)];
        energies += {std::norm(shown - truth), std::norm(truth), std::norm(shown)};
    }
    return energies;
}

Sums::Estimate Sums::errorOf(const Judged &picture) const {
    const PictureSlice &slice = picture.slice;
    const double whole = picture.inBand;
    Energies all{.error = picture.beyondBand};
    for (const Term &term : always)
        all += term.at.weight * energiesOf(slice, term);
    Energies sum;
    double variance = 0.0;
    for (std::size_t n = 0; n + 1 < drawn.size(); n += 2) {
        const auto weighted = [&](const Term &term) {
            return term.at.weight / term.at.chance * energiesOf(slice, term);
        };
        const Energies a = weighted(drawn[n]), b = weighted(drawn[n + 1]);
        sum += a;
        sum += b;
        // The sum of a pair has this variance.
        variance += (a.error - b.error) * (a.error - b.error);
    }
    double width = 1.0;
    // Energies in the part that is shown.
    double error = 0.0, low = 0.0, high = 0.0, truth = 0.0;
    const bool isPart = picture.share < 1.0,
               areKnown = isComplete && !(isPart && picture.mayStandForFiner);
    if (areKnown) {
        // Where every frequency is known, so is every pixel.
        for (int c = 0; c < slice.channels(); ++c) {
            const auto energies = slice.energiesInPart(c, picture.period, [&](const auto &set) {
                for (const Term &term : always)
                    set(term.at.column, term.at.row, term.exact[std::size_t(c)]);
            });
            error += energies.error;
            truth += energies.exact;
        }
        low = high = error;
    } else {
        const double draws = std::max(1.0, double(drawn.size()));
        all += (1.0 / draws) * sum;
        // Sums of a few large terms are skewed: their logarithm is nearly normal.
        const double share = all.error > 0.0 ? std::sqrt(variance) / draws / all.error : 0.0,
                     shown = PictureSlice::energyInPart(picture.period);
        width = std::exp(limits * std::sqrt(std::log1p(share * share)));
        const double everywhere = slice.energyUnit() * all.error;
        // A part of the error may lie beside the part that is shown, within the period: no more
        // than is there.
        low = std::max(0.0, everywhere / width - (slice.wholeEnergy() - shown));
        high = everywhere * width;
        error = std::max(low, picture.share * everywhere);
        // The energy of the picture, corrected by that of the frequencies.
        truth = whole > 0.0 ? shown * std::max(whole + all.exact - all.shown, 0.0) / whole : shown;
    }
    // No frequency of the period contains what folds back into it.
    const FoldedTails &folded = picture.folded;
    // The picture of the period is rounded otherwise than the shown one: a transform in float has
    // an error of at most 2^-24 a step.
    const double rounding = std::ldexp(std::log2(double(slice.columns()) * slice.rows()), -24) *
                            std::sqrt(slice.wholeEnergy());
    const double most = std::sqrt(folded.most) + rounding;
    // All of a repeated pixel is error: the field is not there.
    const double repeated = PictureSlice::repeatedEnergy(picture.period);
    const auto relative = [](double energy, double exact) {
        constexpr double largest = StatedError::largest;
        return energy > 0.0 ? std::sqrt(energy / std::max(exact, energy / (largest * largest)))
                            : 0.0;
    };
    // Whether the two add up or cancel is not known.
    const double least = std::max(0.0, std::sqrt(low) - most), greatest = std::sqrt(high) + most;
    // The truth of a part is known from the picture, up to the error, or from the frequencies, up
    // to what folds back.
    const double unknown = !isPart    ? 0.0
                           : areKnown ? most
                                      : greatest,
                 leastTruth = std::pow(std::max(0.0, std::sqrt(truth) - unknown), 2),
                 greatestTruth = std::pow(std::sqrt(truth) + unknown, 2);
    return {{relative(error + folded.expected + repeated, truth), StatedError::Kind::measured,
             relative(least * least, greatestTruth),
             relative(greatest * greatest + repeated, leastTruth), count()},
            width};
}

} // namespace

StatedError spotCheck(const picture::PeriodPicture &period, const scene::ImageDefinition &image,
                      const ShownRows &rows, const CheckEffort &effort,
                      const task::Progress &progress,
                      const std::function<void(const StatedError &)> &refined) {
    return Sampler(period, image, rows, effort, progress).run(progress, refined);
}

} // namespace pellucid::error
