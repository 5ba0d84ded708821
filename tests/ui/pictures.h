// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include <QImage>

/// Pictures of the screen as numbers.
namespace pellucid::test {

/// The mean grey value, 0 to 255.
inline double meanGrey(const QImage &image) {
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            sum += qGray(image.pixel(x, y));
    return sum / (double(image.width()) * image.height());
}

inline double meanGrey(const QImage &image, const QRect &area) {
    return meanGrey(image.copy(area));
}

/// The mean range of a pixel's red, green and blue, 0 to 255; 0: the picture is grey.
inline double colorfulness(const QImage &image) {
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const QRgb p = image.pixel(x, y);
            sum +=
                std::max({qRed(p), qGreen(p), qBlue(p)}) - std::min({qRed(p), qGreen(p), qBlue(p)});
        }
    return sum / (double(image.width()) * image.height());
}

/// The share of pixels whose grey values differ by more than 8; 1 if the sizes differ.
inline double changed(const QImage &a, const QImage &b) {
    if (a.size() != b.size())
        return 1.0;
    qint64 count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            count += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))) > 8 ? 1 : 0;
    return double(count) / (double(a.width()) * a.height());
}

} // namespace pellucid::test
