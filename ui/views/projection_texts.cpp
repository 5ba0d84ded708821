// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_texts.h"

#include <QCoreApplication>
#include <QObject>
#include <QRegularExpression>

#include "ui/views/overlay.h"

namespace pellucid::ui {

namespace {

struct ProjectionTexts {
    Q_DECLARE_TR_FUNCTIONS(ProjectionTexts)
};

// As many digits as are meaningful.
QString errorText(double error) {
    const double percent = 100.0 * error;
    if (percent >= 100.0) // a view of almost empty space
        return QObject::tr("error over 100 %");
    return QObject::tr("error %1 %")
        .arg(percent < 1.0 ? QString::number(percent, 'f', 3) : QString::number(percent, 'g', 2));
}

QString withError(const QString &stage, const QString &error) {
    return error.isEmpty() ? stage : QObject::tr("%1, %2").arg(stage, error);
}

QString qualityText(const DescribedFrame &described) {
    // The error belongs to the picture, which may still be that of the former engine. It is not
    // computed while the view moves.
    const QString error = described.error       ? errorText(*described.error)
                          : described.isPending ? QString()
                                                : ProjectionTexts::tr("error not known yet");
    if (described.planState == PlanState::cancelled)
        return ProjectionTexts::tr("cancelled: F5 prepares it");
    if (described.planState == PlanState::failed)
        return ProjectionTexts::tr("not prepared: F5 tries again");
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

QString anglesText(const scene::PositionerAngles &angles) {
    // LAO, RAO, CRA and CAU are used in every language.
    QString text = QString::fromStdString(scene::positionerText(angles));
    return text.replace(QRegularExpression("(\\d+)"), "\\1°");
}

} // namespace pellucid::ui
