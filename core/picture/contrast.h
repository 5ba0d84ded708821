// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/picture/display.h"
#include "core/picture/projection_image.h"

namespace pellucid::picture {

/// The response of multi-scale contrast to structures of one size. An amplitude x, relative to the
/// brightness of the thickest part, becomes amplification x (1 + (x/knee)^2)^-bend.
struct BandCurve {
    double amplification = 1.0, bend = 0.0;
    static constexpr double knee = 0.01;
};
/// `sizeMm`: of the band's pixels.
BandCurve bandCurve(const Contrast &contrast, double sizeMm);
/// The weight of Contrast::middle in the means of the coarsest grid.
inline constexpr double middleWeight = 0.001;
/// The factor of differences between the largest structures.
double largestScaleFactor(const Contrast &contrast);

/// The grids of the processing, the same on the processor and on the card. The finest is the image
/// itself or means of 2 x 2 or 4 x 4 pixels: pixels much smaller than what counts as fine
/// detail have none of their own. Each next grid has half as many pixels a side, rounded up.
struct ContrastGrids {
    ContrastGrids(int imageWidth, int imageHeight, double pixelMm, const Contrast &contrast);
    int factor = 1; ///< pixels of the image a side of one of the finest grid
    struct Grid {
        int width = 0, height = 0;
        double pixelMm = 1.0;
    };
    std::vector<Grid> grids; ///< from fine to coarse
};

/// The body's share of a pixel: what its value is above `level`, times `scale`, from 0 to 1.
struct AirRamp {
    float level = 0.0F, scale = 1.0F;
};
AirRamp airRampOf(const Display &display);

/// The correction that multi-scale contrast adds to a picture's brightness. The pyramid averages
/// only the body, so edges against air have no halo: the body's share of a pixel rises from 0 to 1
/// over `airFade`. In air, the correction is arbitrary.
class ContrastCorrection {
public:
    /// The image must outlive it. *Requires*: the display's contrast is not off.
    ContrastCorrection(const ProjectionImage &image, const Display &display);
    ~ContrastCorrection();

    /// The correction of a row of pixels. *Shape*: `to`: the image's width plus `slack`.
    void row(int row, float *to) const;
    static constexpr int slack = 64;

private:
    class Pyramid;
    std::unique_ptr<const Pyramid> m_pyramid;
};

} // namespace pellucid::picture
