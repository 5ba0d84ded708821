// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <itkDoubleThresholdImageFilter.h>
#include <itkGradientRecursiveGaussianImageFilter.h>
#include <itkHessianRecursiveGaussianImageFilter.h>
#include <itkZeroCrossingImageFilter.h>

#include "core/preprocess/itk_images_itk.inc"
#include "core/preprocess/reasons.h"

namespace pellucid::preprocess {

Mask cannyEdgesByItk(const volume::Volume &volume, const CannyOptions &options,
                     const task::Progress &progress) {
    const volume::Lattice &lattice = volume.lattice();
    const volume::GridSize size = lattice.size();
    if (std::min({size.i, size.j, size.k}) < 4)
        throw task::Error(task::ErrorCode::usage, task::because::edgesNeedSamples);
    if (!(options.sigmaMm > 0.0))
        throw task::Error(task::ErrorCode::usage, task::because::edgesNeedASigma);
    const std::vector<float> input = finiteSamples(volume);
    const auto image = imageOver<FloatImage>(lattice, input.data());
    auto gradient = itk::GradientRecursiveGaussianImageFilter<FloatImage>::New();
    gradient->SetSigma(options.sigmaMm);
    gradient->SetInput(image);
    runFilter(*gradient, "edges", progress.part(0.0, 0.3));
    auto hessian = itk::HessianRecursiveGaussianImageFilter<FloatImage>::New();
    hessian->SetSigma(options.sigmaMm);
    hessian->SetInput(image);
    runFilter(*hessian, "edges", progress.part(0.3, 0.8));
    const auto *const gradients = gradient->GetOutput()->GetBufferPointer();
    const auto *const hessians = hessian->GetOutput()->GetBufferPointer();
    // The second derivative along the gradient times the squared gradient; only its sign matters.
    std::vector<float> along(input.size()), magnitude(input.size());
    tbb::parallel_for(std::size_t(0), input.size(), [&](std::size_t n) {
        double second = 0.0, square = 0.0;
        for (unsigned a = 0; a < 3; ++a) {
            square += double(gradients[n][a]) * double(gradients[n][a]);
            for (unsigned b = 0; b < 3; ++b)
                second +=
                    double(gradients[n][a]) * double(hessians[n](a, b)) * double(gradients[n][b]);
        }
        along[n] = float(second);
        magnitude[n] = float(std::sqrt(square));
    });
    auto zeros = itk::ZeroCrossingImageFilter<FloatImage, MaskImage>::New();
    zeros->SetForegroundValue(1);
    zeros->SetBackgroundValue(0);
    zeros->SetInput(imageOver<FloatImage>(lattice, along.data()));
    runFilter(*zeros, "edges", progress.part(0.8, 0.9));
    const std::uint8_t *const crosses = zeros->GetOutput()->GetBufferPointer();
    // Keep maxima only, where the second derivative falls along the gradient.
    std::vector<float> strength(input.size());
    tbb::parallel_for(0, size.k, [&](int k) {
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const std::array<int, 3> at{i, j, k};
                const std::array<std::size_t, 3> strides{1, std::size_t(size.i),
                                                         std::size_t(size.i) * size.j};
                const std::size_t n = strides[2] * k + strides[1] * j + i;
                if (crosses[n] == 0)
                    continue;
                double change = 0.0;
                for (unsigned d = 0; d < 3; ++d) {
                    const std::size_t before = at[d] > 0 ? n - strides[d] : n,
                                      after = at[d] + 1 < size[int(d)] ? n + strides[d] : n;
                    change += double(gradients[n][d]) *
                              (double(along[after]) - double(along[before])) /
                              lattice.spacingMm(int(d));
                }
                strength[n] = change < 0.0 ? magnitude[n] : 0.0F;
            }
    });
    auto link = itk::DoubleThresholdImageFilter<FloatImage, MaskImage>::New();
    const float open = std::numeric_limits<float>::max();
    // Strictly above the thresholds.
    const auto above = [&](double value) { return std::nextafter(float(value), open); };
    link->SetThreshold1(above(options.low));
    link->SetThreshold2(above(options.high));
    link->SetThreshold3(open);
    link->SetThreshold4(open);
    link->SetInsideValue(1);
    link->SetOutsideValue(0);
    link->SetFullyConnected(true);
    link->SetInput(imageOver<FloatImage>(lattice, strength.data()));
    runFilter(*link, "edges", progress.part(0.9, 1.0));
    return samplesOf(*link->GetOutput());
}

} // namespace pellucid::preprocess
