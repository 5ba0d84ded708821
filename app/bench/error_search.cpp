// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/error_search.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/accuracy/view_error.h"
#include "core/prepare/prepared_engine.h"
#include "core/reference/shaded_field.h"
#include "core/reference/wide_kernel.h"

namespace pellucid::bench {

namespace {

constexpr std::size_t geneCount = 48;

// Reads the genes in order.
class Genes {
public:
    explicit Genes(const Candidate &candidate) : m_genes(candidate.genes) {}
    double next() { return m_genes[m_at++ % m_genes.size()]; }
    double between(double low, double high) { return low + (high - low) * next(); }
    int choice(int count) { return std::min(count - 1, int(next() * count)); }
    glm::dvec3 direction() {
        const double z = between(-1.0, 1.0), angle = between(0.0, 2.0 * std::numbers::pi);
        const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

private:
    const std::vector<double> &m_genes;
    std::size_t m_at = 0;
};

constexpr std::array kinds{"points", "corners", "rods",  "sheet", "shell", "comb",
                           "chirp",  "body",    "noise", "cloud", "metal", "pattern"};
constexpr int patternKind = 11;

volume::Lattice latticeOf(Genes &genes) {
    constexpr std::array<volume::GridSize, 8> sizes{{{24, 24, 24},
                                                     {32, 32, 32},
                                                     {40, 24, 16},
                                                     {17, 23, 29},
                                                     {32, 32, 4},
                                                     {36, 36, 7},
                                                     {12, 40, 12},
                                                     {45, 45, 45}}};
    constexpr std::array<double, 5> thick{1.0, 1.0, 2.0, 5.0, 0.5};
    const volume::GridSize size = sizes[std::size_t(genes.choice(int(sizes.size())))];
    const double step = thick[std::size_t(genes.choice(int(thick.size())))];
    const double tilt = genes.next() < 0.5 ? 0.0 : genes.between(0.0, 0.5);
    return volume::Lattice::make(size, {{-11.0, 7.0, 3.0}},
                                 {glm::dvec3(1, 0, 0),
                                  glm::dvec3(0, std::cos(tilt), -std::sin(tilt)),
                                  step / std::cos(tilt) * glm::dvec3(0, 0, 1)});
}

// A field as a function of lattice coordinates, each in -1..1, and the direction, in the same
// coordinates, of its worst view.
struct Shape {
    std::function<double(const glm::dvec3 &)> value;
    glm::dvec3 along{0.0, 0.0, 1.0};
};

Shape shapeOf(int kind, Genes &genes, const volume::Lattice &lattice) {
    const glm::dvec3 n(lattice.size().i, lattice.size().j, lattice.size().k);
    const glm::dvec3 normal = genes.direction(),
                     place(genes.between(-1.0, 1.0), genes.between(-1.0, 1.0),
                           genes.between(-1.0, 1.0));
    const double width = 2.0 * genes.between(0.3, 3.0) / std::max({n.x, n.y, n.z}),
                 other = genes.next(), more = genes.next();
    const glm::dvec3 across = glm::normalize(
        glm::cross(normal, std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const auto gauss = [](double x) { return std::exp(-x * x); };
    switch (kind) {
    case 2: // a rod, oblique or along an axis, with a diffuse blob in the middle
        return {[=](const glm::dvec3 &x) {
                    const glm::dvec3 axis = more < 0.5 ? normal : glm::dvec3(0, 0, 1);
                    const glm::dvec3 off = x - place;
                    const double far = glm::length(off - glm::dot(off, axis) * axis);
                    return gauss(far / width) + 0.3 * other * gauss(2.0 * glm::length(x));
                },
                more < 0.5 ? normal : glm::dvec3(0, 0, 1)};
    case 3: // a sheet, worst seen edge on
        return {
            [=](const glm::dvec3 &x) { return gauss(glm::dot(x - 0.7 * place, normal) / width); },
            across};
    case 4: // a shell that may extend beyond the lattice
        return {[=](const glm::dvec3 &x) {
                    return gauss((glm::length(x - 0.4 * place) - 0.3 - 0.9 * other) / width);
                },
                across};
    case 5: // slabs
        return {[=](const glm::dvec3 &x) {
                    const double wave = std::sin(glm::dot(x, normal) * (3.0 + 40.0 * other));
                    return wave > 1.8 * more - 0.9 ? 1.0 : 0.0;
                },
                across};
    case 6: // a chirp: ever finer waves
        return {[=](const glm::dvec3 &x) {
                    const double t = glm::dot(x - 0.5 * place, normal);
                    return 0.5 + 0.5 * std::sin((5.0 + 30.0 * other) * t * t);
                },
                across};
    case 7: // a body with bone, cut by the lattice
        return {
            [=](const glm::dvec3 &x) {
                const glm::dvec3 y = (x - 0.5 * place) / glm::dvec3(0.6 + other, 0.9, 0.6 + more);
                const double r = glm::length(y);
                return r < 1.0 ? (r > 0.9 ? 0.8 : 0.3 + 0.02 * std::sin(40.0 * x.x * x.y)) : 0.0;
            },
            normal};
    case 9: // a cloud
        return {[=](const glm::dvec3 &x) {
                    return gauss(glm::length((x - place) / (0.1 + 1.5 * other)));
                },
                normal};
    default:
        return {
            [=](const glm::dvec3 &x) { return gauss(glm::length(x - 0.3 * place)) * 0.05 * other; },
            normal};
    }
}

// Samples that are no function of position: single bright ones, and coloured noise.
void addSamples(int kind, Genes &genes, const volume::GridSize &size, std::vector<float> &samples) {
    const auto at = [&](int i, int j, int k) -> float & {
        return samples[(std::size_t(k) * size.j + j) * size.i + i];
    };
    const auto side = [&](int n) { return std::min(n - 1, int(genes.next() * n)); };
    const auto end = [&](int n) { return genes.next() < 0.5 ? 0 : n - 1; };
    if (kind == 0 || kind == 10) {
        const int count = 1 + genes.choice(4);
        if (kind == 0)
            std::fill(samples.begin(), samples.end(), 0.0F);
        for (int n = 0; n < count; ++n) {
            const int i = side(size.i), j = side(size.j), k = side(size.k);
            at(i, j, k) = float(genes.between(0.2, 1.0)) * (kind == 10 ? 30.0F : 1.0F);
        }
    } else if (kind == 1) {
        std::fill(samples.begin(), samples.end(), 0.0F);
        const int i = end(size.i), j = end(size.j), k = end(size.k);
        at(i, j, k) = 1.0F;
        at(size.i - 1 - i, size.j - 1 - j, size.k - 1 - k) = float(genes.between(0.3, 1.0));
    } else if (kind == patternKind) { // every second sample of one, two or three axes
        const std::array<bool, 3> alternates{true, genes.next() < 0.5, genes.next() < 0.3};
        const int turned = genes.choice(3);
        const float between = genes.next() < 0.5 ? 0.0F : float(genes.between(0.0, 0.9));
        for (int k = 0; k < size.k; ++k)
            for (int j = 0; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i) {
                    const std::array<int, 3> n{i, j, k};
                    bool isBright = true;
                    for (int d = 0; d < 3; ++d)
                        isBright = isBright && (n[std::size_t(d)] % 2 == 1 ||
                                                !alternates[std::size_t((d + turned) % 3)]);
                    at(i, j, k) = isBright ? 1.0F : between;
                }
    } else if (kind == 8) { // positive noise, from white to smooth
        std::minstd_rand random(unsigned(1.0 + 1e6 * genes.next()));
        std::uniform_real_distribution<float> value(0.0F, 1.0F);
        const float keep = float(genes.between(0.0, 0.95));
        float before = 0.5F;
        for (float &sample : samples)
            sample = before = keep * before + (1.0F - keep) * value(random);
    }
}

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

shading::Shading shadingOf(Genes &genes) {
    using shading::CueKind;
    constexpr std::array cues{CueKind::linear, CueKind::sine, CueKind::curve};
    shading::Shading result;
    const bool isCued = genes.next() < 0.6, isLit = !isCued || genes.next() < 0.4;
    if (isCued)
        result.cue = {cues[std::size_t(genes.choice(int(cues.size())))],
                      std::min(1.0, genes.between(0.1, 1.3)), // often in full
                      {0.2, 1.0, 0.4}};
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

} // namespace

Trial trialOf(const Candidate &candidate, Asked asked) {
    Genes genes(candidate);
    constexpr std::array<double, 4> tolerances{1e-2, 1.1e-3, 1e-4, 1e-5};
    const int kind = genes.choice(int(kinds.size()));
    const double tolerance = tolerances[std::size_t(genes.choice(int(tolerances.size())))];
    double zoom = genes.next() < 0.7 ? 1.0 : genes.between(0.5, 2.5);
    if (kind == patternKind) // so that the pattern's lines lie in the roll-off
        zoom = genes.between(0.94, 1.0);
    const volume::Lattice lattice = latticeOf(genes);
    const Shape shape = shapeOf(kind, genes, lattice);
    std::string view;
    Trial trial;
    trial.scene.camera = scene::defaultCamera(lattice);
    trial.scene.camera.orientation = viewOf(genes, lattice, shape.along, view);
    trial.scene.tolerance = tolerance;
    const volume::GridSize size = lattice.size();
    std::vector<float> samples;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const glm::dvec3 x(2.0 * (i + 0.5) / size.i - 1.0, 2.0 * (j + 0.5) / size.j - 1.0,
                                   2.0 * (k + 0.5) / size.k - 1.0);
                samples.push_back(std::max(0.0F, float(shape.value(x))));
            }
    addSamples(kind, genes, size, samples);
    // Values below 1e-4 of the maximum become 0, so that the field has a bounded support.
    const float most = *std::max_element(samples.begin(), samples.end());
    for (float &sample : samples)
        sample = sample < 1e-4F * most ? 0.0F : sample / std::max(most, 1e-30F);
    trial.field = classify::densityField(
        volume::Volume(lattice, std::move(samples), volume::ValueUnit::none), {0.0, 1.0});
    // The zoom changes the pixel size; the picture still holds the whole field.
    scene::Camera &camera = trial.scene.camera;
    camera.pixelMm *= zoom;
    camera.width = camera.height = 2 * int(std::ceil(0.5 * camera.width / zoom));
    std::string more;
    if (asked == Asked::anyPicture) {
        if (genes.next() < 0.3) {
            cropPicture(genes, camera);
            more += ", cropped";
        }
        if (genes.next() < 0.4) {
            trial.scene.shading = shadingOf(genes);
            more += trial.scene.shading.isLit() ? ", lit" : ", with a cue";
        }
    }
    trial.name = fmt::format("{}, {}x{}x{}, {}{}, pixel {:.2f} mm, tolerance {:.2g}",
                             kinds[std::size_t(kind)], size.i, size.j, size.k, view, more,
                             camera.pixelMm, tolerance);
    return trial;
}

Verdict judge(const Trial &trial) {
    const scene::Scene &scene = trial.scene;
    const classify::ShownFields fields{{trial.field}, {}};
    const auto shaded = prepare::shadedFields(fields.channels, scene.shading,
                                              shading::shadingScale(trial.field.values.lattice()));
    const auto summaries = prepare::summarise(shaded, scene.shading.cue);
    const auto plan = plan::planRender(scene, summaries, prepare::imagesOf(1, scene.shading));
    const auto engine = prepare::makeEngine(shaded, {}, plan);
    const auto image = engine->render(scene.camera, scene.image, scene.shading);
    const auto truth =
        scene.shading.isPlain()
            ? reference::WideKernel(trial.field.values, trial.field.support)
                  .image(scene.camera, scene.image)
            : reference::shadedImage(fields, scene.shading, scene.camera, scene.image);
    double difference = 0.0, energy = 0.0;
    for (std::size_t n = 0; n < truth.size(); ++n) {
        const double off = double(image.samples[n]) - truth[n];
        difference += off * off;
        energy += truth[n] * truth[n];
    }
    Verdict verdict{plan.predictedError, energy > 0.0 ? std::sqrt(difference / energy) : 0.0,
                    accuracy::ViewErrorModel(plan, summaries)
                        .errorOf(image, scene.camera, scene.image, engine->parts(), scene.shading)
                        .relative,
                    true};
    verdict.keepsTolerance = plan.predictedError <= trial.scene.tolerance;
    return verdict;
}

std::vector<PictureFactor> picturePredictionFactors(int count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<PictureFactor> factors;
    while (int(factors.size()) < count) {
        Candidate candidate;
        for (std::size_t n = 0; n < geneCount; ++n)
            candidate.genes.push_back(uniform(random));
        candidate.genes[1] = 0.3; // the default tolerance, 1.1e-3
        const Trial trial = trialOf(candidate, Asked::anyPicture);
        const Verdict verdict = judge(trial);
        if (verdict.measured > 0.0)
            factors.push_back({trial.name, verdict.ofView / verdict.measured});
    }
    std::sort(factors.begin(), factors.end(),
              [](const auto &a, const auto &b) { return a.factor < b.factor; });
    return factors;
}

SearchResult
searchCounterexample(const SearchOptions &options,
                     const std::function<void(const Trial &, const Verdict &)> &found) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
    std::mt19937_64 random(options.seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::normal_distribution<double> normal(0.0, 1.0);
    // Several islands keep the best candidate of one kind of field from displacing the others.
    struct Island {
        Candidate best;
        double ratio = -1.0;
        int failures = 0;
    };
    std::array<Island, 8> islands;
    SearchResult result;
    double worst = -1.0;
    while (result.trials < options.trials && Clock::now() < end) {
        Island &island = islands[std::size_t(result.trials) % islands.size()];
        Candidate candidate = island.best;
        constexpr int patience = 60;
        const bool isNew = island.ratio < 0.0 || island.failures > patience;
        if (isNew) {
            candidate.genes.assign(geneCount, 0.0);
            for (double &gene : candidate.genes)
                gene = uniform(random);
        } else {
            for (double &gene : candidate.genes)
                if (uniform(random) < 0.15)
                    gene = uniform(random) < 0.2
                               ? uniform(random)
                               : std::clamp(gene + 0.1 * normal(random), 0.0, 0.999999);
        }
        const Trial trial = trialOf(candidate, Asked::wholePicture);
        const Verdict verdict = judge(trial);
        ++result.trials;
        ++island.failures;
        if (isNew || verdict.ratio() > island.ratio)
            island = {candidate, verdict.ratio(), 0};
        if (verdict.ratio() > worst) {
            worst = verdict.ratio();
            result.worst = candidate;
            result.verdict = verdict;
            if (found)
                found(trial, verdict);
        }
    }
    return result;
}

} // namespace pellucid::bench
