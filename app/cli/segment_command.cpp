// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/json_text.h"
#include "app/cli/look_options.h"
#include "app/cli/scene_options.h"
#include "app/cli/segment_options.h"
#include "app/cli/terminal.h"
#include "core/measure/measurement.h"
#include "core/preprocess/class_region.h"
#include "core/preprocess/region_growing.h"
#include "core/preprocess/segment_class.h"
#include "core/preprocess/step_cache.h"
#include "core/segment/reasons.h"
#include "core/segment/write_segmentation.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using nlohmann::json;
using task::Error;
using task::ErrorCode;

// Two classes may share the steps of one.
constexpr std::size_t budgetOfSteps = std::size_t(1) << 30;

struct Options {
    InputOptions input;
    SceneOptions scene; ///< only --class, --preset, --segmentation, --segment and --point
    std::vector<std::string> seeds;
    std::string out, between, name = "region";
    double leakMm = 0.0;
    bool json = false;
};

Error usage(const std::string &text) {
    return {ErrorCode::usage, because::inWords(text)};
}

// The segments that a run writes, made from classes and from seeds.
class SegmentRun {
public:
    SegmentRun(const Options &options, const Context &context)
        : m_options(options), m_progress(context.stop), m_context(context) {}

    void run() {
        const fs::path out(m_options.out);
        if (out.extension() != ".dcm" && out.extension() != ".nrrd")
            throw usage("-o: '" + m_options.out + "' must end in .dcm or .nrrd");
        if (m_options.seeds.empty() && m_options.scene.classes.empty() &&
            m_options.scene.preset.empty() && m_options.scene.segmentations.empty())
            throw usage("name what to write: --grow, --class, --preset or --segmentation");
        const auto preset = presetFor(m_options.scene);
        m_input = openInput(m_options.input, {out}, m_context);
        const auto loaded = loadSegments(m_options.scene.segmentations, {out}, volume(), m_context);
        classify::Look look;
        if (preset)
            look = presets::lookFor(
                *preset, preset->window.value_or(classify::defaultFieldWindow(volume())));
        changeLook(look, m_options.scene);
        if (loaded)
            showSegments(look, m_options.scene, *loaded);
        addPoints(look, m_options.scene.points, volume().lattice());
        Stopwatch watch;
        preprocess::StepCache steps(budgetOfSteps);
        preprocess::ClassRunner runner(steps, loaded);
        for (const classify::TissueClass &tissue : classify::withOperands(look))
            add(preprocess::segmentOf(volume(), tissue, loaded.get(), runner, m_progress));
        if (!m_options.seeds.empty())
            addGrown();
        if (m_segments.empty())
            throw Error(ErrorCode::unusable, because::noSegmentInTheVolume, m_options.input.path);
        m_findMs = watch.lapMs();
        write(out);
        m_writeMs = watch.lapMs();
        if (m_options.json)
            print();
    }

private:
    const volume::Volume &volume() const { return m_input.loaded.volume; }

    void addGrown() {
        preprocess::Growth growth;
        const auto range = parseNumbers("--between", m_options.between, ',', 2);
        growth.low = range[0];
        growth.high = range[1];
        growth.leakMm = m_options.leakMm;
        for (const std::string &text : m_options.seeds) {
            const auto mm = parseNumbers("--grow", text, ',', 3);
            const glm::dvec3 v =
                glm::round(volume().lattice().voxel({glm::dvec3(mm[0], mm[1], mm[2])}).v);
            const volume::GridSize n = volume().lattice().size();
            if (!(v.x >= 0.0 && v.y >= 0.0 && v.z >= 0.0 && v.x < n.i && v.y < n.j && v.z < n.k))
                throw usage("--grow: " + text + " is outside the volume");
            growth.seeds.push_back({int(v.x), int(v.y), int(v.z)});
        }
        segment::Segment segment;
        segment.name = m_options.name;
        segment.coverage = std::make_shared<const volume::Coverage>(preprocess::regionOf(
            volume().lattice().size(), preprocess::grownRegion(volume(), growth, m_progress)));
        segment.volumeMm3 = segment.coverage->total() * volume().lattice().cellVolumeMm3();
        add(std::move(segment));
    }

