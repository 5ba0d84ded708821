// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/shown_fields.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <new>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/task/error.h"

namespace pellucid::classify {

namespace {

// sums += factor * field, sample by sample.
void add(std::vector<float> &sums, const DensityField &field, double factor) {
    field.values.visit([&](auto samples) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sums.size(), 1 << 16),
                          [&](const tbb::blocked_range<std::size_t> &range) {
                              for (std::size_t n = range.begin(); n != range.end(); ++n)
                                  sums[n] += float(factor) * float(samples[n]);
                          });
    });
}

// A class without weight is not computed.
std::vector<TissueClass> visible(const Look &look) {
    std::vector<TissueClass> shown;
    std::copy_if(look.classes.begin(), look.classes.end(), std::back_inserter(shown),
                 [](const TissueClass &tissue) { return tissue.weight > 0.0; });
    return shown;
}

bool haveOneColor(const std::vector<TissueClass> &classes) {
    return std::all_of(classes.begin(), classes.end(), [&](const TissueClass &tissue) {
        return tissue.color == classes.front().color;
    });
}

} // namespace

bool mixesColors(const Look &look) {
    return !haveOneColor(visible(look));
}

bool isGrey(const Look &look) {
    const std::vector<TissueClass> shown = visible(look);
    return shown.empty() || (haveOneColor(shown) && shown.front().color == Color{});
}

std::size_t peakBytes(const Look &look, std::size_t samples) {
    // A class is made of its density, that weighted, and itself.
    const std::size_t fields = look.classes.empty() ? look.transferFunction.isPlain() ? 1 : 2
                               : haveOneColor(visible(look)) ? 4
                                                             : 6;
    return fields * samples * sizeof(float);
}

void validate(const Look &look) {
    validate(look.transferFunction);
    for (const TissueClass &tissue : look.classes)
        validate(tissue);
}

ShownFields shownFields(const volume::Volume &volume, const FieldWindow &window, const Look &look,
                        const task::Progress &progress) {
    const DensityField density = densityField(volume, window, progress.part(0.0, 0.3));
    if (look.classes.empty()) {
        if (look.transferFunction.isPlain())
            return {{density}, {}};
        return {{weighted(density, look.transferFunction, progress.part(0.3, 1.0))}, {}};
    }
    const std::vector<TissueClass> shown = visible(look);
    const bool oneColor = haveOneColor(shown);
    const task::Progress ofClasses = progress.part(0.3, 1.0);
    ShownFields result;
    try {
        const std::size_t count = volume.lattice().size().count();
        std::vector<std::vector<float>> sums(oneColor ? 1 : 3, std::vector<float>(count, 0.0F));
        for (std::size_t c = 0; c < shown.size(); ++c) {
            const TissueClass &tissue = shown[c];
            const DensityField field =
                classField(volume, density, tissue,
                           ofClasses.part(double(c) / shown.size(), double(c + 1) / shown.size()));
            const std::array<double, 3> parts{tissue.color.red, tissue.color.green,
                                              tissue.color.blue};
            for (std::size_t channel = 0; channel < sums.size(); ++channel)
                add(sums[channel], field, tissue.weight * (oneColor ? 1.0 : parts[channel]));
        }
        for (auto &samples : sums)
            result.channels.push_back(fieldOf(volume, std::move(samples)));
    } catch (const std::bad_alloc &) {
        throw task::Error(task::ErrorCode::outOfMemory, "not enough memory for the class fields");
    }
    if (oneColor && !shown.empty())
        result.color = shown.front().color;
    return result;
}

} // namespace pellucid::classify
