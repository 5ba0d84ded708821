// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/region_bar.h"

#include <vector>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QSignalBlocker>

#include "ui/document/document.h"
#include "ui/language/names.h"
#include "ui/language/shown_text.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

using classify::RegionUse;

constexpr double maxLeakMm = 100.0, maxSlabMm = 500.0;
enum Where { selectedClass, everyClass };
// After the uses of a region, for the tool that clicks points.
constexpr int addsPoint = 4;

// A number that is being typed must not be written again.
void setNumber(QDoubleSpinBox &box, double value) {
    if (box.value() != value)
        box.setValue(value);
}

// The texts of a box and their data. An open list stays open while nothing changes.
struct Entry {
    QString text;
    int data = 0;
};
void setEntries(QComboBox &box, const std::vector<Entry> &entries, int chosen) {
    bool isSame = box.count() == int(entries.size());
    for (int n = 0; isSame && n < box.count(); ++n)
        isSame = box.itemText(n) == entries[std::size_t(n)].text;
    if (!isSame) {
        box.clear();
        for (const Entry &entry : entries)
            box.addItem(entry.text, entry.data);
    }
    box.setCurrentIndex(box.findData(chosen));
}

} // namespace

RegionBar::RegionBar(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_use(new QComboBox), m_where(new QComboBox),
      m_text(new PlainLabel), m_found(new PlainLabel), m_erases(new QCheckBox(tr("Erase"))),
      m_isBone(new QCheckBox(tr("Bone"))) {
    setPanelBackground(*this, "regionBar");
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(12, 4, 12, 4);
    row->setSpacing(8);
    m_text->setProperty("role", "muted");
    m_text->setMinimumWidth(20);
    m_use->setObjectName("regionUseBox");
    m_use->setAccessibleName(tr("Use of the region"));
    m_use->setToolTip(tr("What the region does to the classes"));
    m_where->setObjectName("regionClassBox");
    m_where->setAccessibleName(tr("Classes that the region changes"));
    m_where->setToolTip(plainToolTip(m_where->accessibleName()));
    m_erases->setObjectName("eraseBox");
    m_erases->setToolTip(tr("The brush erases; hold Shift to paint"));
    m_isBone->setObjectName("regionBoneBox");
    m_isBone->setToolTip(tr("All bone connected to the click, with its marrow and rim; drag up for "
                            "less dense bone"));
    m_found->setObjectName("regionFound");
    row->addWidget(m_use);
    row->addWidget(m_where);
    m_leak = makeNumber("regionLeakBox", tr("Leak limit"),
                        tr("Narrowest passage the region may grow through"), 0.0, maxLeakMm,
                        &RegionOptions::leakMm);
    m_ball = makeNumber("regionBallBox", tr("Radius"),
                        tr("Radius of the brush (Shift+wheel over a plane)"),
                        classify::smallestBallMm, classify::largestBallMm, &RegionOptions::ballMm);
    m_slab =
        makeNumber("regionSlabBox", tr("Slab"), tr("Thickness of the cut, about the crosshair"),
                   0.0, maxSlabMm, &RegionOptions::slabMm);
    m_slab->setSpecialValueText(tr("Whole depth"));
    for (QDoubleSpinBox *box : {m_leak, m_ball, m_slab})
        row->addWidget(box);
    row->addWidget(m_erases);
    row->addWidget(m_isBone);
    row->addWidget(m_text, 1);
    row->addWidget(m_found);

    connect(m_use, &QComboBox::activated, this, [this] {
        const int chosen = m_use->currentData().toInt();
        change([&](RegionOptions &options) {
            options.addsPoints = chosen == addsPoint;
            if (chosen != addsPoint)
                useOf(options, m_document.marking().tool()) = RegionUse(chosen);
        });
    });
    connect(m_where, &QComboBox::activated, this, [this] {
        const bool isEvery = m_where->currentData().toInt() == everyClass;
        change([&](RegionOptions &options) { options.ofEveryClass = isEvery; });
    });
    connect(m_erases, &QCheckBox::toggled, this,
            [this](bool isOn) { change([&](RegionOptions &options) { options.erases = isOn; }); });
    connect(m_isBone, &QCheckBox::toggled, this,
            [this](bool isOn) { change([&](RegionOptions &options) { options.isBone = isOn; }); });
    const RegionMarking &marking = document.marking();
    for (const auto changed :
         {&RegionMarking::toolChanged, &RegionMarking::optionsChanged, &RegionMarking::tintChanged})
        connect(&marking, changed, this, &RegionBar::showMarking);
    document.whenever(Change::scene | Change::selection, this, &RegionBar::showMarking);
    showMarking();
}

QDoubleSpinBox *RegionBar::makeNumber(const char *name, const QString &text, const QString &tip,
                                      double low, double high, double RegionOptions::*number) {
    auto *box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setAccessibleName(text);
    box->setToolTip(plainToolTip(tip));
    box->setPrefix(text + " ");
    box->setDecimals(1);
    box->setRange(low, high);
    box->setValue(m_document.marking().options().*number); // before it can change the options
    box->setSuffix(tr(" mm"));
    connect(box, &QDoubleSpinBox::valueChanged, this, [this, number](double value) {
        change([&](RegionOptions &options) { options.*number = value; });
    });
    return box;
}

void RegionBar::change(const std::function<void(RegionOptions &)> &edit) {
    RegionOptions options = m_document.marking().options();
    edit(options);
    m_document.marking().setOptions(options);
}

void RegionBar::showClasses() {
    const int selected = m_document.selectedClass();
    const QSignalBlocker quiet(m_where);
    std::vector<Entry> entries;
    if (selected < 0)
        entries.push_back({tr("in the whole volume"), selectedClass});
    else
        entries = {{tr("in %1").arg(translatedName(
                        m_document.scene().look.classes[std::size_t(selected)].name)),
                    selectedClass},
                   {tr("in every class"), everyClass}};
    setEntries(*m_where, entries,
               m_document.marking().options().ofEveryClass && selected >= 0 ? everyClass
                                                                            : selectedClass);
}

void RegionBar::showMarking() {
    const RegionMarking &marking = m_document.marking();
    const RegionOptions &options = marking.options();
    const RegionTool tool = marking.tool();
    setVisible(tool != RegionTool::none && m_document.volume().has_value());
    const RegionUse use = useOf(options, tool);
    const bool grows = tool == RegionTool::connected, paints = tool == RegionTool::paint,
               cuts = tool == RegionTool::scissors;
    {
        const QSignalBlocker quiet(m_use);
        std::vector<Entry> entries{{tr("New class"), int(RegionUse::newClass)},
                                   {tr("Add to the class"), int(RegionUse::add)},
                                   {tr("Keep only the region"), int(RegionUse::keep)},
                                   {tr("Remove the region"), int(RegionUse::remove)}};
        const int selected = m_document.selectedClass();
        const bool takesPoints =
            selected >= 0 &&
            classify::takesPoints(m_document.scene().look.classes[std::size_t(selected)]);
        if (grows && takesPoints)
            entries.push_back({tr("Add a point"), addsPoint});
        setEntries(*m_use, entries,
                   grows && takesPoints && options.addsPoints ? addsPoint
                                                              : int(useOf(options, tool)));
    }
    showClasses();
    const bool addsPoints = grows && m_use->currentData().toInt() == addsPoint;
    m_use->setVisible(!paints);
    m_where->setVisible(paints
                            ? options.erases
                            : !addsPoints && (use == RegionUse::keep || use == RegionUse::remove));
    m_leak->setVisible(grows && !addsPoints && !options.isBone);
    m_isBone->setVisible(grows && !addsPoints);
    m_ball->setVisible(paints);
    m_erases->setVisible(paints);
    m_slab->setVisible(cuts);
    const QSignalBlocker quietLeak(m_leak), quietBall(m_ball), quietSlab(m_slab),
        quietErase(m_erases), quietBone(m_isBone);
    setNumber(*m_leak, options.leakMm);
    setNumber(*m_ball, options.ballMm);
    setNumber(*m_slab, options.slabMm);
    m_erases->setChecked(options.erases);
    m_isBone->setChecked(options.isBone);
    const int selected = m_document.selectedClass();
    const QString selectedName =
        selected < 0 ? QString()
                     : translatedName(m_document.scene().look.classes[std::size_t(selected)].name);
    if (addsPoints && selected >= 0)
        m_text->setText(tr("Click a point of %1 in a plane or the projection").arg(selectedName));
    else if (grows)
        m_text->setText(
            options.isBone
                ? tr("Click bone in a plane or the projection")
                : tr("Click in a plane or the projection; drag up to include more values"));
    else if (paints)
        m_text->setText(tr("Drag in a plane or the projection"));
    else
        m_text->setText(tr("Draw around the part to cut, in a plane or the projection"));
    QString found;
    if (marking.isSearching())
        found = tr("Searching...");
    else if (marking.tint())
        found = tr("%1 ml").arg(marking.tint()->volumeMl, 0, 'f', 1);
    if (marking.tint() && !marking.candidate() && selected >= 0)
        found = selectedName + ": " + found;
    m_found->setText(found);
}

} // namespace pellucid::ui
