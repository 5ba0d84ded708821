// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/region_commands.h"

#include <QCoreApplication>

#include "core/classify/couch.h"
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

} // namespace

EditedClass editedClass(const Document &document) {
    const int selected = document.selectedClass();
    return document.marking().options().ofEveryClass || selected < 0
               ? std::nullopt
               : EditedClass(std::size_t(selected));
}

void useRegion(Document &document, const classify::TissueClass &region) {
    RegionUse use = useOf(document.marking().options(), document.marking().tool());
    EditedClass edited = editedClass(document);
    if (use == RegionUse::add && document.selectedClass() < 0)
        use = RegionUse::newClass;
    else if (use == RegionUse::add)
        edited = std::size_t(document.selectedClass());
    const bool isMade = editLook(document, textOf(use), noDrag, [&](classify::Look &look) {
        edited = classify::useRegion(look, region, use, edited, document.fieldWindow());
    });
    if (isMade)
        select(document, edited);
}

void useCut(Document &document, const classify::LassoCut &cut) {
    const RegionUse use = useOf(document.marking().options(), document.marking().tool());
    if (use == RegionUse::newClass || use == RegionUse::add) {
        useRegion(document, classify::cutRegion(cut));
        return;
    }
    classify::LassoCut made = cut;
    made.keeps = use == RegionUse::keep;
    editLook(document, RegionTexts::tr("Scissors"), noDrag, [&](classify::Look &look) {
        classify::cutClasses(look, made, editedClass(document), document.fieldWindow());
    });
}

void useStrokes(Document &document, const std::vector<classify::Stroke> &strokes) {
    const bool erases = strokes.front().erases;
    const int selected = document.selectedClass();
    // Only erasing is meant for every class.
    EditedClass edited = erases         ? editedClass(document)
                         : selected < 0 ? std::nullopt
                                        : EditedClass(std::size_t(selected));
    const QString text = erases ? RegionTexts::tr("Erase") : RegionTexts::tr("Paint");
    const bool isMade = editLook(document, text, noDrag, [&](classify::Look &look) {
        edited = classify::paintClass(look, strokes, edited, document.fieldWindow());
    });
    if (isMade)
        select(document, edited);
}

void usePoint(Document &document, volume::PatientPoint point) {
    const int selected = document.selectedClass();
    if (selected < 0)
        return;
    const bool isAnswer = classify::awaitingClass(document.scene().look).has_value();
    editLook(document, RegionTexts::tr("Point"), noDrag, [&](classify::Look &look) {
        classify::addPoint(look.classes[std::size_t(selected)], point);
    });
    if (isAnswer) // to the question, which is over or goes on with the next class
        askForPoints(document);
}

void useStep(Document &document, const classify::Step &step, const QString &text) {
    const int selected = document.selectedClass();
    if (selected >= 0)
        editLook(document, text, noDrag, [&](classify::Look &look) {
            classify::addStep(look, step, std::size_t(selected));
        });
}

void setWithoutCouch(Document &document, bool isWithout) {
    editScene(document,
              isWithout ? RegionTexts::tr("Remove the couch") : RegionTexts::tr("Show the couch"),
              noDrag, [&](scene::Scene &scene) {
                  (isWithout ? classify::removeCouch
                             : classify::restoreCouch)(scene.look, document.fieldWindow());
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
