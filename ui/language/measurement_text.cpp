// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/measurement_text.h"

#include <QCoreApplication>

namespace pellucid::ui {

namespace {

struct MeasurementTextTexts {
    Q_DECLARE_TR_FUNCTIONS(MeasurementTextTexts)
};

QString valueText(double value, volume::ValueUnit unit) {
    // Values without a unit may have any magnitude.
    return unit == volume::ValueUnit::hounsfield ? QString::number(value, 'f', 1)
                                                 : QString::number(value, 'g', 5);
}

QString areaText(double mm2, bool hasSpacing) {
    if (!hasSpacing)
        return MeasurementTextTexts::tr("%1 square pixels").arg(mm2, 0, 'f', 0);
    return mm2 < 100.0 ? MeasurementTextTexts::tr("%1 mm²").arg(mm2, 0, 'f', 1)
                       : MeasurementTextTexts::tr("%1 cm²").arg(mm2 / 100.0, 0, 'f', 2);
}

QString unitText(volume::ValueUnit unit) {
    return unit == volume::ValueUnit::hounsfield ? QString(" HU") : QString();
}

} // namespace

QString kindText(measure::Kind kind) {
    switch (kind) {
    case measure::Kind::distance:
        return MeasurementTextTexts::tr("Distance");
    case measure::Kind::angle:
        return MeasurementTextTexts::tr("Angle");
    case measure::Kind::ellipse:
        return MeasurementTextTexts::tr("Ellipse");
    case measure::Kind::rectangle:
        return MeasurementTextTexts::tr("Rectangle");
    case measure::Kind::projectedDistance:
        break;
    }
    return MeasurementTextTexts::tr("Projected distance");
}

QString mainFigure(const measure::Result &result, const volume::Volume &volume) {
    const volume::ValueUnit unit = volume.unit();
    const bool hasSpacing = volume.notes().hasSpacing;
    if (result.lengthMm)
        return (hasSpacing ? MeasurementTextTexts::tr("%1 mm")
                           : MeasurementTextTexts::tr("%1 pixels"))
            .arg(*result.lengthMm, 0, 'f', 1);
    if (result.angleDegrees)
        return MeasurementTextTexts::tr("%1°").arg(*result.angleDegrees, 0, 'f', 1);
    if (result.values)
        return valueText(result.values->mean, unit) + unitText(unit);
    return result.areaMm2 ? areaText(*result.areaMm2, hasSpacing) : QString();
}

QStringList allFigures(const measure::Measurement &measurement, const measure::Result &result,
                       const volume::Volume &volume) {
    const volume::ValueUnit unit = volume.unit();
    if (!result.areaMm2) {
        QStringList lines{mainFigure(result, volume)};
        if (measurement.kind == measure::Kind::projectedDistance)
            lines << MeasurementTextTexts::tr("in the picture, depth not measured");
        return lines;
    }
    QStringList lines;
    if (result.values) {
        const measure::RegionValues &v = *result.values;
        lines << MeasurementTextTexts::tr("mean %1%2").arg(valueText(v.mean, unit), unitText(unit))
              << MeasurementTextTexts::tr("SD %1").arg(valueText(v.standardDeviation, unit))
              << MeasurementTextTexts::tr("%1 to %2")
                     .arg(valueText(v.minimum, unit), valueText(v.maximum, unit));
    } else {
        lines << MeasurementTextTexts::tr("outside the volume");
    }
    return lines << areaText(*result.areaMm2, volume.notes().hasSpacing);
}

} // namespace pellucid::ui
