// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "core/files/json_lines_nlohmann.h"
#include "core/scene/positioner_angles.h"
#include "core/scene/reasons.h"
#include "core/scene/view_list_nlohmann.h"

namespace pellucid::scene {

namespace {

namespace because = task::because;
using files::JsonValue;

ProjectionMatrix matrixFrom(const JsonValue &in) {
    if (in.size() != 3)
        in.refuse(because::mustBeThreeRowsOfFour);
    ProjectionMatrix matrix{};
    for (std::size_t row = 0; row < 3; ++row)
        matrix[row] = in.at(row).fourNumbers();
    in.checked([&] { pixelMmOf(matrix); });
    return matrix;
}

constexpr files::JsonWords<StandardView, 6> standardViews{{{"front", StandardView::front},
                                                           {"back", StandardView::back},
                                                           {"left", StandardView::left},
                                                           {"right", StandardView::right},
                                                           {"top", StandardView::top},
                                                           {"bottom", StandardView::bottom}}};

} // namespace

ViewList::View viewFrom(const JsonValue &in) {
    if (in.isObject())
        in.requireOnly({"matrix", "primary_deg", "secondary_deg", "roll_deg"});
    if (!in.isObject()) {
        const std::string text = in.text();
        for (const auto &[word, view] : standardViews)
            if (text == word)
                return {viewOrientation(view), {}};
        return {in.checked([&] { return orientationOf(positionerAnglesFromText(text)); }), {}};
    }
    if (const JsonValue matrix = in["matrix"]) {
        in.requireOnly({"matrix"});
        return {{}, matrixFrom(matrix)};
    }
    const auto degrees = [&](const char *name, double largest) {
        const JsonValue angle = in[name];
        return angle ? angle.number(largest) : 0.0;
    };
    const ViewAngles angles{in.at("primary_deg").number(360.0), degrees("secondary_deg", 90.0),
                            degrees("roll_deg", 360.0)};
    return {viewOrientation(StandardView::front, angles), {}};
}

ViewList viewListFrom(const JsonValue &in) {
    in.requireOnly({"views", "size", "pixel_mm"});
    ViewList list;
    if (const JsonValue size = in["size"])
        list.size = size.wholeNumbers<2>(1, largestImageSize);
    if (const JsonValue pixel = in["pixel_mm"]) {
        list.pixelMm = pixel.number();
        if (!(*list.pixelMm > 0.0))
            pixel.refuse(because::pixelMustBePositive);
    }
    for (const JsonValue &each : in.at("views").elements()) {
        list.views.push_back(viewFrom(each));
        if (list.views.back().matrix && !list.size)
            in.refuse(because::matricesNeedASize);
        each.checked([&] { agreeOnPixel(list); });
    }
    if (list.views.empty())
        in["views"].refuse(because::mustNotBeEmpty);
    return list;
}

ViewList viewListFromJson(const std::string &text) {
    return files::readJson(text, viewListFrom);
}

} // namespace pellucid::scene
