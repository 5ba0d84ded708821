// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/number_text.h"

#include <algorithm>
#include <cmath>

namespace pellucid::ui {

QString numberText(double value, int digits) {
    constexpr int maxDecimals = 9;
    if (!std::isfinite(value))
        return QString::number(value);
    if (value == 0.0)
        return "0";
    const int whole = int(std::floor(std::log10(std::abs(value)))) + 1;
    const int decimals = std::clamp(digits - whole, 0, maxDecimals);
    QString text = QString::number(value, 'f', decimals);
    if (text.contains('.')) {
        while (text.endsWith('0'))
            text.chop(1);
        if (text.endsWith('.'))
            text.chop(1);
    }
    return text == "-0" ? QString("0") : text;
}

QString unitText(volume::ValueUnit unit) {
    const auto name = volume::unitName(unit);
    return QString::fromUtf8(name.data(), qsizetype(name.size()));
}

QString unitSuffix(volume::ValueUnit unit) {
    const QString text = unitText(unit);
    return text.isEmpty() ? text : " " + text;
}

} // namespace pellucid::ui
