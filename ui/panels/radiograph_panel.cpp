// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/radiograph_panel.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/classify/couch.h"
#include "ui/document/document.h"
#include "ui/document/region_commands.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"
#include "ui/widgets/value_slider.h"

namespace pellucid::ui {

RadiographPanel::RadiographPanel(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document),
      m_detail(new ValueSlider({1.0, std::nullopt}, "detailSlider", "detailValue")),
      m_latitude(new ValueSlider({1.0, std::nullopt}, "latitudeSlider", "latitudeValue")),
      m_sharpness(new ValueSlider({2.0, 0.0}, "sharpnessSlider", "sharpnessValue")),
      m_detailMark(new PlainLabel), m_latitudeMark(new PlainLabel), m_corner(new QWidget),
      m_withoutCouch(new QCheckBox(tr("Without couch"))),
      m_automatic(new QPushButton(tr("Automatic"))) {
    setPanelBackground(*this, "radiographPanel");
    m_automatic->setObjectName("automaticContrastButton");
    m_automatic->setToolTip(tr("Choose detail and latitude from the study"));
    m_automatic->setProperty("role", "link");
    auto *corner = new QHBoxLayout(m_corner);
    corner->setContentsMargins(0, 0, 0, 0);
    corner->setSpacing(10);
    corner->addWidget(m_withoutCouch);
    corner->addWidget(m_automatic);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(14, 2, 14, 8);
    column->setSpacing(3);
    addRow(tr("Detail"),
           tr("How strongly fine structures, such as trabeculae and vessels, are amplified; 0: "
              "unchanged. Double-click: automatic"),
           m_detail, m_detailMark);
    connectShare(m_detail, tr("Detail"), &scene::Tone::detail);
    addRow(tr("Latitude"),
           tr("Brings thick and thin parts to a similar brightness; 0: off. "
              "Double-click: automatic"),
           m_latitude, m_latitudeMark);
    connectShare(m_latitude, tr("Latitude"), &scene::Tone::latitude);
    addRow(tr("Sharpness"),
           tr("Amplifies fine structures by a linear filter, in exported values too; "
              "double-click: none"),
           m_sharpness);
    connect(m_sharpness, &ValueSlider::changed, this, [this](double value, DragId drag) {
        if (m_document.volume())
            editScene(m_document, tr("Sharpness"), drag, [&](scene::Scene &scene) {
                if (scene.image.detail == 0.0)
                    scene.image.detailMm =
                        scene::defaultDetailMm(m_document.volume()->lattice().radiusMm());
                scene.image.detail = value;
            });
    });
    m_withoutCouch->setObjectName("withoutCouchBox");
    m_withoutCouch->setToolTip(tr("Leave out the couch, head rests and clothes, in every preset"));
    column->addStretch();
    connect(m_withoutCouch, &QCheckBox::clicked, this,
            [this](bool isWithout) { setWithoutCouch(m_document, isWithout); });
    connect(m_automatic, &QPushButton::clicked, this, [this] {
        editScene(m_document, tr("Automatic contrast"), noDrag, [](scene::Scene &scene) {
            scene.tone.detail.reset();
            scene.tone.latitude.reset();
        });
    });
    document.whenever(Change::scene | Change::exposure, this, &RadiographPanel::showScene);
    showScene();
}

QWidget *RadiographPanel::corner() {
    return m_corner;
}

void RadiographPanel::addRow(const QString &name, const QString &tip, ValueSlider *slider,
                             PlainLabel *mark) {
    auto *row = new QHBoxLayout;
    row->setSpacing(6);
    auto *label = new PlainLabel(name);
    label->setFixedWidth(60);
    slider->setNames(name, tip);
    if (mark == nullptr)
        mark = new PlainLabel;
    mark->setProperty("role", "muted");
    mark->setFixedWidth(mark->fontMetrics().horizontalAdvance(tr("auto")) + 2);
    row->addWidget(label);
    row->addWidget(slider, 1);
    row->addWidget(mark);
    static_cast<QVBoxLayout *>(layout())->addLayout(row);
}

void RadiographPanel::connectShare(ValueSlider *slider, const QString &name, Share share) {
    connect(slider, &ValueSlider::changed, this,
            [=, this](double value, DragId drag) { set(name, drag, share, value); });
    connect(slider, &ValueSlider::automaticRequested, this,
            [=, this] { set(name, noDrag, share, std::nullopt); });
}

void RadiographPanel::set(const QString &what, DragId drag, Share share,
                          const std::optional<double> &value) {
    if (m_document.volume())
        editScene(m_document, what, drag, [&](scene::Scene &scene) { scene.tone.*share = value; });
}

void RadiographPanel::showScene() {
    const bool isOpen = m_document.volume() && !m_document.isPreview();
    setEnabled(isOpen);
    // The body is found by HU.
    m_withoutCouch->setEnabled(isOpen &&
                               m_document.volume()->unit() == volume::ValueUnit::hounsfield);
    m_withoutCouch->setChecked(isOpen && classify::isWithoutCouch(m_document.scene().look));
    const scene::Tone &tone = m_document.scene().tone;
    m_automatic->setEnabled(isOpen && (tone.detail || tone.latitude));
    m_sharpness->setValue(m_document.scene().image.detail);
    // An automatic value is known as soon as the picture is.
    const auto exposure = m_document.exposure();
    const auto showShare = [](ValueSlider *slider, PlainLabel *mark,
                              const std::optional<double> &chosen,
                              const std::optional<double> &automatic) {
        if (chosen || automatic)
            slider->setValue(chosen ? *chosen : *automatic);
        // It keeps its place.
        mark->setText(chosen ? QString() : tr("auto"));
    };
    showShare(m_detail, m_detailMark, tone.detail,
              exposure ? std::optional(exposure->detail) : std::nullopt);
    showShare(m_latitude, m_latitudeMark, tone.latitude,
              exposure ? std::optional(exposure->latitude) : std::nullopt);
}

} // namespace pellucid::ui
