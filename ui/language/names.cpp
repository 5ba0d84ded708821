// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/names.h"

#include <QCoreApplication>

#include "ui/language/shown_text.h"

namespace pellucid::ui {

namespace {

// Listed here for lupdate.
[[maybe_unused]] constexpr const char *names[] = {
    QT_TRANSLATE_NOOP("Names", "X-ray"),
    QT_TRANSLATE_NOOP("Names", "Bone"),
    QT_TRANSLATE_NOOP("Names", "Bone over soft tissue"),
    QT_TRANSLATE_NOOP("Names", "Lung and airways"),
    QT_TRANSLATE_NOOP("Names", "Skin"),
    QT_TRANSLATE_NOOP("Names", "Contrast vessels"),
    QT_TRANSLATE_NOOP("Names", "Teeth"),
    QT_TRANSLATE_NOOP("Names", "Metal"),
    QT_TRANSLATE_NOOP("Names", "Edges over X-ray"),
    QT_TRANSLATE_NOOP("Names", "Head: bone"),
    QT_TRANSLATE_NOOP("Names", "Head: muscle"),
    QT_TRANSLATE_NOOP("Names", "Head: fluid"),
    QT_TRANSLATE_NOOP("Names", "Head: bone, muscle, fluid"),
    QT_TRANSLATE_NOOP("Names", "Chest: bone"),
    QT_TRANSLATE_NOOP("Names", "Chest: muscle"),
    QT_TRANSLATE_NOOP("Names", "Chest: fat"),
    QT_TRANSLATE_NOOP("Names", "Chest: bone, muscle, fat"),
    QT_TRANSLATE_NOOP("Names", "Bone in relief"),
    QT_TRANSLATE_NOOP("Names", "MR: X-ray-like"),
    QT_TRANSLATE_NOOP("Names", "MR: brain"),
    QT_TRANSLATE_NOOP("Names", "MR: edges"),
    QT_TRANSLATE_NOOP("Names", "Body in three lights"),
    QT_TRANSLATE_NOOP("Names", "Chest: tissues and edges"),
    QT_TRANSLATE_NOOP("Names", "Bonsai: branches"),
    QT_TRANSLATE_NOOP("Names", "Bonsai: leaves"),
    QT_TRANSLATE_NOOP("Names", "Branches"),
    QT_TRANSLATE_NOOP("Names", "Leaves"),
    QT_TRANSLATE_NOOP("Names", "Abdomen: gas, organs, bone"),
    QT_TRANSLATE_NOOP("Names", "Pelvis: bone"),
    QT_TRANSLATE_NOOP("Names", "Spine: vertebrae"),
    QT_TRANSLATE_NOOP("Names", "MR angiography: vessels"),
    QT_TRANSLATE_NOOP("Names", "PET: uptake"),
    QT_TRANSLATE_NOOP("Names", "Organs"),
    QT_TRANSLATE_NOOP("Names", "Gas"),
    QT_TRANSLATE_NOOP("Names", "Cortical bone"),
    QT_TRANSLATE_NOOP("Names", "End plates"),
    QT_TRANSLATE_NOOP("Names", "Vertebrae"),
    QT_TRANSLATE_NOOP("Names", "Vessels"),
    QT_TRANSLATE_NOOP("Names", "Uptake"),
    QT_TRANSLATE_NOOP("Names", "AP"),
    QT_TRANSLATE_NOOP("Names", "PA"),
    QT_TRANSLATE_NOOP("Names", "Left lateral"),
    QT_TRANSLATE_NOOP("Names", "Right lateral"),
    QT_TRANSLATE_NOOP("Names", "AP cranial"),
    QT_TRANSLATE_NOOP("Names", "AP caudal"),
    QT_TRANSLATE_NOOP("Names", "LAO"),
    QT_TRANSLATE_NOOP("Names", "RAO"),
    QT_TRANSLATE_NOOP("Names", "LAO cranial"),
    QT_TRANSLATE_NOOP("Names", "Spider (LAO caudal)"),
    QT_TRANSLATE_NOOP("Names", "RAO cranial"),
    QT_TRANSLATE_NOOP("Names", "RAO caudal"),
    QT_TRANSLATE_NOOP("Names", "Muscle"),
    QT_TRANSLATE_NOOP("Names", "Fluid"),
    QT_TRANSLATE_NOOP("Names", "Fat"),
    QT_TRANSLATE_NOOP("Names", "Edges"),
    QT_TRANSLATE_NOOP("Names", "Soft tissue"),
    QT_TRANSLATE_NOOP("Names", "Signal"),
    QT_TRANSLATE_NOOP("Names", "Patient"),
    QT_TRANSLATE_NOOP("Names", "Volume"),
    QT_TRANSLATE_NOOP("Names", "Region"),
    QT_TRANSLATE_NOOP("Names", "Lung"),
    QT_TRANSLATE_NOOP("Names", "Head"),
    QT_TRANSLATE_NOOP("Names", "Density"),
    QT_TRANSLATE_NOOP("Names", "Contrast"),
    QT_TRANSLATE_NOOP("Names", "Air"),
    QT_TRANSLATE_NOOP("Names", "Organ"),
    QT_TRANSLATE_NOOP("Names", "Gain"),
    QT_TRANSLATE_NOOP("Names", "Loss"),
    QT_TRANSLATE_NOOP("Names", "Body"),
    QT_TRANSLATE_NOOP("Names", "Brain"),
    QT_TRANSLATE_NOOP("Names", "Abdomen"),
    QT_TRANSLATE_NOOP("Names", "Mediastinum"),
    QT_TRANSLATE_NOOP("Names", "Stroke"),
    QT_TRANSLATE_NOOP("Names", "Subdural"),
    QT_TRANSLATE_NOOP("Names", "Angiography"),
    QT_TRANSLATE_NOOP("Names", "SUV 0 to 5"),
    QT_TRANSLATE_NOOP("Names", "SUV 0 to 10"),
    QT_TRANSLATE_NOOP("Names", "SUV 0 to 20"),
    QT_TRANSLATE_NOOP("Names", "File"),
    QT_TRANSLATE_NOOP("Names", "Auto"),
    QT_TRANSLATE_NOOP("Names", "Custom")};

} // namespace

QString translatedName(const std::string &english) {
    return shownText(QCoreApplication::translate("Names", english.c_str()));
}

} // namespace pellucid::ui
