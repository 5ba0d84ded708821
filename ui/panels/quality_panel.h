// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QWidget>

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

    /// The button beside the panel's heading, which shows tolerance and kernel.
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
    void showReason(const QString &text, bool isWarning);
    void chooseTolerance(int index);
    void typeTolerance();
    void change(const QString &what, const std::function<void(scene::Scene &)> &edit);

    Document &m_document;
    QPushButton *m_more;
    QComboBox *m_quality, *m_reconstruction, *m_kernel;
    QLineEdit *m_tolerance;
    PlainLabel *m_time, *m_error, *m_plan, *m_reason;
};

} // namespace pellucid::ui