    void add(segment::Segment segment) {
        if (segment.coverage->isEmpty())
            warn("no sample belongs to '" + segment.name + "'");
        else
            m_segments.push_back(std::move(segment));
    }

    void write(const fs::path &out) {
        if (out.extension() == ".nrrd") {
            const auto counts =
                segment::writeLabels(out, m_segments, volume().lattice(), m_progress);
            for (std::size_t n = 0; n < counts.size(); ++n) {
                m_segments[n].volumeMm3 = double(counts[n]) * volume().lattice().cellVolumeMm3();
                if (counts[n] == 0)
                    warn("no sample is at least half inside '" + m_segments[n].name +
                         "', so it has no label");
            }
            return;
        }
        segment::writeSegmentation(out, m_segments, volume().lattice(),
                                   {m_input.labels, volume().notes().frameOfReferenceUid},
                                   m_progress);
    }

    void print() const {
        json segments = json::array();
        for (const segment::Segment &segment : m_segments) {
            json one = {{"name", segment.name}, {"volume_ml", segment.volumeMm3 / 1000.0}};
            if (const auto values = measure::valuesOf(volume(), *segment.coverage)) {
                one["samples"] = values->count;
                one["mean"] = values->mean;
                one["standard_deviation"] = values->standardDeviation;
                one["minimum"] = values->minimum;
                one["maximum"] = values->maximum;
            }
            segments.push_back(std::move(one));
        }
        std::puts(jsonText({{"segments", segments},
                            {"series", m_input.seriesUid},
                            {"times_ms",
                             {{"scan", m_input.scanMs},
                              {"load", m_input.loadMs},
                              {"find", m_findMs},
                              {"write", m_writeMs}}}})
                      .c_str());
    }

    const Options &m_options;
    task::Progress m_progress;
    const Context &m_context;
    Input m_input;
    double m_findMs = 0.0, m_writeMs = 0.0;
    std::vector<segment::Segment> m_segments;
};

} // namespace

void addSegmentCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand(
        "segment", "Write parts of a volume as a DICOM segmentation or as labels in NRRD");
    addInputOptions(*c, o->input);
    c->add_option("-o,--output", o->out, "File to write: .dcm (DICOM SEG) or .nrrd (labels)")
        ->required();
    c->add_option("--preset", o->scene.preset,
                  "Write the classes of a preset: a name in the library, or a preset file")
        ->check(notEmpty());
    c->add_option("--class", o->scene.classes,
                  "NAME[:#rrggbb]: write a standard class; may be repeated")
        ->allow_extra_args(false);
    CLI::Option *segmentation =
        c->add_option("--segmentation", o->scene.segmentations,
                      "Write the segments of a file, placed on the volume; may be repeated")
            ->check(notEmpty())
            ->allow_extra_args(false);
    c->add_option("--segment", o->scene.segments,
                  "NAME[:#rrggbb]: write only the named segments; '*' in NAME stands for any "
                  "characters; may be repeated")
        ->allow_extra_args(false)
        ->needs(segmentation);
    addPointOption(*c, o->scene.points);
    CLI::Option *grow =
        c->add_option("--grow", o->seeds,
                      "x,y,z: write what is connected with this point in patient space (LPS, mm) "
                      "and has values within --between; may be repeated")
            ->allow_extra_args(false);
    CLI::Option *between =
        c->add_option("--between", o->between, "LO,HI: value range in which --grow spreads")
            ->needs(grow);
    grow->needs(between);
    c->add_option("--leak-mm", o->leakMm,
                  "Do not grow through openings narrower than this; default 0")
        ->check(CLI::Range(0.0, 100.0))
        ->needs(grow);
    c->add_option("--name", o->name, "Name of the segment of --grow; default region")
        ->check(notEmpty())
        ->needs(grow);
    c->add_flag("--json", o->json, "Print a report as one JSON object");
    o->scene.weightsAreOptional = true;
    c->callback([o, context] { naming(o->input.path, [&] { SegmentRun(*o, context).run(); }); });
}

} // namespace pellucid::cli
