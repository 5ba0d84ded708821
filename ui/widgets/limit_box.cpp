// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/limit_box.h"

#include <algorithm>
#include <cmath>

namespace pellucid::ui {

namespace {

// Numbers from here on limit nothing.
constexpr double farthest = 1e9;

} // namespace

LimitBox::LimitBox(const char *name, double low, double high, double scale, QWidget *parent)
    : QDoubleSpinBox(parent) {
    setObjectName(name);
    setRange(low, high);
    setDecimals(std::clamp(int(std::ceil(3.0 - std::log10(std::max(scale, 1e-9)))), 1, 9));
    setSingleStep(std::max(scale, 1e-9) / 200.0);
}

void LimitBox::setNumber(double value) {
    m_given = value;
    setValue(value);
    m_shown = this->value();
}

double LimitBox::exact() const {
    return value() == m_shown ? m_given : value();
}

bool LimitBox::isNoLimit(double value) const {
    return (value <= -farthest && minimum() <= -farthest) ||
           (value >= farthest && maximum() >= farthest);
}

void LimitBox::stepBy(int steps) {
    if (isNoLimit(value()))
        setValue(0.0);
    else
        QDoubleSpinBox::stepBy(steps);
}

QString LimitBox::noLimit() {
    return tr("no limit");
}

QString LimitBox::textFromValue(double value) const {
    return isNoLimit(value) ? noLimit() : QDoubleSpinBox::textFromValue(value);
}

double LimitBox::valueFromText(const QString &text) const {
    if (text.contains(noLimit()))
        return value() > 0.0 ? maximum() : minimum();
    return QDoubleSpinBox::valueFromText(text);
}

QValidator::State LimitBox::validate(QString &text, int &at) const {
    return text.contains(noLimit()) ? QValidator::Acceptable : QDoubleSpinBox::validate(text, at);
}

} // namespace pellucid::ui
