// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/region_bar.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>

#include "ui/document/document.h"
#include "ui/language/names.h"

namespace pellucid::ui {

namespace {

using classify::RegionUse;

constexpr double widestLeakMm = 100.0, thickestSlabMm = 500.0;
// After the uses of a region, for the tool that clicks points.
constexpr int addsPoint = 4;

} // namespace

RegionBar::RegionBar(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_use(new QComboBox), m_where(new QComboBox),
      m_text(new QLabel), m_found(new QLabel), m_erases(new QCheckBox(tr("Erase"))),
      m_isBone(new QCheckBox(tr("Bone"))) {
    setObjectName("regionBar");
    setAttribute(Qt::WA_StyledBackground);
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(12, 4, 12, 4);
    row->setSpacing(8);
    m_text->setProperty("role", "muted");
    m_text->setMinimumWidth(20);
    m_use->setObjectName("regionUseBox");
    m_use->setAccessibleName(tr("Use of the region"));
    m_where->setObjectName("regionClassBox");
    m_where->setAccessibleName(tr("Classes that the region changes"));
    m_erases->setObjectName("eraseBox");
    m_erases->setToolTip(tr("The ball erases; with Shift it does the other"));
    m_isBone->setObjectName("regionBoneBox");
    m_isBone->setToolTip(tr("All bone that is connected with the click, with its marrow and rim; "
                            "drag up for less dense bone"));
    m_found->setObjectName("regionFound");
    row->addWidget(m_use);
    row->addWidget(m_where);
    m_leak = makeNumber("regionLeakBox", tr("Leak limit"),
                        tr("The region does not pass through openings narrower than this"),
                        &RegionOptions::leakMm);
    m_leak->setMaximum(widestLeakMm);
    m_ball = makeNumber("regionBallBox", tr("Radius"),
                        tr("Radius of the ball (Shift+wheel over a plane)"),
                        &RegionOptions::ballMm);
    m_ball->setRange(classify::smallestBallMm, classify::largestBallMm);
    m_slab = makeNumber("regionSlabBox", tr("Slab"), tr("Thickness of the cut, about the crosshair"),
                        &RegionOptions::slabMm);
    m_slab->setMaximum(thickestSlabMm);
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
                options.use = RegionUse(chosen);
        });
    });
    connect(m_where, &QComboBox::activated, this, [this](int index) {
        change([&](RegionOptions &options) { options.ofEveryClass = index == 1; });
    });
    connect(m_erases, &QCheckBox::toggled, this, [this](bool isOn) {
        change([&](RegionOptions &options) { options.erases = isOn; });
    });
    connect(m_isBone, &QCheckBox::toggled, this, [this](bool isOn) {
        change([&](RegionOptions &options) { options.isBone = isOn; });
    });
    const RegionMarking &marking = document.marking();
    for (const auto changed : {&RegionMarking::toolChanged, &RegionMarking::optionsChanged,
                               &RegionMarking::tintChanged})
        connect(&marking, changed, this, &RegionBar::showMarking);
    for (const auto changed : {&Document::sceneChanged, &Document::selectedClassChanged,
                               &Document::volumeChanged})
        connect(&document, changed, this, &RegionBar::showMarking);
    showMarking();
}

QDoubleSpinBox *RegionBar::makeNumber(const char *name, const QString &text, const QString &tip,
                                      double RegionOptions::*number) {
    auto *box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setAccessibleName(text);
    box->setToolTip(tip);
    box->setPrefix(text + " ");
    box->setDecimals(1);
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
    m_where->clear();
    m_where->addItem(selected < 0 ? tr("in the whole volume")
                                  : tr("in %1").arg(translatedName(
                                        m_document.scene().look.classes[std::size_t(selected)]
                                            .name)));
    if (selected >= 0)
        m_where->addItem(tr("in every class"));
    m_where->setCurrentIndex(m_document.marking().options().ofEveryClass && selected >= 0 ? 1 : 0);
}

void RegionBar::showMarking() {
    const RegionMarking &marking = m_document.marking();
    const RegionOptions &options = marking.options();
    const RegionTool tool = marking.tool();
    setVisible(tool != RegionTool::none && m_document.volume().has_value());
    const bool grows = tool == RegionTool::connected, paints = tool == RegionTool::paint,
               cuts = tool == RegionTool::scissors;
    {
        const QSignalBlocker quiet(m_use);
        m_use->clear();
        m_use->addItem(tr("New class"), int(RegionUse::newClass));
        m_use->addItem(tr("Add to the class"), int(RegionUse::add));
        m_use->addItem(tr("Keep only this"), int(RegionUse::keep));
        m_use->addItem(tr("Remove this"), int(RegionUse::remove));
        if (grows)
            m_use->addItem(tr("Add a point"), addsPoint);
        const int wanted = grows && options.addsPoints ? addsPoint : int(options.use);
        m_use->setCurrentIndex(m_use->findData(wanted));
    }
    showClasses();
    const bool addsPoints = grows && options.addsPoints;
    m_use->setVisible(!paints);
    m_where->setVisible(paints ? options.erases
                               : !addsPoints && (options.use == RegionUse::keep ||
                                                 options.use == RegionUse::remove));
    m_leak->setVisible(grows && !addsPoints && !options.isBone);
    m_isBone->setVisible(grows && !addsPoints);
    m_ball->setVisible(paints);
    m_erases->setVisible(paints);
    m_slab->setVisible(cuts);
    const QSignalBlocker quietLeak(m_leak), quietBall(m_ball), quietSlab(m_slab),
        quietErase(m_erases), quietBone(m_isBone);
    m_leak->setValue(options.leakMm);
    m_ball->setValue(options.ballMm);
    m_slab->setValue(options.slabMm);
    m_erases->setChecked(options.erases);
    m_isBone->setChecked(options.isBone);
    const int selected = m_document.selectedClass();
    const QString selectedName =
        selected < 0
            ? QString()
            : translatedName(m_document.scene().look.classes[std::size_t(selected)].name);
    if (addsPoints && selected >= 0)
        m_text->setText(tr("Click a point of %1 in a plane or the projection").arg(selectedName));
    else if (grows)
        m_text->setText(options.isBone
                            ? tr("Click bone in a plane or the projection")
                            : tr("Click in a plane or the projection; drag up for more values"));
    else if (paints)
        m_text->setText(tr("Drag in a plane or the projection"));
    else
        m_text->setText(tr("Draw around what is meant, in a plane or the projection"));
    QString found;
    if (marking.isSearching())
        found = tr("Searching...");
    else if (marking.tint())
        found = tr("%1 ml").arg(marking.tint()->volumeMl, 0, 'f', 1);
    if (marking.tint() && !marking.sought() && selected >= 0)
        found = selectedName + ": " + found;
    m_found->setText(found);
}

} // namespace pellucid::ui
