// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/subtraction/rigid_registration.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <itkEuler3DTransform.h>
#include <itkImage.h>
#include <itkImageRegistrationMethodv4.h>
#include <itkMattesMutualInformationImageToImageMetricv4.h>
#include <itkRegistrationParameterScalesFromPhysicalShift.h>
#include <itkRegularStepGradientDescentOptimizerv4.h>

#include <tbb/global_control.h>

#include "core/subtraction/difference.h"
#include "core/subtraction/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"
#include "core/volume/statistics.h"

namespace pellucid::subtraction {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;
using volume::GridSize;
using volume::Lattice;
using volume::Volume;
using Image = itk::Image<float, 3>;
using Transform = itk::Euler3DTransform<double>;

// A grid of cubes around a volume, with the steps of the finest level. ITK's images have orthogonal
// axes, a tilted scan has not.
Lattice cubesAround(const Volume &volume) {
    constexpr int most = 192; // along the longest side: half a minute on two cores
    const Lattice &own = volume.lattice();
    glm::dvec3 low(1e30), high(-1e30);
    for (int corner = 0; corner < 8; ++corner) {
        const GridSize n = own.size();
        const glm::dvec3 v((corner & 1) != 0 ? n.i - 1 : 0, (corner & 2) != 0 ? n.j - 1 : 0,
                           (corner & 4) != 0 ? n.k - 1 : 0);
        const glm::dvec3 at = own.patient(volume::VoxelPoint{v}).mm;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::dvec3 extent = high - low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double step = std::max(own.shortestStepMm(), longest / most);
    const auto count = [&](double mm) { return std::max(1, int(mm / step) + 1); };
    return Lattice::make({count(extent.x), count(extent.y), count(extent.z)}, {low},
                         {glm::dvec3(step, 0, 0), glm::dvec3(0, step, 0), glm::dvec3(0, 0, step)});
}

itk::Point<double, 3> pointOf(const glm::dvec3 &v) {
    itk::Point<double, 3> point;
    for (unsigned d = 0; d < 3; ++d)
        point[d] = v[int(d)];
    return point;
}

// Values outside the volume become the lowest of the given range.
Image::Pointer imageOf(const Volume &volume, std::array<double, 2> range) {
    const Lattice grid = cubesAround(volume);
    const std::vector<float> values = resampledOnto(grid, volume, {});
    const auto image = Image::New();
    const GridSize n = grid.size();
    image->SetRegions(Image::RegionType(Image::SizeType{
        {itk::SizeValueType(n.i), itk::SizeValueType(n.j), itk::SizeValueType(n.k)}}));
    const glm::dvec3 origin = grid.origin().mm;
    image->SetOrigin(pointOf(origin));
    image->SetSpacing(Image::SpacingType(grid.spacingMm(0))); // of cubes
    image->Allocate();
    const auto low = float(range[0]), high = float(range[1]);
    std::transform(values.begin(), values.end(), image->GetBufferPointer(), [&](float value) {
        return std::isnan(value) ? low : std::clamp(value, low, high);
    });
    return image;
}

// Without the outermost values, which would leave few bins of the joint histogram to the tissue.
std::array<double, 2> rangeOf(const Volume &volume) {
    if (volume.unit() == volume::ValueUnit::hounsfield)
        return {-1000.0, 1500.0};
    const auto ends = volume::quantiles(volume, {0.001, 0.999});
    return {ends[0], std::max(ends[1], ends[0] + 1e-6)};
}

glm::dvec3 middleOf(const Volume &volume) {
    return volume.lattice().center().mm;
}

RigidTransform fromItk(const Transform &transform) {
    RigidTransform result;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            result.rotation[column][row] = transform.GetMatrix()(unsigned(row), unsigned(column));
    for (unsigned d = 0; d < 3; ++d) {
        result.centreMm[int(d)] = transform.GetCenter()[d];
        result.shiftMm[int(d)] = transform.GetTranslation()[d];
    }
    return result;
}

// The root mean square of the differences at every second sample of the fixed volume, on each axis.
double residual(const Volume &fixed, const Volume &moving, const RigidTransform &transform) {
    const Lattice &lattice = fixed.lattice();
    const GridSize n = lattice.size();
    const Lattice coarse =
        Lattice::make({(n.i + 1) / 2, (n.j + 1) / 2, (n.k + 1) / 2}, lattice.origin(),
                      {2.0 * lattice.step(0), 2.0 * lattice.step(1), 2.0 * lattice.step(2)});
    const std::vector<float> values = resampledOnto(coarse, moving, transform);
    double sum = 0.0, count = 0.0;
    const GridSize m = coarse.size();
    for (int k = 0; k < m.k; ++k)
        for (int j = 0; j < m.j; ++j)
            for (int i = 0; i < m.i; ++i) {
                const double d =
                    fixed.value({2 * i, 2 * j, 2 * k}) - double(values[m.offsetOf(i, j, k)]);
                if (!std::isfinite(d))
                    continue;
                sum += d * d;
                count += 1.0;
            }
    if (count == 0.0)
        throw Error(ErrorCode::unusable, because::volumesDoNotOverlap);
    return std::sqrt(sum / count);
}

class Registrar {
public:
    Registrar(const Volume &fixed, const Volume &moving, const task::Progress &progress)
        : m_fixed(imageOf(fixed, rangeOf(fixed))), m_moving(imageOf(moving, rangeOf(moving))),
          m_progress(progress) {
        const glm::dvec3 centre = middleOf(fixed);
        m_transform = Transform::New();
        m_transform->SetIdentity();
        m_transform->SetCenter(pointOf(centre));
    }

    // The search may stop too early, on a narrow ridge. A second one from there, with other
    // samples, goes on with long steps.
    RigidTransform run() {
        const double first = search(0);
        const RigidTransform found = fromItk(*m_transform);
        const double second = search(1);
        return second < first ? fromItk(*m_transform) : found;
    }

private:
    // From the present transform, which it improves. Returns the value of the metric; the least is
    // the best.
    double search(unsigned pass) {
        using Metric = itk::MattesMutualInformationImageToImageMetricv4<Image, Image>;
        using Optimizer = itk::RegularStepGradientDescentOptimizerv4<double>;
        using Scales = itk::RegistrationParameterScalesFromPhysicalShift<Metric>;
        using Method = itk::ImageRegistrationMethodv4<Image, Image, Transform>;
        const auto metric = Metric::New();
        metric->SetNumberOfHistogramBins(48);
        metric->SetUseMovingImageGradientFilter(false);
        metric->SetUseFixedImageGradientFilter(false);
        const auto scales = Scales::New();
        scales->SetMetric(metric);
        const auto optimizer = Optimizer::New();
        optimizer->SetScalesEstimator(scales);
        optimizer->SetDoEstimateLearningRateOnce(true);
        optimizer->SetNumberOfIterations(iterations);
        optimizer->SetRelaxationFactor(0.6);
        optimizer->SetMinimumStepLength(1e-4);
        optimizer->SetGradientMagnitudeTolerance(1e-8);
        optimizer->SetReturnBestParametersAndValue(true);
        const auto method = Method::New();
        method->SetFixedImage(m_fixed);
        method->SetMovingImage(m_moving);
        method->SetMetric(metric);
        method->SetOptimizer(optimizer);
        method->SetInitialTransform(m_transform);
        method->InPlaceOn();
        method->SetNumberOfLevels(levels);
        Method::ShrinkFactorsArrayType shrink(levels);
        Method::SmoothingSigmasArrayType smooth(levels);
        for (unsigned level = 0; level < levels; ++level) {
            shrink[level] = 1U << (levels - 1 - level);
            smooth[level] = level + 1 == levels ? 0.5 : 0.7 * double(shrink[level]);
        }
        method->SetShrinkFactorsPerLevel(shrink);
        method->SetSmoothingSigmasPerLevel(smooth);
        method->SetSmoothingSigmasAreSpecifiedInPhysicalUnits(false);
        method->SetMetricSamplingStrategy(Method::MetricSamplingStrategyEnum::REGULAR);
        Method::MetricSamplingPercentageArrayType share(levels);
        for (unsigned level = 0; level < levels; ++level)
            share[level] = level + 1 == levels ? 0.2 : 0.5;
        method->SetMetricSamplingPercentagePerLevel(share);
        method->MetricSamplingReinitializeSeed(int(pass) + 1); // the same result each time
        method->SetNumberOfWorkUnits(itk::ThreadIdType(
            tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
        optimizer->AddObserver(itk::IterationEvent(), [&](const itk::EventObject &) {
            const double within = double(optimizer->GetCurrentIteration()) / iterations;
            const double part =
                (double(method->GetCurrentLevel()) + std::min(within, 1.0)) / levels;
            m_progress.report((double(pass) + part) / passes);
            if (m_progress.stopRequested())
                optimizer->StopOptimization();
        });
        m_progress.check();
        try {
            method->Update();
        } catch (const itk::MemoryAllocationError &) {
            throw Error(ErrorCode::outOfMemory, because::noMemoryForTheDifference);
        } catch (const itk::ExceptionObject &error) {
            m_progress.check();
            // ITK reports too little overlap as a failure.
            if (std::string(error.GetDescription()).find("map outside") != std::string::npos)
                throw Error(ErrorCode::unusable, because::volumesDoNotOverlap);
            throw Error(ErrorCode::internal,
                        because::stepFailed("register", error.GetDescription()));
        }
        m_progress.check();
        return optimizer->GetCurrentMetricValue();
    }

    static constexpr unsigned levels = 3, iterations = 200, passes = 2;

    Image::Pointer m_fixed, m_moving;
    task::Progress m_progress;
    Transform::Pointer m_transform;
};

} // namespace

double RigidTransform::angleRad() const {
    const double trace = rotation[0][0] + rotation[1][1] + rotation[2][2];
    return std::acos(std::clamp(0.5 * (trace - 1.0), -1.0, 1.0));
}

namespace {

// How far the corners of a volume move.
double farthestMove(const volume::Lattice &lattice, const RigidTransform &transform) {
    const volume::GridSize size = lattice.size();
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at = lattice
                                  .patient(volume::VoxelIndex{(corner & 1) != 0 ? size.i - 1 : 0,
                                                              (corner & 2) != 0 ? size.j - 1 : 0,
                                                              (corner & 4) != 0 ? size.k - 1 : 0})
                                  .mm;
        farthest = std::max(farthest, glm::length(transform(at) - at));
    }
    return farthest;
}

} // namespace

Registration registerRigidly(const Volume &fixed, const Volume &moving,
                             const task::Progress &progress) {
    return task::orOutOfMemory(because::noMemoryForTheDifference, [&] {
        Registration result;
        result.residualBefore = residual(fixed, moving, {});
        progress.check();
        result.toMoving = Registrar(fixed, moving, progress.part(0.05, 0.95)).run();
        result.residualAfter = residual(fixed, moving, result.toMoving);
        // Volumes that fit already are not improved by what the search could not resolve.
        if (result.residualAfter >= result.residualBefore &&
            farthestMove(fixed.lattice(), result.toMoving) < fixed.lattice().longestStepMm()) {
            result.toMoving = {};
            result.residualAfter = result.residualBefore;
        }
        progress.report(1.0);
        return result;
    });
}

} // namespace pellucid::subtraction
