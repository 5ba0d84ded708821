// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/shading_panel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "ui/document/document.h"
#include "ui/panels/depth_curve.h"
#include "ui/panels/light_sphere.h"
#include "ui/widgets/form.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"
#include "ui/widgets/value_slider.h"

namespace pellucid::ui {

namespace {

using shading::CueKind;
using shading::Light;
using shading::LightFrame;
using shading::Shading;

constexpr double defaultCue = 0.6, defaultLight = 0.8;
// Lit surfaces are faint beside the full density.
constexpr double ambientUnderLight = 0.1;

QIcon colorIcon(const classify::Color &color) {
    QPixmap pixmap(24, 24);
    pixmap.fill(QColor::fromRgbF(float(color.red), float(color.green), float(color.blue)));
    return QIcon(pixmap);
}

// The first light comes from the upper left; the next two are a third of a turn apart, and each
// further three are between those.
Light newLight(std::size_t count) {
    const double turn =
        2.0 * std::numbers::pi * (0.35 + double(count % 3) / 3.0 + double(count / 3) / 9.0);
    return {{0.75 * std::cos(turn), 0.75 * std::sin(turn), 0.66}, {}, defaultLight};
}

} // namespace

ShadingPanel::ShadingPanel(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_sphere(new LightSphere), m_cue(new QComboBox),
      m_curveValues(new QSpinBox), m_curve(new DepthCurve),
      m_strength(new ValueSlider({1.0, defaultCue}, "cueSlider", "cueValue")),
      m_light(new ValueSlider({1.0, defaultLight}, "lightSlider", "lightValue")),
      m_ambient(new ValueSlider({shading::largestAmbient, 1.0}, "ambientSlider", "ambientValue")),
      m_reset(
          makeLink(tr("Reset"), "resetShadingButton", tr("Remove the depth cue and all lights"))),
      m_add(makeLink(tr("Add light"), "addLightButton", tr("Add a light"))),
      m_remove(makeLink(tr("Remove"), "removeLightButton", tr("Remove the selected light"))),
      m_color(makeLink({}, "lightColorButton", tr("Color of the selected light"))),
      m_follows(new QCheckBox(tr("Follows viewer"))) {
    setPanelBackground(*this, "shadingPanel");
    nameControls();
    layOut();
    connectCue();
    connectLights();
    document.whenever(Change::scene | Change::pose, this, [this](Changes changes) {
        if (changes & Change::volume) {
            setEnabled(m_document.volume().has_value() && !m_document.isPreview());
            m_reset->setEnabled(isEnabled());
        }
        if (changes & Change::scene)
            showScene();
        else
            showLights();
    });
    setEnabled(false);
    m_reset->setEnabled(false);
    showScene();
}

void ShadingPanel::nameControls() {
    m_cue->setObjectName("cueBox");
    m_cue->setAccessibleName(tr("Depth cue"));
    m_cue->setToolTip(tr("How much near structures stand out from far ones"));
    for (const auto &[text, kind] : {std::pair{tr("No depth cue"), CueKind::none},
                                     {tr("Linear cue"), CueKind::linear},
                                     {tr("Sine cue"), CueKind::sine},
                                     {tr("Custom curve"), CueKind::curve}})
        m_cue->addItem(text, int(kind));
    m_strength->setNames(tr("Strength of the depth cue"),
                         tr("Strength of the depth cue; double-click sets it to 0.6"));
    m_light->setNames(tr("Strength of the light"),
                      tr("Strength of the selected light; double-click sets it to 0.8"));
    m_ambient->setNames(tr("Ambient light"),
                        tr("How bright the body is without the lights; double-click sets it to 1"));
    m_curveValues->setObjectName("curveValuesBox");
    m_curveValues->setAccessibleName(tr("Number of curve values"));
    m_curveValues->setToolTip(tr("Points of the curve; more points render slower"));
    m_curveValues->setRange(int(shading::minCurveValues), int(shading::maxCurveValues));
    m_curveValues->setFixedWidth(44);
    m_follows->setObjectName("followsViewerBox");
    m_follows->setToolTip(
        tr("The selected light follows the viewer; otherwise, it stays with the patient"));
    m_color->setAccessibleName(tr("Light color"));
}

void ShadingPanel::layOut() {
    auto *rows = new QVBoxLayout;
    rows->setSpacing(3);
    const auto add = [&](const QString &text, ValueSlider *slider) {
        auto *row = new QHBoxLayout;
        auto *label = new PlainLabel(text);
        label->setFixedWidth(54);
        row->addWidget(label);
        row->addWidget(slider, 1);
        rows->addLayout(row);
    };
    auto *cueRow = new QHBoxLayout;
    cueRow->addWidget(m_cue, 1);
    cueRow->addWidget(m_curveValues);
    rows->addLayout(cueRow);
    add(tr("Cue"), m_strength);
    add(tr("Light"), m_light);
    add(tr("Ambient"), m_ambient);
    auto *top = new QHBoxLayout;
    top->setSpacing(10);
    top->addWidget(m_sphere, 0, Qt::AlignTop);
    top->addLayout(rows, 1);
    auto *bottom = new QHBoxLayout;
    bottom->setSpacing(2);
    bottom->addWidget(m_add);
    bottom->addWidget(m_remove);
    bottom->addWidget(m_color);
    bottom->addStretch();
    bottom->addWidget(m_follows);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(14, 2, 14, 8);
    column->setSpacing(4);
    column->addLayout(top);
    column->addWidget(m_curve);
    column->addLayout(bottom);
    column->addStretch();
}

void ShadingPanel::connectCue() {
    connect(m_cue, &QComboBox::activated, this, &ShadingPanel::chooseCue);
    connect(m_strength, &ValueSlider::changed, this, [this](double value, DragId drag) {
        change(tr("Depth cue"), drag, [&](Shading &s) { s.cue.strength = value; });
    });
    connect(m_curveValues, &QSpinBox::valueChanged, this, [this](int count) {
        change(tr("Depth cue"), noDrag, [&](Shading &s) {
            // Resample the same curve.
            std::vector<double> values;
            for (int n = 0; n < count; ++n)
                values.push_back(std::clamp(shading::DepthCue{CueKind::curve, 1.0, s.cue.curve}.at(
                                                2.0 * n / (count - 1) - 1.0),
                                            0.0, shading::largestCurveValue));
            s.cue.curve = values;
        });
    });
    connect(m_curve, &DepthCurve::valueChanged, this, [this](int n, double value, DragId drag) {
        change(tr("Depth cue"), drag, [&](Shading &s) { s.cue.curve[std::size_t(n)] = value; });
    });
}

void ShadingPanel::connectLights() {
    connect(m_light, &ValueSlider::changed, this, [this](double value, DragId drag) {
        if (selectedLight() >= 0)
            change(tr("Light"), drag,
                   [&](Shading &s) { s.lights[std::size_t(selectedLight())].strength = value; });
    });
    connect(m_ambient, &ValueSlider::changed, this, [this](double value, DragId drag) {
        change(tr("Ambient light"), drag, [&](Shading &s) { s.ambient = value; });
    });
    connect(m_sphere, &LightSphere::lightSelected, this, [this](int index) {
        m_selected = index;
        showScene();
    });
    connect(m_sphere, &LightSphere::directionChanged, this, &ShadingPanel::turnLight);
    connect(m_reset, &QPushButton::clicked, this, &ShadingPanel::reset);
    connect(m_add, &QPushButton::clicked, this, &ShadingPanel::addLight);
    connect(m_remove, &QPushButton::clicked, this, &ShadingPanel::removeLight);
    connect(m_color, &QPushButton::clicked, this, &ShadingPanel::chooseColor);
    connect(m_follows, &QCheckBox::clicked, this, &ShadingPanel::setFollowsViewer);
}

QWidget *ShadingPanel::corner() {
    return m_reset;
}

int ShadingPanel::selectedLight() const {
    const int count = int(m_document.scene().shading.lights.size());
    return count == 0 ? -1 : std::clamp(m_selected, 0, count - 1);
}

void ShadingPanel::showLights() {
    const Shading &shading = m_document.scene().shading;
    const glm::dmat3 toView = glm::transpose(m_document.scene().camera.axes());
    std::vector<Light> lights = shading.lights;
    for (Light &light : lights)
        if (light.frame == LightFrame::patient)
            light.direction = toView * light.direction;
    m_sphere->setLights(lights, shading.ambient, selectedLight());
}

void ShadingPanel::showScene() {
    const Shading &shading = m_document.scene().shading;
    const QSignalBlocker noValues(m_curveValues);
    m_cue->setCurrentIndex(m_cue->findData(int(shading.cue.kind)));
    m_strength->setEnabled(shading.cue.kind != CueKind::none);
    m_strength->setValue(shading.cue.strength);
    m_curve->setVisible(shading.cue.kind == CueKind::curve);
    m_curveValues->setVisible(shading.cue.kind == CueKind::curve);
    m_curveValues->setValue(int(shading.cue.curve.size()));
    m_curve->setCue(shading.cue);
    m_ambient->setValue(shading.ambient);
    const int index = selectedLight();
    for (QWidget *widget : std::initializer_list<QWidget *>{m_light, m_remove, m_color, m_follows})
        widget->setEnabled(index >= 0);
    m_color->setVisible(index >= 0);
    m_remove->setVisible(index >= 0);
    m_follows->setVisible(index >= 0);
    m_add->setEnabled(shading.lights.size() < shading::maxLights);
    const Light light = index >= 0 ? shading.lights[std::size_t(index)] : Light{.strength = 0.0};
    m_light->setValue(light.strength);
    m_color->setIcon(colorIcon(light.color));
    m_follows->setChecked(light.frame == LightFrame::viewer);
    showLights();
}

void ShadingPanel::change(const QString &what, DragId drag,
                          const std::function<void(Shading &)> &edit) {
    if (m_document.volume())
        editScene(m_document, what, drag, [&](scene::Scene &scene) { edit(scene.shading); });
}

void ShadingPanel::chooseCue(int index) {
    change(tr("Depth cue"), noDrag, [&](Shading &s) {
        s.cue.kind = CueKind(m_cue->itemData(index).toInt());
        if (s.cue.kind == CueKind::curve && s.cue.curve == shading::DepthCue().curve)
            s.cue.curve = {0.0, 2.0, 0.0}; // emphasize the middle
    });
}

void ShadingPanel::toggleCue() {
    change(tr("Depth cue"), noDrag, [this](Shading &s) {
        if (s.cue.isActive()) {
            m_lastCue = s.cue.kind;
            s.cue.kind = CueKind::none;
            return;
        }
        if (s.cue.kind == CueKind::none)
            s.cue.kind = m_lastCue;
        if (s.cue.strength == 0.0)
            s.cue.strength = defaultCue;
    });
}

void ShadingPanel::addLight() {
    const std::size_t count = m_document.scene().shading.lights.size();
    if (count >= shading::maxLights)
        return;
    m_selected = int(count);
    change(tr("Add light"), noDrag, [&](Shading &s) {
        if (s.lights.empty() && s.ambient == 1.0)
            s.ambient = ambientUnderLight;
        s.lights.push_back(newLight(count));
    });
}

void ShadingPanel::removeLight() {
    const int index = selectedLight();
    if (index >= 0)
        change(tr("Remove light"), noDrag, [&](Shading &s) {
            s.lights.erase(s.lights.begin() + index);
            if (s.lights.empty() && s.ambient == ambientUnderLight)
                s.ambient = 1.0;
        });
}

void ShadingPanel::reset() {
    change(tr("Reset shading"), noDrag, [](Shading &s) { s = {}; });
}

void ShadingPanel::chooseColor() {
    const int index = selectedLight();
    if (index < 0)
        return;
    const classify::Color &now = m_document.scene().shading.lights[std::size_t(index)].color;
    const QColor chosen =
        QColorDialog::getColor(QColor::fromRgbF(float(now.red), float(now.green), float(now.blue)),
                               this, tr("Light color"));
    if (chosen.isValid())
        change(tr("Light color"), noDrag, [&](Shading &s) {
            s.lights[std::size_t(index)].color = {chosen.red() / 255.0, chosen.green() / 255.0,
                                                  chosen.blue() / 255.0};
        });
}

void ShadingPanel::setFollowsViewer(bool followsViewer) {
    const int index = selectedLight();
    if (index < 0)
        return;
    // Keep the current direction of the light.
    const glm::dmat3 axes = m_document.scene().camera.axes();
    change(tr("Light follows viewer or patient"), noDrag, [&](Shading &s) {
        Light &light = s.lights[std::size_t(index)];
        const bool followed = light.frame == LightFrame::viewer;
        if (followed && !followsViewer)
            light.direction = axes * light.direction;
        else if (!followed && followsViewer)
            light.direction = glm::transpose(axes) * light.direction;
        light.frame = followsViewer ? LightFrame::viewer : LightFrame::patient;
    });
}

void ShadingPanel::turnLight(int index, const glm::dvec3 &direction, DragId drag) {
    const glm::dmat3 axes = m_document.scene().camera.axes();
    change(tr("Light direction"), drag, [&](Shading &s) {
        Light &light = s.lights[std::size_t(index)];
        light.direction = light.frame == LightFrame::patient ? axes * direction : direction;
    });
}

} // namespace pellucid::ui
