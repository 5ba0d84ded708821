// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/presets/slicer_preset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/files/json_value_nlohmann.h"
#include "core/files/read_text.h"
#include "core/files/reasons.h"
#include "core/presets/reasons.h"
#include "core/task/error.h"

namespace pellucid::presets {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using files::JsonValue;
using nlohmann::json;
using task::Error;
using task::ErrorCode;

struct Point {
    double value, opacity;
};
using Points = std::vector<Point>;

[[noreturn]] void refuse(const task::Reason &why) {
    throw Error(ErrorCode::unusable, why);
}

// Line 7 of nine: twice the number of points, then value and opacity of each point.
Points pointsOfText(const std::string &text) {
    constexpr int opacityLine = 7;
    std::istringstream in(text);
    std::string line;
    for (int n = 0; n < opacityLine; ++n)
        if (!std::getline(in, line))
            refuse(because::atLine(n + 1, because::endsBeforeItsOpacity));
    std::istringstream numbers(line);
    // A file's decimal separator does not depend on the locale.
    numbers.imbue(std::locale::classic());
    int count = 0;
    if (!(numbers >> count) || count < 2 || count % 2 != 0 || count > 20000)
        refuse(because::atLine(opacityLine, because::opacityHasNoCount));
    Points points;
    for (int n = 0; n < count / 2; ++n) {
        Point point{};
        if (!(numbers >> point.value >> point.opacity))
            refuse(because::atLine(opacityLine, because::opacityIsShort(count, 2 * n)));
        points.push_back(point);
    }
    return points;
}

Points pointsOfJson(const std::string &text) {
    json parsed;
    try {
        parsed = json::parse(text);
    } catch (const json::exception &error) {
        refuse(because::isNoSlicerPreset(files::jsonFault(error)));
    }
    try {
        constexpr double any = std::numeric_limits<double>::max();
        const JsonValue in(parsed);
        const JsonValue component = in.at("volumeProperties").at(0).at("components").at(0);
        Points points;
        for (const JsonValue &point : component.at("scalarOpacity").at("points").elements())
            points.push_back({point.at("x").number(any), point.at("y").number(any)});
        return points;
    } catch (const Error &error) {
        refuse(because::isNoSlicerPreset(error.reason()));
    }
}

double opacityAt(const Points &points, double value) {
    if (value <= points.front().value)
        return points.front().opacity;
    for (std::size_t n = 1; n < points.size(); ++n)
        if (value <= points[n].value) {
            const Point &a = points[n - 1], &b = points[n];
            const double width = b.value - a.value;
            return width > 0.0 ? a.opacity + (b.opacity - a.opacity) * (value - a.value) / width
                               : b.opacity;
        }
    return points.back().opacity;
}

// The opacity is constant beyond its last change: the window ends there, ignoring sentinel values
// that mean "everything above".
classify::FieldWindow windowOf(const Points &points) {
    std::size_t first = 0, last = points.size() - 1;
    while (first + 1 < points.size() && points[first + 1].opacity == 0.0)
        ++first;
    while (last > first + 1 && points[last - 1].opacity == points[last].opacity)
        --last;
    return {points[first].value, points[last].value};
}

} // namespace

bool isSlicerPreset(const fs::path &path) {
    return path.extension() == ".vp" ||
           (path.extension() == ".json" && path.stem().extension() == ".vp");
}

ImportedPreset importSlicerPreset(const fs::path &path, int points) {
    try {
        const std::string text = files::readText(path, files::maxPresetBytes);
        Points curve = path.extension() == ".json" ? pointsOfJson(text) : pointsOfText(text);
        for (const Point &p : curve)
            if (!(std::abs(p.value) <= 1e30))
                refuse(because::opacityValueOutOfRange(fmt::format("{:g}", p.value)));
            else if (!(p.opacity >= 0.0 && p.opacity <= 1.0))
                refuse(because::opacityOutOfRange(fmt::format("{:g}", p.opacity),
                                                  fmt::format("{:g}", p.value)));
        std::stable_sort(curve.begin(), curve.end(),
                         [](const Point &a, const Point &b) { return a.value < b.value; });
        if (curve.size() < 2 || std::none_of(curve.begin(), curve.end(),
                                             [](const Point &p) { return p.opacity > 0.0; }))
            refuse(because::opacityIsZero);
        const classify::FieldWindow whole = windowOf(curve);
        if (!(whole.low < whole.high))
            refuse(because::opacityDoesNotChange);

        // A steep start needs density where it starts, because weights are at most 2. The window
        // may therefore start before the opacity does. The best fit is used.
        ImportedPreset imported;
        Preset &preset = imported.preset;
        preset.name = path.stem().stem().string();
        double least = std::numeric_limits<double>::infinity();
        for (const double before : {0.0, 0.125, 0.25, 0.5, 1.0}) {
            const classify::FieldWindow window{whole.low - before * (whole.high - whole.low),
                                               whole.high};
            const auto opacity = [&](double f) {
                return opacityAt(curve, window.low + f * (window.high - window.low));
            };
            // The shown quantity is f B(f), so errors are weighted by density.
            const auto fitted = classify::fitTransferFunction(
                [&](double f) { return f > 0.0 ? opacity(f) / f : 0.0; }, points,
                [](double f) { return f * f; });
            constexpr int samples = 1024;
            double square = 0.0, largest = 0.0;
            for (int n = 0; n <= samples; ++n) {
                const double f = double(n) / samples;
                const double error = f * fitted.function.at(f) - opacity(f);
                square += error * error;
                largest = std::max(largest, std::abs(error));
            }
            if (square < 0.99 * least) { // prefers the narrower window if the difference is small
                least = square;
                imported.largestError = largest;
                preset.window = window;
                preset.look.transferFunction = fitted.function;
            }
        }
        preset.notes = fmt::format("Opacity of {}, within {:.2g}", path.filename().string(),
                                   imported.largestError);
        return imported;
    } catch (const Error &error) {
        throw Error(error.code(), error.reason(), path);
    }
}

} // namespace pellucid::presets
