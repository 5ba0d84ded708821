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
class QLineEdit;
class QPushButton;

namespace pellucid::ui {

class Document;
class PlainLabel;

/// The requested quality of the projection, and the resulting error, speed and plan.
class QualityPanel : public QWidget {
    Q_OBJECT
public:
    explicit QualityPanel(Document &document, QWidget *parent = nullptr);

    /// The button beside the panel's heading, which shows the expert settings.
    QWidget *corner();
    void showPlan(const ShownEngine &shown, EngineStage stage);
    void showFrame(const picture::FrameTimes &times, bool draft);
    void showError(const error::StatedError &measured);

signals:
    /// The current value was chosen again, for example to repeat a cancelled preparation.
    void chosenAgain();

private:
    void addChoices(QFormLayout *form);
    void addFigures(QFormLayout *form);
    void connectChoices();
    void showScene();
    void clearPlan();
    void showModel();
    void showWidths();
    void showReason(const QString &text, bool isWarning);
    void chooseTolerance(int index);
    void typeTolerance();
    void change(const QString &what, const std::function<void(scene::Scene &)> &edit);

    /// The plan and fields of the frames shown.
    struct ShownFrame {
        plan::RenderPlan plan;
        plan::FrameFields fields;
        bool isLit = false;
    };

    Document &m_document;
    std::optional<ShownFrame> m_shownFrame;
    QPushButton *m_more;
    QComboBox *m_quality, *m_reconstruction, *m_kernel, *m_padding, *m_storage;
    QLineEdit *m_tolerance;
    PlainLabel *m_time, *m_error, *m_plan, *m_padded, *m_model, *m_widths, *m_leftOut, *m_reason;
    picture::FrameTimes m_times; ///< of the last frame that is no draft
};

} // namespace pellucid::ui
