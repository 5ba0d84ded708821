// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "app/bench/look_rows.h"
#include "core/classify/shown_fields.h"
#include "core/reference/shaded_field.h"

namespace pellucid::bench {

namespace {

// Classes side by side in HU, in different colors.
classify::Look coloredClasses(std::size_t count) {
    constexpr double low = -1000.0, high = 2000.0;
    classify::Look look;
    for (std::size_t n = 0; n < count; ++n) {
        const double from = low + (high - low) * double(n) / double(count);
        const double hue = double(n) / double(count);
        look.classes.push_back({fmt::format("class {}", n),
                                from,
                                from + (high - low) / double(count),
                                5.0,
                                1.0,
                                {hue, 0.5, 1.0 - hue}});
    }
    return look;
}

// Frames of many classes in turns with those of three: both take one image for each of red, green
// and blue.
void reportMany(const Report &report, const LookSubject &subject) {
    constexpr int views = 96;
    scene::Camera camera = subject.scene.camera;
    camera.orientation = randomViews(1, 11).front();
    const auto fieldsOf = [&](std::size_t count) {
        return classify::shownFields(subject.volume, subject.window, coloredClasses(count),
                                     nullptr);
    };
    const auto three = prepare::prepareEngine({subject.scene, fieldsOf(3)});
    for (const std::size_t count : {std::size_t(24), std::size_t(104)}) {
        const double start = millisecondsNow();
        const classify::ShownFields fields = fieldsOf(count);
        const auto many = prepare::prepareEngine({subject.scene, fields});
        Row row = plannedRow("classes", fmt::format("{} colored classes, settled", count),
                             subject.volume.lattice().size(), many.plan, subject.scene, 0);
        row.prepareMs = millisecondsNow() - start;
        row.bytes = double(many.bytes);
        const double threeMs =
            fillTimesInTurns(row, *many.engine, *three.engine, subject.scene, views);
        row.note = fmt::format("{:.2f} of the frame of 3 colored classes ({:.1f} ms)",
                               row.frameMs.value_or(0.0) / threeMs, threeMs);
        fillError(row, compare(many.engine->render(camera, subject.scene.image).samples,
                               reference::shadedImage(fields, {}, camera, subject.scene.image)));
        report(row);
    }
}

} // namespace

void runClassesSuite(const Report &report) {
    for (const int side : {128, 256}) {
        const LookSubject subject(side);
        reportLook(report, "classes", "default plain density", subject, {}, "");
        classify::Look bent;
        bent.transferFunction.weights = {0.0, 0.5, 2.0, 1.0, 0.5, 2.0};
        reportLook(report, "classes", "default six points", subject, bent, "");
        classify::Look classes;
        for (std::size_t n = 0; n < 8; ++n) {
            classes.classes.push_back(classify::standardClasses()[n]);
            classes.classes.back().weight = 0.4 + 0.1 * double(n);
        }
        reportLook(report, "classes", "default eight classes", subject, classes, "");
        reportMany(report, subject);
    }
}

} // namespace pellucid::bench
