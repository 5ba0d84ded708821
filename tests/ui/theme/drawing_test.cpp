// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme/drawing.h"

#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include <QDir>
#include <QFile>
#include <QImage>
#include <QPainter>

#include <gtest/gtest.h>

namespace pellucid {

namespace {

constexpr int side = 240;

QImage picture(const QString &elements) {
    QImage image(side, side, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    ui::Drawing(("<svg viewBox=\"0 0 24 24\" fill=\"#000000\">" + elements + "</svg>").toUtf8())
        .paint(painter, QRectF(0, 0, side, side));
    return image;
}

QImage path(const QString &data) {
    return picture("<path d=\"" + data + "\"/>");
}

// The painted area. *Units*: of the drawing.
double area(const QImage &image) {
    double sum = 0.0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            sum += qAlpha(image.pixel(x, y)) / 255.0;
    return sum * 24.0 * 24.0 / side / side;
}

// The largest difference of two pixels' opacities.
int difference(const QImage &a, const QImage &b) {
    int largest = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            largest = std::max(largest, std::abs(qAlpha(a.pixel(x, y)) - qAlpha(b.pixel(x, y))));
    return largest;
}

} // namespace

TEST(Drawing, ShapesHaveTheirAreas) {
    constexpr double pi = std::numbers::pi;
    // Qt flattens curves to within a quarter of a pixel, 0.025 here, and paints 256 opacities.
    EXPECT_NEAR(area(picture("<circle cx=\"12\" cy=\"12\" r=\"8\"/>")), 64.0 * pi, 0.4);
    EXPECT_NEAR(area(picture("<ellipse cx=\"12\" cy=\"12\" rx=\"9\" ry=\"3\"/>")), 27.0 * pi, 0.4);
    EXPECT_NEAR(area(picture("<rect x=\"2\" y=\"4\" width=\"20\" height=\"10\" rx=\"2\"/>")),
                200.0 - (4.0 - pi) * 4.0, 0.4);
    EXPECT_NEAR(area(picture("<path fill=\"none\" stroke=\"#000000\" stroke-width=\"2\" "
                             "d=\"M4 12h16\"/>")),
                32.0, 0.1);
    EXPECT_NEAR(area(picture("<rect fill-opacity=\"0.5\" width=\"24\" height=\"24\"/>")), 288.0,
                2.3);
}

TEST(Drawing, PathsSayTheSameInManyWays) {
    const QImage square = path("M4 4L20 4L20 20L4 20Z");
    for (const char *const same : {"m4 4l16 0l0 16l-16 0z", "M4,4H20V20H4z", "M4 4h16v16h-16z",
                                   "M4 4 20 4 20 20 4 20", "m4 4 16 0 0 16-16 0", "M4 4h+16v16H4"})
        EXPECT_EQ(difference(path(same), square), 0) << same;
    EXPECT_EQ(difference(path("M2 12c0-8 10-8 10 0s10 8 10 0"),
                         path("M2 12C2 4 12 4 12 12C12 20 22 20 22 12")),
              0);
    EXPECT_EQ(difference(path("M.5.5 10.5.5 10.5 9z"), path("M0.5 0.5L10.5 0.5L10.5 9Z")), 0);
}

TEST(Drawing, ArcsArePartsOfEllipses) {
    // Edges are smoothed: a shift by 0.01 of a pixel changes an opacity by 3 of 255.
    const QImage disc = picture("<circle cx=\"12\" cy=\"12\" r=\"8\"/>");
    for (const char *const same :
         {"M4 12a8 8 0 0 1 16 0a8 8 0 0 1-16 0", "M4 12A8 8 0 1 0 20 12A8 8 0 1 0 4 12",
          "M12 4a8 8 0 1 1-8 8a8 8 0 0 1 8-8", "M20 12a8 8 0 10-16 0a8 8 0 1016 0"})
        EXPECT_LE(difference(path(same), disc), 3) << same;
    // One whose radius is too small reaches its end as a half circle.
    EXPECT_LE(difference(path("M4 12a2 2 0 0 1 16 0"), path("M4 12a8 8 0 0 1 16 0")), 0);
    // The four arcs between two points.
    constexpr double pi = std::numbers::pi, quarter = 16.0 * pi - 32.0, most = 48.0 * pi + 32.0;
    EXPECT_NEAR(area(path("M12 4a8 8 0 0 1 8 8")), quarter, 0.4);
    EXPECT_NEAR(area(path("M12 4a8 8 0 1 0 8 8")), most, 0.6);
}

TEST(Drawing, WhatItDoesNotKnowIsNotDrawnWrong) {
    for (const char *const bad :
         {"<line x1=\"1\"/>", "<text>a</text>", "<path d=\"M1 1Q2 2 3 3\"/>", "<path d=\"M1 1h\"/>",
          "<path d=\"M1 1h2z5\"/>"})
        EXPECT_THROW(picture(bad), std::logic_error) << bad;
}

TEST(Drawing, EveryIconIsDrawn) {
    const QDir icons(PELLUCID_SOURCE "/resources/icons");
    const QStringList names = icons.entryList({"*.svg"});
    EXPECT_GT(names.size(), 30);
    for (const QString &name : names) {
        QFile file(icons.filePath(name));
        ASSERT_TRUE(file.open(QIODevice::ReadOnly));
        QByteArray drawing = file.readAll();
        drawing.replace("currentColor", "#000000");
        QImage image(side, side, QImage::Format_ARGB32_Premultiplied);
        image.fill(Qt::transparent);
        QPainter painter(&image);
        ui::Drawing(drawing).paint(painter, QRectF(0, 0, side, side));
        painter.end();
        EXPECT_GT(area(image), 5.0) << name.toStdString();
    }
}

} // namespace pellucid
