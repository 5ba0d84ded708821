// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/morphology.h"

#include <itkBinaryMorphologicalClosingImageFilter.h>
#include <itkBinaryMorphologicalOpeningImageFilter.h>
#include <itkFlatStructuringElement.h>

#include "core/preprocess/itk_images_itk.inc"

namespace pellucid::preprocess {

namespace {

// A ball of a radius in mm: the samples of the lattice whose centres are inside.
itk::FlatStructuringElement<3> ballOf(const volume::Lattice &lattice, double radiusMm) {
    using Element = itk::FlatStructuringElement<3>;
    Element::RadiusType radius;
    for (unsigned d = 0; d < 3; ++d)
        radius[d] = itk::SizeValueType(radiusMm / lattice.spacingMm(int(d)) * (1.0 + 1e-6));
    Element ball;
    ball.SetRadius(radius);
    auto at = ball.Begin();
    for (unsigned n = 0; at != ball.End(); ++at, ++n) {
        double squares = 0.0;
        for (unsigned d = 0; d < 3; ++d) {
            const double off = double(ball.GetOffset(n)[d]) * lattice.spacingMm(int(d));
            squares += off * off;
        }
        *at = squares <= radiusMm * radiusMm * (1.0 + 1e-5);
    }
    return ball;
}

template <class Filter>
Mask morphology(Filter &filter, const char *step, const volume::Lattice &lattice, const Mask &mask,
                double radiusMm, const task::Progress &progress) {
    filter.SetKernel(ballOf(lattice, radiusMm));
    filter.SetForegroundValue(1);
    filter.SetInput(imageOver<MaskImage>(lattice, mask.data()));
    runFilter(filter, step, progress);
    return samplesOf(*filter.GetOutput());
}

} // namespace

Mask openingByItk(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
                  const task::Progress &progress) {
    using Kernel = itk::FlatStructuringElement<3>;
    auto filter = itk::BinaryMorphologicalOpeningImageFilter<MaskImage, MaskImage, Kernel>::New();
    return morphology(*filter, "opening", lattice, mask, radiusMm, progress);
}

Mask closingByItk(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
                  const task::Progress &progress) {
    using Kernel = itk::FlatStructuringElement<3>;
    auto filter = itk::BinaryMorphologicalClosingImageFilter<MaskImage, MaskImage, Kernel>::New();
    filter->SetSafeBorder(true);
    return morphology(*filter, "closing", lattice, mask, radiusMm, progress);
}

} // namespace pellucid::preprocess
