// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_texts.h"

#include <algorithm>
#include <cmath>

#include <QCoreApplication>
#include <QObject>
#include <QRegularExpression>

#include "ui/views/overlay.h"

namespace pellucid::ui {

namespace {

struct ProjectionTexts {
    Q_DECLARE_TR_FUNCTIONS(ProjectionTexts)
};

// Two digits are meaningful.
QString percentText(double share) {
    const double percent = 100.0 * share;
    if (percent >= 100.0)
        return ProjectionTexts::tr("over 100 %");
    const int decimals =
        percent > 0.0 ? std::clamp(1 - int(std::floor(std::log10(percent))), 0, 6) : 0;
    return ProjectionTexts::tr("%1 %").arg(QString::number(percent, 'f', decimals));
}

QString withError(const QString &stage, const QString &error) {
    return error.isEmpty() ? stage : QObject::tr("%1, %2").arg(stage, error);
}

QString qualityText(const DescribedFrame &described) {
    // The error belongs to the picture, which may still be that of the former engine. It is not
    // computed while the view moves.
    const QString error = described.error
                              ? ProjectionTexts::tr("error %1").arg(errorFigure(*described.error))
                          : described.isPending ? QString()
                                                : ProjectionTexts::tr("error not known yet");
    if (described.planState == PlanState::cancelled)
        return ProjectionTexts::tr("cancelled (F5 to recompute)");
    if (described.planState == PlanState::failed)
        return ProjectionTexts::tr("failed (F5 to try again)");
    if (described.stage == EngineStage::coarse)
        return withError(ProjectionTexts::tr("coarse"), error);
    if (described.stage == EngineStage::live)
        return withError(ProjectionTexts::tr("live"), error);
    if (described.planState == PlanState::underway)
        return ProjectionTexts::tr("error not known yet");
    return error;
}

} // namespace

QString figuresText(const DescribedFrame &described) {
    const RenderedFrame &frame = described.frame;
    return QString("%1  %2  %3")
        .arg(QString(frame.onCard ? "GPU" : "CPU"), millisecondsText(frame.times.totalMs()),
             frame.draft ? ProjectionTexts::tr("draft") : qualityText(described));
}

QString errorFigure(const error::StatedError &error) {
    const QString figure = percentText(error.relative);
    return error.isMeasured() ? ProjectionTexts::tr("%1 measured").arg(figure)
                              : QString::fromUtf8("\xe2\x89\xa4 %1").arg(figure);
}

QString errorExplanation(const error::StatedError &error) {
    if (!error.isMeasured())
        return ProjectionTexts::tr(
            "The picture differs from the exact one by at most this fraction "
            "(relative L2 error). The error is measured when the view stops moving.");
    const QString interval =
        ProjectionTexts::tr("%1 to %2").arg(percentText(error.low), percentText(error.high));
    return ProjectionTexts::tr(
               "The picture differs from the exact one by %1 (with 98 % confidence by %2), "
               "measured at %n frequencies of this study.",
               nullptr, error.frequencies)
        .arg(percentText(error.relative), interval);
}

QString anglesText(const scene::PositionerAngles &angles) {
    // LAO, RAO, CRA and CAU are used in every language.
    QString text = QString::fromStdString(scene::positionerText(angles));
    return text.replace(QRegularExpression("(\\d+)"), "\\1°");
}

} // namespace pellucid::ui
