// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/error_sweep.h"

#include <array>
#include <random>

#include <fmt/format.h>

#include "app/bench/error_trial.h"
#include "app/bench/measure.h"
#include "app/bench/trial_fields.h"
#include "core/prepare/prepared_engine.h"
#include "core/reference/wide_kernel.h"

namespace pellucid::bench {

namespace {

constexpr std::array<double, 5> tolerances{1e-2, 3e-3, 1.1e-3, 3e-4, 1e-4};

void sweepField(const Trial &trial, std::uint64_t seed,
                const std::function<void(const SweptPicture &)> &each) {
    const classify::ShownFields fields{{trial.field}, {}};
    struct View {
        std::string name;
        glm::dquat orientation;
    };
    std::vector<View> views{{"its own view", trial.scene.camera.orientation},
                            {"front", scene::viewOrientation(scene::StandardView::front)},
                            {"top", scene::viewOrientation(scene::StandardView::top)}};
    for (const glm::dquat &view : randomViews(3, unsigned(seed)))
        views.push_back({fmt::format("random view {}", views.size() - 2), view});
    const reference::WideKernel exact(trial.field.values, trial.field.support);
    scene::Scene scene = trial.scene;
    std::vector<std::vector<double>> truths;
    for (const View &view : views) {
        scene.camera.orientation = view.orientation;
        truths.push_back(exact.image(scene.camera, scene.image));
    }
    for (const double tolerance : tolerances) {
        scene.tolerance = tolerance;
        scene.camera.orientation = views.front().orientation;
        const auto prepared = prepare::prepareEngine({scene, fields});
        for (std::size_t view = 0; view < views.size(); ++view) {
            scene.camera.orientation = views[view].orientation;
            const auto picture = prepared.engine->render(scene.camera, scene.image);
            SweptPicture swept{.name = fmt::format("{}, {}, pixel {:.2f} mm, tolerance {:.2g}",
                                                   trial.fieldName, views[view].name,
                                                   scene.camera.pixelMm, tolerance),
                               .tolerance = tolerance,
                               .planned = prepared.plan.predictedError};
            swept.stated =
                prepare::measuredError(*prepared.engine, fields, scene.camera, scene.image);
            swept.measured = compare(picture.samples, truths[view]).relativeL2;
            each(swept);
        }
    }
}

} // namespace

void sweep(int fields, std::uint64_t seed, const std::function<void(const SweptPicture &)> &each) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const int start = int(random() % fieldKinds);
    for (int n = 0; n < fields; ++n) {
        Candidate candidate;
        for (std::size_t gene = 0; gene < Candidate::geneCount; ++gene)
            candidate.genes.push_back(uniform(random));
        candidate.genes[0] = ((n + start) % fieldKinds + 0.5) / fieldKinds;
        sweepField(trialOf(candidate, PictureKind::whole), random(), each);
    }
}

} // namespace pellucid::bench
