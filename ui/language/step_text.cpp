// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/step_text.h"

#include <QCoreApplication>
#include <QStringList>

#include "ui/language/names.h"

namespace pellucid::ui {

namespace {

using classify::Step;
using classify::StepKind;
using classify::TissueClass;

struct StepTexts {
    Q_DECLARE_TR_FUNCTIONS(StepTexts)
};

// Listed here for lupdate: what parameters mean.
[[maybe_unused]] constexpr const char *parameters[] = {
    QT_TRANSLATE_NOOP("StepTexts", "Standard deviation"),
    QT_TRANSLATE_NOOP("StepTexts", "Half the side of the neighbourhood"),
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
    QT_TRANSLATE_NOOP("StepTexts", "Margin outside the skin")};

QString number(double value) {
    return QString::number(value, 'g', 5);
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
        return StepTexts::tr("connected with a point to be clicked");
    const int count = int(step.points.size());
    const double leak = step.at("leak_mm");
    return leak > 0.0
               ? StepTexts::tr("connected with %n point(s), not through less than %1 mm", "", count)
                     .arg(number(leak))
               : StepTexts::tr("connected with %n point(s)", "", count);
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
        return StepTexts::tr("One density above a value");
    case StepKind::opening:
        return StepTexts::tr("Remove what is thin");
    case StepKind::closing:
        return StepTexts::tr("Close narrow gaps");
    case StepKind::largestComponent:
        return StepTexts::tr("Largest part");
    case StepKind::connected:
        return StepTexts::tr("Connected with points");
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
    case StepKind::gradient:
    case StepKind::negate:
    case StepKind::threshold:
    case StepKind::edges:
    case StepKind::binarise:
        break;
    }
    // Their numbers are read by those who know the kinds.
    return QString::fromStdString(classify::stepText(step));
}

QString sourceWords(const TissueClass &tissue) {
    QStringList parts;
    if (!tissue.segment.empty() && tissue.segment != tissue.name)
        parts << QString::fromStdString(tissue.segment);
    if (tissue.isDrawn)
        parts << StepTexts::tr("drawn");
    if (tissue.low > classify::lowestValue && tissue.high < classify::highestValue)
        parts << QString("%1 .. %2").arg(number(tissue.low), number(tissue.high));
    else if (tissue.low > classify::lowestValue)
        parts << StepTexts::tr("from %1").arg(number(tissue.low));
    else if (tissue.high < classify::highestValue)
        parts << StepTexts::tr("up to %1").arg(number(tissue.high));
    else if (parts.isEmpty())
        parts << StepTexts::tr("all values");
    return parts.join(", ");
}

QString parameterText(const classify::StepParameter &parameter) {
    const QString text = StepTexts::tr(parameter.text.c_str());
    return parameter.unit.empty()
               ? text
               : QString("%1, %2").arg(text, QString::fromStdString(parameter.unit));
}

} // namespace pellucid::ui
