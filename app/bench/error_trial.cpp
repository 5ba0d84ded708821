// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/error_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/measure.h"
#include "app/bench/trial_fields.h"
#include "core/prepare/prepared_engine.h"
#include "core/reference/shaded_field.h"
#include "core/reference/wide_kernel.h"

namespace pellucid::bench {

namespace {

// The view [U V W] with W along a direction, rolled about it.
glm::dquat facing(const glm::dvec3 &w, double roll) {
    const glm::dvec3 helper = std::abs(w.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(helper, w)), v = glm::cross(w, u);
    const glm::dvec3 right = std::cos(roll) * u + std::sin(roll) * v;
    return glm::quat_cast(glm::dmat3(right, glm::cross(w, right), w));
}

glm::dquat viewOf(Genes &genes, const volume::Lattice &lattice, const glm::dvec3 &along,
                  std::string &name) {
    const auto inPatient = [&](const glm::dvec3 &coordinates) {
        glm::dvec3 sum(0.0);
        for (int d = 0; d < 3; ++d)
            sum += coordinates[d] * 0.5 * double(lattice.size()[d]) * lattice.step(d);
        return glm::normalize(sum);
    };
    const auto ofSteps = [&](int a, int b, int c) {
        return glm::normalize(double(a) * lattice.step(0) + double(b) * lattice.step(1) +
                              double(c) * lattice.step(2));
    };
    constexpr std::array kindsOfView{
        "any", "axis", "near an axis", "45 degrees", "along the shape", "near the shape"};
    const int kind = genes.choice(int(kindsOfView.size()));
    name = kindsOfView[std::size_t(kind)];
    const int axis = genes.choice(3), sign = genes.choice(2) * 2 - 1;
    const glm::dvec3 any = genes.direction();
    const double near = std::pow(10.0, genes.between(-4.0, -0.7)),
                 roll = genes.next() < 0.5 ? 0.0 : genes.between(0.0, 2.0 * std::numbers::pi);
    glm::dvec3 w = any;
    if (kind == 1 || kind == 2)
        w = ofSteps(axis == 0, axis == 1, axis == 2);
    else if (kind == 3)
        w = ofSteps(axis != 0, axis != 1 ? (axis == 0 ? sign : 1) : 0, axis != 2 ? sign : 0);
    else if (kind > 3)
        w = inPatient(along);
    if (kind == 2 || kind == 5)
        w = glm::normalize(w + near * any);
    return facing(w, roll);
}

// Crops the picture, off centre.
void cropPicture(Genes &genes, scene::Camera &camera) {
    const auto side = [&](int pixels) {
        return std::max(8, 2 * int(0.5 * pixels * genes.between(0.3, 1.0)));
    };
    const int width = side(camera.width), height = side(camera.height);
    camera.panMm = 0.5 * camera.pixelMm *
                   glm::dvec2((camera.width - width) * genes.between(-0.7, 0.7),
                              (camera.height - height) * genes.between(-0.7, 0.7));
    camera.width = width;
    camera.height = height;
}

// Sometimes the same value at every depth, which has only frequency 0.
std::vector<double> curveOf(Genes &genes) {
    const bool isEven = genes.next() < 0.2;
    std::vector<double> curve(std::size_t(2 + genes.choice(4)), genes.between(0.1, 2.0));
    for (double &value : curve)
        if (!isEven)
            value = genes.between(0.0, 2.0);
    return curve;
}

shading::Shading shadingOf(Genes &genes) {
    using shading::CueKind;
    constexpr std::array cues{CueKind::linear, CueKind::sine, CueKind::curve};
    shading::Shading result;
    const bool isCued = genes.next() < 0.6, isLit = !isCued || genes.next() < 0.4;
    if (isCued)
        result.cue = {cues[std::size_t(genes.choice(int(cues.size())))],
                      std::min(1.0, genes.between(0.1, 1.3))}; // often full strength
    if (result.cue.kind == CueKind::curve)
        result.cue.curve = curveOf(genes);
    if (isLit) {
        result.ambient = genes.between(0.1, 0.8);
        result.lights.push_back({genes.direction()});
        if (genes.next() < 0.3) {
            result.lights.front().color = {1.0, 0.6, 0.2};
            result.lights.push_back({genes.direction()});
            result.lights.back().color = {0.1, 0.3, 1.0};
        }
    }
    return result;
}

// Half of the trials are uniform. The best kernel leaves rounding and tails to be seen.
scene::Interpolation interpolationOf(Genes &genes) {
    scene::Interpolation interpolation;
    interpolation.isUniform = genes.next() < 0.5;
    if (!interpolation.isUniform || genes.next() < 0.5)
        return interpolation;
    interpolation.kernel = {fourier::KernelFamily::leastAliasing, 7};
    interpolation.padding = 2.0;
    interpolation.storage =
        genes.next() < 0.5 ? fourier::Storage::binary16 : fourier::Storage::float32;
    return interpolation;
}

std::string nameOf(const scene::Interpolation &interpolation) {
    std::string name = interpolation.isUniform ? ", uniform" : "";
    if (interpolation.kernel)
        name += ", " + fourier::kernelName(*interpolation.kernel);
    if (interpolation.storage)
        name += ", " + std::string(fourier::storageName(*interpolation.storage));
    return name;
}

// The exact picture of a trial.
class Exact {
public:
    explicit Exact(const Trial &trial) : m_trial(trial) {
        if (trial.scene.shading.isPlain())
            m_plain.emplace(trial.field.values, trial.field.support);
    }
    // From the middle of one that is larger by the margin on every side, so that its period is
    // longer.
    std::vector<double> picture(int margin) const {
        const scene::Scene &scene = m_trial.scene;
        scene::Camera camera = scene.camera;
        camera.width += 2 * margin;
        camera.height += 2 * margin;
        const std::vector<double> whole =
            m_plain
                ? m_plain->image(camera, scene.image)
                : reference::shadedImage({{m_trial.field}, {}}, scene.shading, camera, scene.image);
        const std::size_t channels =
            whole.size() / (std::size_t(camera.width) * std::size_t(camera.height));
        std::vector<double> picture;
        for (int row = margin; row < margin + scene.camera.height; ++row) {
            const auto from =
                whole.begin() + std::ptrdiff_t((std::size_t(row) * std::size_t(camera.width) +
                                                std::size_t(margin)) *
                                               channels);
            picture.insert(picture.end(), from,
                           from + std::ptrdiff_t(std::size_t(scene.camera.width) * channels));
        }
        return picture;
    }

private:
    const Trial &m_trial;
    std::optional<reference::WideKernel> m_plain;
};

} // namespace

Trial trialOf(const Candidate &candidate, PictureKind pictures) {
    Genes genes(candidate.genes);
    constexpr std::array<double, 4> tolerances{1e-2, 1.1e-3, 1e-4, 1e-5};
    const auto kind = FieldKind(genes.choice(fieldKinds));
    const double tolerance = tolerances[std::size_t(genes.choice(int(tolerances.size())))];
    double zoom = genes.next() < 0.7 ? 1.0 : genes.between(0.5, 2.5);
    if (kind == FieldKind::pattern) // so that the pattern's lines are in the roll-off
        zoom = genes.between(0.94, 1.0);
    const volume::Lattice lattice = latticeOf(genes);
    const scene::Interpolation interpolation =
        pictures == PictureKind::whole ? interpolationOf(genes) : scene::Interpolation{};
    const bool isBandLimited = genes.next() < 0.3;
    const Shape shape = shapeOf(kind, genes, lattice);
    std::string view;
    Trial trial;
    trial.scene.camera = scene::defaultCamera(lattice);
    trial.scene.camera.orientation = viewOf(genes, lattice, shape.along, view);
    trial.scene.tolerance = tolerance;
    trial.scene.interpolation = interpolation;
    if (isBandLimited)
        trial.scene.image.reconstruction = scene::Reconstruction::bandLimited;
    const volume::GridSize size = lattice.size();
    trial.field = classify::densityField(
        volume::Volume(lattice, samplesOf(kind, shape, genes, size), volume::ValueUnit::none),
        {0.0, 1.0});
    // Zooming changes the pixel size and the image size; the whole field stays in the picture.
    scene::Camera &camera = trial.scene.camera;
    camera.pixelMm *= zoom;
    camera.width = camera.height = 2 * int(std::ceil(0.5 * camera.width / zoom));
    std::string more;
    if (pictures != PictureKind::whole) {
        if (genes.next() < 0.3) {
            cropPicture(genes, camera);
            more += ", cropped";
        }
        if (genes.next() < 0.4) {
            trial.scene.shading = shadingOf(genes);
            more += trial.scene.shading.isLit() ? ", lit" : ", with a cue";
        }
    }
    if (pictures == PictureKind::amplified) {
        scene::ImageDefinition &image = trial.scene.image;
        image.detail = genes.between(0.2, scene::maxDetail);
        image.detailMm = std::min(lattice.radiusMm(), lattice.shortestStepMm() *
                                                          std::pow(10.0, genes.between(-0.5, 0.9)));
        more += fmt::format(", detail {:.2g} at {:.2g} mm", image.detail, image.detailMm);
    }
    trial.fieldName = fmt::format("{}, {}x{}x{}", fieldKindName(kind), size.i, size.j, size.k);
    trial.name = fmt::format("{}, {}{}, pixel {:.2f} mm{}, tolerance {:.2g}{}", trial.fieldName,
                             view, more, camera.pixelMm, isBandLimited ? ", band limited" : "",
                             tolerance, nameOf(interpolation));
    return trial;
}

Verdict judge(const Trial &trial) {
    const scene::Scene &scene = trial.scene;
    const classify::ShownFields fields{{trial.field}, {}};
    const auto prepared = prepare::prepareEngine({scene, fields});
    const auto picture = prepared.engine->render(scene.camera, scene.image, scene.shading);
    const double predicted = prepared.plan.predictedError;
    const error::StatedError stated =
        prepare::measuredError(*prepared.engine, fields, scene.camera, scene.image, scene.shading);
    const Exact exact(trial);
    const auto errorWithin = [&](int margin) {
        return compare(picture.samples, exact.picture(margin)).relativeL2;
    };
    double measured = errorWithin(0);
    // The tails of the exact image fold back, too. Where they may decide, a period of twice the
    // length shows what they do.
    int margin =
        reference::periodOf(trial.field.values.lattice(), scene.camera, scene.image).columns;
    double before = 0.0;
    for (int doublings = 0; doublings < 3 && measured > std::min(0.5 * predicted, stated.high) &&
                            std::abs(measured - before) > 0.1 * measured;
         ++doublings, margin *= 2) {
        before = measured;
        measured = errorWithin(margin);
    }
    return {predicted, measured, stated, predicted <= scene.tolerance};
}

} // namespace pellucid::bench
