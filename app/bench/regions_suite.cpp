// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/bench/suites.h"
#include "core/classify/region_edits.h"
#include "core/phantom/phantom.h"
#include "core/preprocess/class_region.h"
#include "core/preprocess/step_cache.h"

namespace pellucid::bench {

namespace {

using classify::Step;
using classify::StepKind;
using classify::TissueClass;

constexpr int runs = 5;
constexpr std::size_t cacheBytes = std::size_t(2) << 30;

class RegionRows {
public:
    RegionRows(const volume::Volume &volume, const Report &report)
        : m_volume(volume), m_report(report) {}

    // Finds the region of a class from nothing.
    void whole(const std::string &name, const TissueClass &tissue) {
        std::vector<double> times;
        for (int n = 0; n < runs; ++n) {
            preprocess::StepCache steps(cacheBytes);
            times.push_back(once(tissue, steps));
        }
        add(name, times);
    }

    // Adds a step to a class whose region is known.
    void step(const std::string &name, const TissueClass &known, const Step &added) {
        TissueClass next = known;
        next.steps.push_back(added);
        std::vector<double> times;
        for (int n = 0; n < runs; ++n) {
            preprocess::StepCache steps(cacheBytes);
            once(known, steps);
            times.push_back(once(next, steps));
        }
        add(name, times);
    }

private:
    double once(const TissueClass &tissue, preprocess::StepCache &steps) {
        const double start = millisecondsNow();
        m_samples = preprocess::regionOf(m_volume, tissue, steps).total();
        return millisecondsNow() - start;
    }

    void add(const std::string &name, const std::vector<double> &times) {
        Row row;
        row.suite = "regions";
        row.name = name;
        row.size = m_volume.lattice().size();
        row.prepareMs = median(times);
        row.note =
            fmt::format("{:.1f} % of the samples", 100.0 * m_samples / double(row.size.count()));
        m_report(row);
    }

    const volume::Volume &m_volume;
    const Report &m_report;
    double m_samples = 0.0;
};

} // namespace

void runRegionsSuite(const Report &report) {
    const volume::Volume volume = phantom::makePhantom(
        phantom::Kind::chest,
        phantom::phantomLattice(phantom::Kind::chest, {.size = volume::GridSize{512, 512, 300}}));
    const volume::Lattice &lattice = volume.lattice();
    const volume::GridSize size = lattice.size();
    // Soft tissue in front of the spine, and the densest sample of the middle slice.
    volume::VoxelIndex tissue{size.i / 2, size.j / 2, size.k / 2}, bone = tissue;
    for (int j = 0; j < size.j; ++j)
        for (int i = 0; i < size.i; ++i) {
            const volume::VoxelIndex n{i, j, size.k / 2};
            if (volume.value(n) > volume.value(bone))
                bone = n;
            if (volume.value(tissue) < 0.0 && volume.value(n) > 0.0 && volume.value(n) < 100.0)
                tissue = n;
        }
    const volume::PatientPoint at = lattice.patient(tissue), onBone = lattice.patient(bone);
    const TissueClass soft = classify::connectedRegion(at, -200.0, 300.0, 0.0);
    RegionRows rows(volume, report);
    rows.whole("connected, -200..300", soft);
    rows.whole("connected, every value", classify::connectedRegion(at, -1e4, 1e4, 0.0));
    rows.whole("connected, leak limit 5 mm", classify::connectedRegion(at, -200.0, 300.0, 5.0));
    rows.whole("bone with marrow", classify::boneRegion(lattice, onBone, 200.0));
    Step stroke{StepKind::paint}, cut{StepKind::scissors}, without{StepKind::difference};
    stroke.strokes = {{{at, onBone}, 10.0, false}};
    classify::LassoCut lasso{{}, {0.0, 0.8, 0.6}, {}, false};
    for (int corner = 0; corner < 200; ++corner) {
        const double angle = corner * 3.14159265358979 / 100.0;
        lasso.outline.push_back({lattice.center().mm +
                                 glm::dvec3(90.0 * std::cos(angle), 60.0 * std::sin(angle), 0.0)});
    }
    cut.cuts = {lasso};
    without.operand.own =
        std::make_shared<const TissueClass>(classify::connectedRegion(onBone, 200.0, 4000.0, 0.0));
    rows.step("and a stroke", soft, stroke);
    rows.step("and a cut of 200 corners", soft, cut);
    rows.step("and grown by 3 mm", soft, {StepKind::grow, {{"mm", 3.0}}});
    rows.step("and its holes filled", soft, {StepKind::fill});
    rows.step("and without a connected region", soft, without);
}

} // namespace pellucid::bench
