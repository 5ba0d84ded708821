// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QWidget>

#include "core/shading/shading.h"
#include "ui/document/commands.h"

class QCheckBox;
class QComboBox;
class QPushButton;
class QSpinBox;

namespace pellucid::ui {

class DepthCurve;
class Document;
class LightSphere;
class ValueSlider;

/// The shading of the projection: depth cue, lights on a sphere, ambient light.
class ShadingPanel : public QWidget {
    Q_OBJECT
public:
    ShadingPanel(Document &document, QWidget *parent = nullptr);

    /// The button beside the panel's heading, which removes the cue and all lights.
    QWidget *corner();
    /// Also used by the menu.
    void toggleCue();
    void addLight();
    void reset();

private:
    void nameControls();
    void layOut();
    void connectCue();
    void connectLights();
    void showScene();
    void showLights();
    int selectedLight() const;
    void chooseCue(int index);
    void removeLight();
    void chooseColor();
    void setFollowsViewer(bool followsViewer);
    void turnLight(int index, const glm::dvec3 &direction, DragId drag);
    void change(const QString &what, DragId drag,
                const std::function<void(shading::Shading &)> &edit);

    Document &m_document;
    LightSphere *m_sphere;
    QComboBox *m_cue;
    QSpinBox *m_curveValues;
    DepthCurve *m_curve;
    ValueSlider *m_strength, *m_light, *m_ambient;
    QPushButton *m_reset, *m_add, *m_remove, *m_color;
    QCheckBox *m_follows;
    int m_selected = 0;
    shading::CueKind m_lastCue = shading::CueKind::linear; ///< used when switched on again
};

} // namespace pellucid::ui
