// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/parts.h"

#include <algorithm>

#include <itkConnectedComponentImageFilter.h>

#include "core/preprocess/itk_images_itk.inc"

namespace pellucid::preprocess {

Parts partsOf(const volume::Lattice &lattice, const Mask &mask, const char *step,
              const task::Progress &progress) {
    using Labels = itk::Image<std::uint32_t, 3>;
    auto filter = itk::ConnectedComponentImageFilter<MaskImage, Labels>::New();
    filter->SetInput(imageOver<MaskImage>(lattice, mask.data()));
    runFilter(*filter, step, progress);
    const std::uint32_t *const labels = filter->GetOutput()->GetBufferPointer();
    return {{labels, labels + mask.size()}, std::size_t(filter->GetObjectCount())};
}

std::vector<volume::VoxelBox> boxesOf(const Parts &parts, const volume::GridSize &size) {
    std::vector<volume::VoxelBox> boxes(parts.count + 1);
    std::size_t n = 0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i, ++n)
                if (parts.labels[n] != 0) {
                    volume::VoxelBox &box = boxes[parts.labels[n]];
                    box = united(box, {{i, j, k}, {i + 1, j + 1, k + 1}});
                }
    return boxes;
}

Mask largestPart(const volume::Lattice &lattice, const Mask &mask, double minShare,
                 const task::Progress &progress) {
    const Parts parts = partsOf(lattice, mask, "largest", progress);
    std::vector<std::size_t> counts(parts.count + 1, 0);
    for (const std::uint32_t label : parts.labels)
        ++counts[label];
    if (parts.count == 0)
        return mask; // it is empty
    const auto largest = std::max_element(counts.begin() + 1, counts.end());
    std::vector<std::uint8_t> isKept(counts.size());
    for (std::size_t label = 1; label < counts.size(); ++label)
        isKept[label] = minShare < 1.0 ? double(counts[label]) >= minShare * double(*largest)
                                       : counts.begin() + std::ptrdiff_t(label) == largest;
    Mask part(mask.size());
    for (std::size_t n = 0; n < mask.size(); ++n)
        part[n] = isKept[parts.labels[n]];
    return part;
}

} // namespace pellucid::preprocess
