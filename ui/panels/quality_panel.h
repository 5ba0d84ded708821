// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include <QWidget>

#include "core/plan/frame_model.h"
#include "ui/engine/look_preparer.h"
#include "ui/engine/shown_engine.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace pellucid::ui {

class Document;

/// How exact and how fast the projection is: what the user asks for, and what came of it.
class QualityPanel : public QWidget {
    Q_OBJECT
public:
    explicit QualityPanel(Document &document, QWidget *parent = nullptr);

    /// Stands beside the panel's heading: shows what experts choose.
    QWidget *corner();
    void showPlan(const ShownEngine &shown, EngineStage stage);
    void showFrame(const picture::FrameTimes &times, bool draft);

signals:
    /// What the scene asks for already was chosen once more, as after a cancelled preparation.
    void chosenAgain();

private:
    void addChoices(QFormLayout *form);
    void addFigures(QFormLayout *form);
    void connectChoices();
    void showScene();
    void clearPlan();
    void showModel();
    void say(const QString &text, bool isWarning);
    void chooseTolerance(int index);
    void typeTolerance();
    void change(const QString &what, const std::function<void(scene::Scene &)> &edit);

    /// What the frames shown are made of.
    struct FrameOf {
        plan::RenderPlan plan;
        plan::FrameFields fields;
        bool isLit = false;
    };

    Document &m_document;
    std::optional<FrameOf> m_frameOf;
    QPushButton *m_more;
    QComboBox *m_quality, *m_reconstruction, *m_kernel, *m_padding, *m_storage;
    QLineEdit *m_tolerance;
    QLabel *m_time, *m_error, *m_largest, *m_plan, *m_padded, *m_model, *m_leftOut, *m_reason;
};

} // namespace pellucid::ui
