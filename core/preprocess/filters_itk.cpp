// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/filters.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <itkCurvatureAnisotropicDiffusionImageFilter.h>
#include <itkDiscreteGaussianImageFilter.h>
#include <itkMedianImageFilter.h>

#include "core/preprocess/itk_images_itk.inc"

namespace pellucid::preprocess {

namespace {

template <class Filter>
volume::Volume filtered(const volume::Volume &volume, Filter &filter, const std::string &name,
                        const task::Progress &progress) {
    const std::vector<float> input = finiteSamples(volume);
    const auto image = imageOver<FloatImage>(volume.lattice(), input.data());
    filter.SetInput(image);
    runFilter(filter, name, progress);
    return {volume.lattice(), samplesOf(*filter.GetOutput()), volume.unit(), volume.notes()};
}

} // namespace

volume::Volume gaussian(const volume::Volume &volume, double sigmaMm,
                        const task::Progress &progress) {
    auto filter = itk::DiscreteGaussianImageFilter<FloatImage, FloatImage>::New();
    filter->SetVariance(sigmaMm * sigmaMm);
    filter->SetMaximumError(0.01);
    filter->SetMaximumKernelWidth(128);
    return filtered(volume, *filter, "gaussian", progress);
}

volume::Volume median(const volume::Volume &volume, double radiusMm,
                      const task::Progress &progress) {
    auto filter = itk::MedianImageFilter<FloatImage, FloatImage>::New();
    FloatImage::SizeType radius;
    for (unsigned d = 0; d < 3; ++d) {
        const double samples = radiusMm / volume.lattice().spacingMm(int(d));
        radius[d] = itk::SizeValueType(
            std::min<double>(std::floor(samples + 1e-6), volume.lattice().size()[int(d)]));
    }
    filter->SetRadius(radius);
    return filtered(volume, *filter, "median", progress);
}

volume::Volume diffusion(const volume::Volume &volume, int iterations, double conductance,
                         const task::Progress &progress) {
    auto filter = itk::CurvatureAnisotropicDiffusionImageFilter<FloatImage, FloatImage>::New();
    filter->SetNumberOfIterations(itk::IdentifierType(iterations));
    filter->SetConductanceParameter(conductance);
    filter->SetUseImageSpacing(true);
    filter->SetTimeStep(volume.lattice().shortestStepMm() / 16.0);
    return filtered(volume, *filter, "diffusion", progress);
}

} // namespace pellucid::preprocess
