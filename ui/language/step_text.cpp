// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/step_text.h"

#include <QCoreApplication>
#include <QStringList>

#include "ui/language/names.h"
#include "ui/language/number_text.h"

namespace pellucid::ui {

namespace {

using classify::Step;
using classify::StepKind;
using classify::TissueClass;

struct StepTexts {
    Q_DECLARE_TR_FUNCTIONS(StepTexts)
};

// Listed here for lupdate: the meanings and units of parameters.
[[maybe_unused]] constexpr const char *parameters[] = {
    QT_TRANSLATE_NOOP("StepTexts", "Standard deviation"),
    QT_TRANSLATE_NOOP("StepTexts", "Half the side of the neighborhood"),
    QT_TRANSLATE_NOOP("StepTexts", "Number of iterations"),
    QT_TRANSLATE_NOOP("StepTexts", "Lower values preserve more edges"),
    QT_TRANSLATE_NOOP("StepTexts", "Standard deviation of prior smoothing"),
    QT_TRANSLATE_NOOP("StepTexts", "Minimum"),
    QT_TRANSLATE_NOOP("StepTexts", "Maximum"),
    QT_TRANSLATE_NOOP("StepTexts", "An edge continues above this"),
    QT_TRANSLATE_NOOP("StepTexts", "An edge starts above this"),
    QT_TRANSLATE_NOOP("StepTexts", "1: use ITK's filters, slower"),
    QT_TRANSLATE_NOOP("StepTexts", "Radius of the ball"),
    QT_TRANSLATE_NOOP("StepTexts", "Minimum size of a part relative to the largest"),
    QT_TRANSLATE_NOOP("StepTexts", "Not through openings narrower than this"),
    QT_TRANSLATE_NOOP("StepTexts", "Distance"),
    QT_TRANSLATE_NOOP("StepTexts", "Depth"),
    QT_TRANSLATE_NOOP("StepTexts", "Margin around the skin"),
    QT_TRANSLATE_NOOP("StepTexts", "Depth below the skin"),
    QT_TRANSLATE_NOOP("StepTexts", "Margin outside the skin"),
    QT_TRANSLATE_NOOP("StepTexts", "mm"),
    QT_TRANSLATE_NOOP("StepTexts", "value units"),
    QT_TRANSLATE_NOOP("StepTexts", "value units per mm")};

QString number(double value) {
    return numberText(value);
}

// Ends that limit nothing are left out.
QString rangeText(double low, double high) {
    const bool hasLow = low > classify::lowestValue, hasHigh = high < classify::highestValue;
    if (hasLow && hasHigh)
        return StepTexts::tr("%1 to %2").arg(number(low), number(high));
    return hasLow    ? StepTexts::tr("from %1").arg(number(low))
           : hasHigh ? StepTexts::tr("up to %1").arg(number(high))
                     : StepTexts::tr("all values");
}

QString operandText(const classify::Operand &operand) {
    if (!operand.own)
        return translatedName(operand.name);
    QStringList parts{sourceWords(*operand.own)};
    for (const Step &step : operand.own->steps)
        parts << stepWords(step);
    return "(" + parts.join(", ") + ")";
}

QString pointsText(const Step &step) {
    if (step.points.empty())
        return StepTexts::tr("connected to a point to be clicked");
    const int count = int(step.points.size());
    const double leak = step.at("leak_mm");
    return leak > 0.0
               ? StepTexts::tr("connected to %n point(s), not through openings narrower than %1 mm",
                               "", count)
                     .arg(number(leak))
               : StepTexts::tr("connected to %n point(s)", "", count);
}

} // namespace

QString stepName(StepKind kind) {
    switch (kind) {
    case StepKind::gaussian:
        return StepTexts::tr("Smooth with a Gaussian");
    case StepKind::median:
        return StepTexts::tr("Median");
    case StepKind::diffusion:
        return StepTexts::tr("Smooth along edges");
    case StepKind::gradient:
        return StepTexts::tr("Gradient");
    case StepKind::negate:
        return StepTexts::tr("Change the sign");
    case StepKind::threshold:
        return StepTexts::tr("Hard range of values");
    case StepKind::edges:
        return StepTexts::tr("Edges");
    case StepKind::binarise:
        return StepTexts::tr("Uniform density above a value");
    case StepKind::opening:
        return StepTexts::tr("Remove what is thin");
    case StepKind::closing:
        return StepTexts::tr("Close narrow gaps");
    case StepKind::largestComponent:
        return StepTexts::tr("Largest part");
    case StepKind::connected:
        return StepTexts::tr("Connected to points");
    case StepKind::grow:
        return StepTexts::tr("Grow");
    case StepKind::shrink:
        return StepTexts::tr("Shrink");
    case StepKind::fill:
        return StepTexts::tr("Fill holes");
    case StepKind::body:
        return StepTexts::tr("The patient without the couch");
    case StepKind::skin:
        return StepTexts::tr("The skin");
    case StepKind::intersection:
        return StepTexts::tr("And another class");
    case StepKind::join:
        return StepTexts::tr("Or another class");
    case StepKind::difference:
        return StepTexts::tr("Without another class");
    case StepKind::paint:
        return StepTexts::tr("Painted");
    case StepKind::scissors:
        return StepTexts::tr("Scissors");
    }
    return {};
}

QString stepWords(const Step &step) {
    const auto mm = [&](const char *parameter) { return number(step.at(parameter)); };
    switch (step.kind) {
    case StepKind::gaussian:
        return StepTexts::tr("smoothed by %1 mm").arg(mm("sigma_mm"));
    case StepKind::median:
        return StepTexts::tr("median within %1 mm").arg(mm("radius_mm"));
    case StepKind::opening:
        return StepTexts::tr("without parts thinner than %1 mm")
            .arg(number(2.0 * step.at("radius_mm")));
    case StepKind::closing:
        return StepTexts::tr("gaps up to %1 mm closed").arg(number(2.0 * step.at("radius_mm")));
    case StepKind::connected:
        return pointsText(step);
    case StepKind::grow:
        return StepTexts::tr("grown by %1 mm").arg(mm("mm"));
    case StepKind::shrink:
        return StepTexts::tr("shrunk by %1 mm").arg(mm("mm"));
    case StepKind::fill:
        return StepTexts::tr("holes filled");
    case StepKind::body:
        return StepTexts::tr("within the patient");
    case StepKind::skin:
        return StepTexts::tr("the skin only");
    case StepKind::intersection:
        return StepTexts::tr("and %1").arg(operandText(step.operand));
    case StepKind::join:
        return StepTexts::tr("or %1").arg(operandText(step.operand));
    case StepKind::difference:
        return StepTexts::tr("without %1").arg(operandText(step.operand));
    case StepKind::paint:
        return StepTexts::tr("%n stroke(s)", "", int(step.strokes.size()));
    case StepKind::scissors:
        return StepTexts::tr("%n cut(s)", "", int(step.cuts.size()));
    case StepKind::largestComponent:
        return step.at("share") < 1.0 ? StepTexts::tr("parts of at least %1 of the largest")
                                            .arg(number(step.at("share")))
                                      : StepTexts::tr("largest part");
    case StepKind::diffusion:
        return StepTexts::tr("smoothed along edges");
    case StepKind::gradient:
        return StepTexts::tr("gradient, smoothed by %1 mm").arg(mm("sigma_mm"));
    case StepKind::negate:
        return StepTexts::tr("sign changed");
    case StepKind::threshold:
        return StepTexts::tr("values %1").arg(rangeText(step.at("low"), step.at("high")));
    case StepKind::edges:
        return StepTexts::tr("edges above %1").arg(mm("high"));
    case StepKind::binarise:
        return StepTexts::tr("uniform density from %1").arg(mm("from"));
    }
    return {};
}

QString sourceWords(const TissueClass &tissue) {
    QStringList parts;
    if (!tissue.segment.empty() && tissue.segment != tissue.name)
        parts << QString::fromStdString(tissue.segment);
    if (tissue.isDrawn)
        parts << StepTexts::tr("drawn");
    if (tissue.hasRange() || parts.isEmpty())
        parts << rangeText(tissue.low, tissue.high);
    return parts.join(", ");
}

QString parameterText(const classify::StepParameter &parameter) {
    const QString text = StepTexts::tr(parameter.text.c_str());
    return parameter.unit.empty()
               ? text
               : QString("%1, %2").arg(text, StepTexts::tr(parameter.unit.c_str()));
}

} // namespace pellucid::ui
