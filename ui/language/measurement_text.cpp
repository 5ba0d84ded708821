// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/measurement_text.h"

#include <QCoreApplication>

#include "ui/language/number_text.h"

namespace pellucid::ui {

namespace {

struct MeasurementTextTexts {
    Q_DECLARE_TR_FUNCTIONS(MeasurementTextTexts)
};

QString valueText(double value, volume::ValueUnit unit) {
    // Other values may have any magnitude.
    return unit == volume::ValueUnit::hounsfield ? QString::number(value, 'f', 1)
                                                 : numberText(value, 5);
}

// The lengths of radiographs are not those in the patient.
QString withPlace(const QString &size, volume::SpacingPlace place) {
    const QString text = spacingPlaceText(place);
    return text.isEmpty() ? size : size + " " + text;
}

QString areaText(double mm2, const volume::VolumeNotes &notes) {
    if (!notes.hasSpacing)
        return MeasurementTextTexts::tr("%1 square pixels").arg(mm2, 0, 'f', 0);
    return withPlace(mm2 < 100.0 ? MeasurementTextTexts::tr("%1 mm²").arg(mm2, 0, 'f', 1)
                                 : MeasurementTextTexts::tr("%1 cm²").arg(mm2 / 100.0, 0, 'f', 2),
                     notes.spacingPlace);
}

} // namespace

QString spacingPlaceText(volume::SpacingPlace place) {
    switch (place) {
    case volume::SpacingPlace::detector:
        return MeasurementTextTexts::tr("at the detector");
    case volume::SpacingPlace::magnified:
        return MeasurementTextTexts::tr("magnification estimated");
    case volume::SpacingPlace::geometry:
        return MeasurementTextTexts::tr("corrected for magnification");
    case volume::SpacingPlace::calibrated:
        return MeasurementTextTexts::tr("calibrated");
    case volume::SpacingPlace::patient:
        break;
    }
    return {};
}

QString kindText(const measure::Measurement &m) {
    switch (m.kind) {
    case measure::Kind::distance:
        return m.isProjected ? MeasurementTextTexts::tr("Projected distance")
                             : MeasurementTextTexts::tr("Distance");
    case measure::Kind::polyline:
        return m.isProjected ? MeasurementTextTexts::tr("Projected polyline")
                             : MeasurementTextTexts::tr("Polyline");
    case measure::Kind::angle:
        return m.isProjected ? MeasurementTextTexts::tr("Projected angle")
                             : MeasurementTextTexts::tr("Angle");
    case measure::Kind::cobbAngle:
        return m.isProjected ? MeasurementTextTexts::tr("Projected Cobb angle")
                             : MeasurementTextTexts::tr("Cobb angle");
    case measure::Kind::ellipse:
        return MeasurementTextTexts::tr("Ellipse");
    case measure::Kind::rectangle:
        return MeasurementTextTexts::tr("Rectangle");
    case measure::Kind::arrow:
        return MeasurementTextTexts::tr("Arrow");
    case measure::Kind::text:
        break;
    }
    return MeasurementTextTexts::tr("Text");
}

QString mainFigure(const measure::Result &result, const volume::Volume &volume) {
    const volume::ValueUnit unit = volume.unit();
    const volume::VolumeNotes &notes = volume.notes();
    if (result.lengthMm && !notes.hasSpacing)
        return MeasurementTextTexts::tr("%1 pixels").arg(*result.lengthMm, 0, 'f', 1);
    if (result.lengthMm)
        return withPlace(MeasurementTextTexts::tr("%1 mm").arg(*result.lengthMm, 0, 'f', 1),
                         notes.spacingPlace);
    if (result.angleDegrees)
        return MeasurementTextTexts::tr("%1°").arg(*result.angleDegrees, 0, 'f', 1);
    if (result.values)
        return valueText(result.values->mean, unit) + unitSuffix(unit);
    return result.areaMm2 ? areaText(*result.areaMm2, notes) : QString();
}

QStringList allFigures(const measure::Measurement &measurement, const measure::Result &result,
                       const volume::Volume &volume) {
    const volume::ValueUnit unit = volume.unit();
    if (!result.areaMm2) {
        if (measure::isAnnotation(measurement.kind))
            return {QString::fromStdString(measurement.name)};
        QStringList lines{mainFigure(result, volume)};
        if (measurement.isProjected)
            lines << MeasurementTextTexts::tr("in the picture, depth not measured");
        return lines;
    }
    QStringList lines;
    if (result.values) {
        const measure::RegionValues &v = *result.values;
        lines
            << MeasurementTextTexts::tr("mean %1%2").arg(valueText(v.mean, unit), unitSuffix(unit))
            << MeasurementTextTexts::tr("SD %1").arg(valueText(v.standardDeviation, unit))
            << MeasurementTextTexts::tr("%1 to %2")
                   .arg(valueText(v.minimum, unit), valueText(v.maximum, unit));
    } else {
        lines << MeasurementTextTexts::tr("outside the volume");
    }
    return lines << areaText(*result.areaMm2, volume.notes());
}

} // namespace pellucid::ui
