// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/region_commands.h"

#include <QCoreApplication>

#include "ui/document/commands.h"
#include "ui/document/document.h"

namespace pellucid::ui {

namespace {

using classify::EditedClass;
using classify::RegionUse;

struct RegionTexts {
    Q_DECLARE_TR_FUNCTIONS(RegionTexts)
};

QString textOf(RegionUse use) {
    switch (use) {
    case RegionUse::newClass:
        return RegionTexts::tr("New region");
    case RegionUse::add:
        return RegionTexts::tr("Add region");
    case RegionUse::keep:
        return RegionTexts::tr("Keep region");
    case RegionUse::remove:
        return RegionTexts::tr("Remove region");
    }
    return {};
}

void select(Document &document, const EditedClass &edited) {
    if (edited)
        document.selectClass(int(*edited));
}

bool isFull(const Document &document) {
    return document.scene().look.classes.size() >= classify::maxClasses;
}

} // namespace

EditedClass editedClass(const Document &document) {
    const int selected = document.selectedClass();
    return document.marking().options().ofEveryClass || selected < 0
               ? std::nullopt
               : EditedClass(std::size_t(selected));
}

void useRegion(Document &document, const classify::TissueClass &region) {
    RegionUse use = document.marking().options().use;
    EditedClass edited = editedClass(document);
    if (use == RegionUse::add && document.selectedClass() < 0)
        use = RegionUse::newClass;
    else if (use == RegionUse::add)
        edited = std::size_t(document.selectedClass());
    if (use == RegionUse::newClass && isFull(document))
        return;
    editScene(document, textOf(use), noDrag, [&](scene::Scene &scene) {
        edited = classify::useRegion(scene.look, region, use, edited, document.fieldWindow());
    });
    select(document, edited);
}

void useCut(Document &document, const classify::LassoCut &cut) {
    const RegionUse use = document.marking().options().use;
    if (use == RegionUse::newClass || use == RegionUse::add) {
        useRegion(document, classify::cutRegion(cut));
        return;
    }
    classify::LassoCut made = cut;
    made.keeps = use == RegionUse::keep;
    editScene(document, RegionTexts::tr("Scissors"), noDrag, [&](scene::Scene &scene) {
        classify::cutClasses(scene.look, made, editedClass(document), document.fieldWindow());
    });
}

void useStroke(Document &document, const classify::Stroke &stroke) {
    EditedClass edited = editedClass(document);
    if (!edited && !stroke.erases && isFull(document))
        return;
    editScene(document, stroke.erases ? RegionTexts::tr("Erase") : RegionTexts::tr("Paint"), noDrag,
              [&](scene::Scene &scene) {
                  edited =
                      classify::paintClass(scene.look, stroke, edited, document.fieldWindow());
              });
    select(document, edited);
}

void usePoint(Document &document, volume::PatientPoint point) {
    const int selected = document.selectedClass();
    if (selected < 0)
        return;
    editScene(document, RegionTexts::tr("Point"), noDrag, [&](scene::Scene &scene) {
        classify::addPoint(scene.look.classes[std::size_t(selected)], point);
    });
    askForPoints(document);
}

void useStep(Document &document, const classify::Step &step, const QString &text) {
    const int selected = document.selectedClass();
    if (selected >= 0)
        editScene(document, text, noDrag, [&](scene::Scene &scene) {
            classify::addStep(scene.look, step, std::size_t(selected));
        });
}

void askForPoints(Document &document) {
    const auto awaiting = classify::awaitingClass(document.scene().look);
    RegionOptions options = document.marking().options();
    if (awaiting) {
        document.selectClass(int(*awaiting));
        options.addsPoints = true;
        document.marking().setOptions(options);
        document.marking().requestTool(RegionTool::connected);
    } else if (options.addsPoints) {
        options.addsPoints = false;
        document.marking().setOptions(options);
    }
}

} // namespace pellucid::ui
