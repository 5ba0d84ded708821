// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/exposure.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "core/picture/compose.h"
#include "core/picture/contrast.h"
#include "core/picture/display.h"

namespace pellucid::picture {

namespace {

constexpr int exposureSide = 320; // pixels
// The body is what is brighter than this share of its bright quantile. Below the same share, a
// display fades to black.
constexpr double airShare = 0.05;
constexpr double darkQuantile = 0.01, brightQuantile = 0.99;
// The greys that the quantiles of the displayed body become.
constexpr double darkGrey = 0.06, brightGrey = 0.96, medianGrey = 0.55;
constexpr double minExponent = 0.8, maxExponent = 1.4;
// Structures of 2 mm are fine in a human; a smaller body has finer ones.
constexpr double humanFineMm = 2.0, humanRadiusMm = 100.0;

double quantile(std::vector<float> &values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

// A picture that the exposure is measured from, and the limit above which its pixels are body.
struct Measured {
    Measured(const ProjectionImage &image, Background background, double outlineMm2)
        : picture(image) {
        values = brightnessOf(image);
        float most = 0.0F;
        for (const float value : values)
            most = std::max(most, value);
        // Less is error: a picture of the default tolerance is off by up to 2e-3 of its brightest
        // pixel.
        const double leastSeen = 4e-3 * double(most);
        // Air first: it is no measure of the body's brightness.
        std::vector<float> seen = valuesAbove(leastSeen);
        if (seen.empty())
            return;
        const double bright = quantile(seen, brightQuantile);
        if (background == Background::measured)
            axis.air = airBeside(leastSeen, bright, outlineMm2);
        const double leastOfBody = axis.air + airShare * (bright - axis.air);
        std::vector<float> body = valuesAbove(leastOfBody);
        axis.dark = quantile(body, darkQuantile);
        axis.bright = quantile(body, brightQuantile);
        if (!(axis.bright > axis.dark))
            axis.dark = axis.air; // every pixel has the same value
        least = leastOfBody;
    }

    bool isEmpty() const { return least == 0.0; }
    std::vector<float> valuesAbove(double limit) const {
        std::vector<float> above;
        for (const float value : values)
            if (double(value) > limit)
                above.push_back(value);
        return above;
    }

    // The level at the left and the right of what is seen. If it is not much lower than the body,
    // it is the body, which the volume cuts off.
    double airBeside(double limit, double bright, double outlineMm2) const {
        constexpr double quarter = 0.25, half = 0.5, mostOfBright = 0.5, mostOfAColumn = 0.6,
                         mostOfAll = 0.9, rising = 1.05;
        int first = picture.width, last = -1, top = picture.height, bottom = -1;
        for (int r = 0; r < picture.height; ++r)
            for (int c = 0; c < picture.width; ++c)
                if (double(at(r, c)) > limit) {
                    first = std::min(first, c);
                    last = std::max(last, c);
                    top = std::min(top, r);
                    bottom = r;
                }
        // The outermost columns also contain the edge of the volume.
        int inward = std::max(3, (last - first) / 20);
        if (last - first <= 4 * inward)
            return 0.0;
        const auto besideAt = [&](int columns) {
            std::vector<float> beside;
            for (int r = 0; r < picture.height; ++r)
                for (const int c : {first + columns, last - columns})
                    if (double(at(r, c)) > limit)
                        beside.push_back(at(r, c));
            return beside;
        };
        const auto isTall = [&](const std::vector<float> &beside, double part) {
            return double(beside.size()) >= part * 2.0 * double(bottom - top + 1);
        };
        std::vector<float> beside = besideAt(inward);
        double share = quarter;
        // Air fills the volume, or a part of it from top to bottom; a body without air does not.
        // The outer columns of an oblique volume only show its corners: they are short, and
        // brighter farther inward.
        const int step = inward;
        const auto isOfCorners = [&] {
            std::vector<float> farther = besideAt(inward + step);
            return !isTall(beside, mostOfAll) ||
                   (!farther.empty() && quantile(farther, half) > rising * quantile(beside, half));
        };
        const double seenMm2 =
            double(valuesAbove(limit).size()) * picture.pixelMm * picture.pixelMm;
        if (outlineMm2 > 0.0 && seenMm2 > mostOfAll * outlineMm2)
            for (; 4 * inward < last - first && isOfCorners(); ++inward) {
                beside = besideAt(inward);
                share = half;
            }
        if (beside.empty() || !isTall(beside, mostOfAColumn))
            return 0.0;
        // Where the volume is cut off, its interpolation overshoots.
        constexpr double overshoot = 1.1;
        const double air = overshoot * quantile(beside, share);
        return air < mostOfBright * bright ? air : 0.0;
    }
    float at(int row, int column) const {
        return values[std::size_t(row) * std::size_t(picture.width) + std::size_t(column)];
    }

    const ProjectionImage &picture;
    Samples values;
    double least = 0.0; ///< of the body
    scene::Exposure::Axis axis;
};

double airFadeOf(const scene::Exposure::Axis &axis) {
    return airShare * (axis.bright - axis.air);
}

Contrast contrastOf(const scene::Exposure::Axis &axis, double detail, double latitude,
                    double fineMm) {
    return {detail, latitude, axis.bright, 0.5 * (axis.dark + axis.bright), fineMm};
}

// The picture's grey values, contrast included, without those of air.
std::vector<float> processedBody(const Measured &measured, const Contrast &contrast) {
    if (contrast.isOff())
        return measured.valuesAbove(measured.least);
    Display display;
    display.contrast = contrast;
    display.air = measured.axis.air;
    display.airFade = airFadeOf(measured.axis);
    const ContrastCorrection correction(measured.picture, display);
    const auto width = std::size_t(measured.picture.width);
    std::vector<float> body, row(width + std::size_t(ContrastCorrection::slack));
    for (int r = 0; r < measured.picture.height; ++r) {
        correction.row(r, row.data());
        const float *const values = measured.values.data() + std::size_t(r) * width;
        for (std::size_t c = 0; c < width; ++c)
            if (double(values[c]) > measured.least)
                body.push_back(values[c] + row[c]);
    }
    return body;
}

// The range whose ends give two values these greys.
ToneRange rangeOf(double dark, double bright) {
    const double perGrey = (bright - dark) / (brightGrey - darkGrey);
    return {dark - darkGrey * perGrey, dark + (1.0 - darkGrey) * perGrey};
}

scene::Exposure::Axis displayedAxis(const Measured &measured, const Contrast &contrast) {
    scene::Exposure::Axis axis = measured.axis;
    if (measured.isEmpty())
        return axis;
    std::vector<float> body = processedBody(measured, contrast);
    const double dark = quantile(body, darkQuantile), bright = quantile(body, brightQuantile);
    const double median = quantile(body, 0.5);
    const ToneRange range = bright > dark ? rangeOf(dark, bright) : ToneRange{0.0, bright};
    axis.low = range.low;
    axis.high = range.high;
    const double grey = (median - range.low) / (range.high - range.low);
    axis.exponent = std::clamp(std::log(medianGrey) / std::log(std::clamp(grey, 0.01, 0.99)),
                               minExponent, maxExponent);
    return axis;
}

// The median of absolute differences between a picture's means over `sizeMm` and twice that, over
// the bright quantile: how much fine detail there is.
double fineAmplitude(const Measured &measured, double sizeMm) {
    const int side = std::max(1, int(std::lround(sizeMm / measured.picture.pixelMm)));
    const int width = measured.picture.width / side, height = measured.picture.height / side;
    std::vector<double> means(std::size_t(width) * std::size_t(height));
    for (int r = 0; r < height * side; ++r)
        for (int c = 0; c < width * side; ++c)
            means[std::size_t(r / side) * std::size_t(width) + std::size_t(c / side)] +=
                double(measured.at(r, c)) / double(side * side);
    std::vector<float> differences;
    const auto at = [&](int r, int c) {
        return means[std::size_t(r) * std::size_t(width) + std::size_t(c)];
    };
    for (int r = 1; r + 1 < height; ++r)
        for (int c = 1; c + 1 < width; ++c) {
            double around = 0.0, least = at(r, c);
            for (int dr = -1; dr <= 1; ++dr)
                for (int dc = -1; dc <= 1; ++dc) {
                    around += at(r + dr, c + dc) / 9.0;
                    least = std::min(least, at(r + dr, c + dc));
                }
            if (least > measured.least) // not the edge of the body
                differences.push_back(float(std::abs(at(r, c) - around)));
        }
    return differences.empty() ? 0.0 : quantile(differences, 0.5) / measured.axis.bright;
}

// The spread of thickness between large parts of the body, over the bright quantile.
double thicknessSpread(const Measured &measured, double sizeMm) {
    const int side = std::max(1, int(std::lround(sizeMm / measured.picture.pixelMm)));
    std::vector<float> means;
    for (int r = 0; r + side <= measured.picture.height; r += side)
        for (int c = 0; c + side <= measured.picture.width; c += side) {
            double sum = 0.0;
            int inside = 0;
            for (int dr = 0; dr < side; ++dr)
                for (int dc = 0; dc < side; ++dc) {
                    const double value = measured.at(r + dr, c + dc);
                    sum += value > measured.least ? value : 0.0;
                    inside += value > measured.least ? 1 : 0;
                }
            if (2 * inside > side * side)
                means.push_back(float(sum / inside));
        }
    return means.size() < 2 ? 0.0
                            : (quantile(means, 0.9) - quantile(means, 0.1)) / measured.axis.bright;
}

// Automatic detail: a picture with less fine detail is amplified more. Automatic latitude: the more
// thickness differs, the more it is compressed.
constexpr double typicalAmplitude = 0.011, defaultDetail = 0.5, detailPerOctave = 0.4;
constexpr double minAutomaticDetail = 0.3, maxAutomaticDetail = 0.8;
constexpr double keptSpread = 0.2, latitudePerOctave = 1.0 / 1.5;
constexpr double minLatitude = 0.25, maxLatitude = 1.0;

template <class F> double meanOf(const std::vector<Measured> &pictures, const F &measure) {
    double sum = 0.0;
    int count = 0;
    for (const Measured &picture : pictures)
        if (!picture.isEmpty()) {
            sum += measure(picture);
            ++count;
        }
    return count == 0 ? 0.0 : sum / count;
}

double automaticDetail(const std::vector<Measured> &pictures, double fineMm) {
    const double amplitude =
        meanOf(pictures, [&](const Measured &p) { return fineAmplitude(p, 2.0 * fineMm); });
    if (!(amplitude > 0.0))
        return defaultDetail;
    return std::clamp(defaultDetail + detailPerOctave * std::log2(typicalAmplitude / amplitude),
                      minAutomaticDetail, maxAutomaticDetail);
}

double automaticLatitude(const std::vector<Measured> &pictures, double fineMm) {
    const double spread =
        meanOf(pictures, [&](const Measured &p) { return thicknessSpread(p, 16.0 * fineMm); });
    return std::clamp(latitudePerOctave * std::log2(std::max(spread, 1e-3) / keptSpread),
                      minLatitude, maxLatitude);
}

scene::Exposure exposureOf(const std::vector<Measured> &pictures, double radiusMm,
                           const scene::Tone &tone) {
    scene::Exposure exposure;
    exposure.fineMm = humanFineMm * std::min(1.0, radiusMm / humanRadiusMm);
    exposure.detail = tone.detail ? *tone.detail : automaticDetail(pictures, exposure.fineMm);
    exposure.latitude =
        tone.latitude ? *tone.latitude : automaticLatitude(pictures, exposure.fineMm);
    for (std::size_t n = 0; n < exposure.axes.size(); ++n) {
        const Measured &picture = pictures[std::min(n, pictures.size() - 1)];
        exposure.axes[n] = displayedAxis(
            picture, contrastOf(picture.axis, exposure.detail, exposure.latitude, exposure.fineMm));
    }
    return exposure;
}

// Between the axes: mixed by the squares of the line of sight.
scene::Exposure::Axis seenAlong(const scene::Exposure &exposure, const glm::dquat &orientation) {
    const glm::dvec3 sight = glm::mat3_cast(orientation)[2];
    scene::Exposure::Axis seen{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int n = 0; n < 3; ++n) {
        const scene::Exposure::Axis &axis = exposure.axes[std::size_t(n)];
        const double share = sight[n] * sight[n];
        seen.air += share * axis.air;
        seen.dark += share * axis.dark;
        seen.bright += share * axis.bright;
        seen.low += share * axis.low;
        seen.high += share * axis.high;
        seen.exponent += share * axis.exponent;
    }
    return seen;
}

Display displayWith(const scene::Tone &tone, const ToneRange &automatic) {
    Display display;
    display.range = {tone.low.value_or(automatic.low), tone.high.value_or(automatic.high)};
    if (!(display.range.high > display.range.low))
        display.range.high = display.range.low + 1.0;
    display.inverted = tone.inverted;
    return display;
}

// Widens a box by the body's part of a picture.
void include(const Measured &measured, const glm::dquat &orientation, glm::dvec3 &low,
             glm::dvec3 &high) {
    const ProjectionImage &picture = measured.picture;
    const glm::dmat3 axes = glm::mat3_cast(orientation);
    const auto add = [&](const glm::dvec3 &axis, double mm) {
        for (int n = 0; n < 3; ++n)
            if (std::abs(axis[n]) > 0.5) {
                low[n] = std::min(low[n], axis[n] * mm);
                high[n] = std::max(high[n], axis[n] * mm);
            }
    };
    const double halfPixel = 0.5 * picture.pixelMm;
    for (int r = 0; r < picture.height; ++r)
        for (int c = 0; c < picture.width; ++c)
            if (double(measured.at(r, c)) > measured.least) {
                const double u = (c - 0.5 * (picture.width - 1)) * picture.pixelMm,
                             v = (0.5 * (picture.height - 1) - r) * picture.pixelMm;
                for (const double side : {-halfPixel, halfPixel}) {
                    add(axes[0], u + side);
                    add(axes[1], v + side);
                }
            }
}

} // namespace

double outlineMm2(const volume::Lattice &lattice, const glm::dquat &orientation) {
    // The outline of a parallelepiped is made of its edges, as seen.
    const glm::dvec3 sight = glm::mat3_cast(orientation)[2];
    const auto edge = [&](int axis) { return lattice.step(axis) * double(lattice.size()[axis]); };
    double area = 0.0;
    for (int n = 0; n < 3; ++n)
        area += std::abs(glm::dot(glm::cross(edge(n), edge((n + 1) % 3)), sight));
    return area;
}

scene::Exposure measureExposure(Projector &projector, const volume::Lattice &lattice,
                                const scene::ImageDefinition &image,
                                const shading::Shading &shading, const scene::Tone &tone,
                                Background background) {
    constexpr std::array views{scene::StandardView::left, scene::StandardView::front,
                               scene::StandardView::top};
    const double radiusMm = lattice.radiusMm();
    std::array<ProjectionImage, 3> pictures;
    for (std::size_t n = 0; n < views.size(); ++n) {
        scene::Camera camera;
        camera.orientation = scene::viewOrientation(views[n]);
        camera.width = camera.height = exposureSide;
        camera.pixelMm = 2.0 * radiusMm / exposureSide;
        pictures[n] = projector.render(camera, image, shading);
    }
    std::vector<Measured> measured;
    for (std::size_t n = 0; n < views.size(); ++n)
        measured.emplace_back(pictures[n], background,
                              outlineMm2(lattice, scene::viewOrientation(views[n])));
    scene::Exposure exposure = exposureOf(measured, radiusMm, tone);
    if (std::none_of(measured.begin(), measured.end(),
                     [](const Measured &one) { return one.isEmpty(); })) {
        glm::dvec3 low(radiusMm), high(-radiusMm);
        for (std::size_t n = 0; n < views.size(); ++n)
            include(measured[n], scene::viewOrientation(views[n]), low, high);
        exposure.lowMm = low;
        exposure.highMm = high;
    }
    return exposure;
}

Background backgroundOf(const volume::Volume &volume) {
    return volume.unit() == volume::ValueUnit::hounsfield ? Background::zero : Background::measured;
}

scene::Exposure exposureOf(const ProjectionImage &picture, const scene::Tone &tone,
                           Background background, double outlineMm2) {
    return exposureOf({Measured(picture, background, outlineMm2)},
                      0.5 * picture.pixelMm * std::max(picture.width, picture.height), tone);
}

Display displayOf(const scene::Tone &tone, const glm::dquat &orientation) {
    const scene::Exposure &exposure = tone.exposure.value();
    const scene::Exposure::Axis seen = seenAlong(exposure, orientation);
    Display display = displayWith(tone, {seen.low, seen.high});
    display.exponent = seen.exponent;
    display.contrast = contrastOf(seen, exposure.detail, exposure.latitude, exposure.fineMm);
    display.air = seen.air;
    display.airFade = airFadeOf(seen);
    // A window that the user narrows also shows what is faint.
    if (tone.low || tone.high)
        display.airFade =
            std::min(display.airFade, airShare * (display.range.high - display.range.low));
    return display;
}

Display plainDisplayOf(const scene::Tone &tone, const glm::dquat &orientation) {
    const scene::Exposure &exposure = tone.exposure.value();
    const scene::Exposure::Axis seen = seenAlong(exposure, orientation);
    const Contrast contrast = contrastOf(seen, exposure.detail, exposure.latitude, exposure.fineMm);
    // The user's ends are values after the compression of large differences.
    const auto before = [&](double value) {
        return contrast.middle + (value - contrast.middle) / largestScaleFactor(contrast);
    };
    scene::Tone plain = tone;
    if (tone.low)
        plain.low = before(*tone.low);
    if (tone.high)
        plain.high = before(*tone.high);
    return displayWith(plain, {seen.air, seen.bright});
}

} // namespace pellucid::picture
