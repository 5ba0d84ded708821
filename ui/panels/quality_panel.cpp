// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/quality_panel.h"

#include <cmath>
#include <functional>

#include <QComboBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QPushButton>

#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/views/overlay.h"
#include "ui/widgets/form.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

// Without the exact reference, which takes seconds for each picture.
constexpr std::size_t qualityCount = 4;

QString percent(double share) {
    return QObject::tr("%1 %").arg(QString::number(100.0 * share, 'g', 2));
}

QComboBox *addBox(QFormLayout *form, const QString &text, const char *name, const QString &tip) {
    auto *box = new QComboBox;
    box->setObjectName(name);
    box->setAccessibleName(text);
    box->setToolTip(plainToolTip(tip));
    form->addRow(text, box);
    return box;
}

PlainLabel *addFigure(QFormLayout *form, const QString &text, const char *name,
                      const QString &tip) {
    auto *label = new PlainLabel;
    label->setObjectName(name);
    label->setAccessibleName(text);
    label->setToolTip(plainToolTip(tip));
    form->addRow(text, label);
    return label;
}

} // namespace

QualityPanel::QualityPanel(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_more(new QPushButton(tr("More"))) {
    setPanelBackground(*this, "qualityPanel");
    auto *form = new QFormLayout(this);
    form->setContentsMargins(14, 2, 14, 8);
    form->setHorizontalSpacing(12);
    form->setVerticalSpacing(4);
    addChoices(form);
    addFigures(form);
    m_more->setObjectName("moreQualityButton");
    m_more->setProperty("role", "link");
    m_more->setCheckable(true);
    m_more->setToolTip(tr("Override what the planner chose"));
    const auto showExpert = [this, form](bool isShown) {
        form->setRowVisible(m_tolerance, isShown);
        form->setRowVisible(m_kernel, isShown);
    };
    connect(m_more, &QPushButton::toggled, this, showExpert);
    showExpert(false);
    connectChoices();
    document.whenever(Change::scene, this, [this](Changes changes) {
        showScene();
        if ((changes & Change::volume) && !m_document.isPreview())
            clearPlan();
    });
    showScene();
    clearPlan();
}

void QualityPanel::addChoices(QFormLayout *form) {
    m_quality = addBox(form, tr("Quality"), "qualityBox", tr("Largest error allowed"));
    const std::array<QString, qualityCount> names{tr("Draft"), tr("Interactive"), tr("Standard"),
                                                  tr("Fine")};
    for (std::size_t n = 0; n < qualityCount; ++n)
        m_quality->addItem(names[n], scene::namedTolerances[n].tolerance);
    m_quality->addItem(tr("Custom"));
    m_tolerance = new QLineEdit;
    m_tolerance->setObjectName("toleranceEdit");
    m_tolerance->setAccessibleName(tr("Tolerance"));
    m_tolerance->setToolTip(tr("Largest relative error of the picture: 0.0001 to 30 percent"));
    form->addRow(tr("Tolerance"), m_tolerance);
    m_reconstruction = addBox(form, tr("Interpolation"), "reconstructionBox",
                              tr("Interpolation between the samples of the volume"));
    m_reconstruction->addItem(tr("Cubic"), int(scene::Reconstruction::cubic));
    m_reconstruction->addItem(tr("Linear"), int(scene::Reconstruction::linear));
    m_reconstruction->addItem(tr("Spline"), int(scene::Reconstruction::spline));
    m_reconstruction->addItem(tr("Sharp (band-limited)"), int(scene::Reconstruction::bandLimited));
    m_kernel = addBox(form, tr("Kernel"), "kernelBox", tr("How the spectrum is interpolated"));
    m_kernel->addItem(tr("Automatic"), QString());
    for (const char *name : {"LS3", "LS4", "LS5", "LS6", "LS7", "ES4", "ES5", "KB4", "KB5",
                             "hamming-sinc", "b-spline", "catmull-rom", "trilinear", "nearest"})
        m_kernel->addItem(name, QString(name));
}

void QualityPanel::addFigures(QFormLayout *form) {
    m_time = addFigure(form, tr("Frame"), "frameTimeLabel", tr("Time of the last frame"));
    m_error = addFigure(form, tr("Error"), "predictedErrorLabel",
                        tr("Predicted relative error of a picture of the whole volume from any "
                           "direction; the projection shows the error of the current picture"));
    m_plan = addFigure(form, tr("Plan"), "planLabel", tr("Kernel, storage and memory in use"));
    m_reason = new PlainLabel;
    m_reason->setObjectName("planReasonLabel");
    m_reason->setProperty("role", "muted");
    m_reason->setWordWrap(true);
    m_reason->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    // Reserve two lines: a dock does not grow with the text of its panel.
    m_reason->setMinimumHeight(2 * m_reason->fontMetrics().lineSpacing());
    form->addRow(m_reason);
}

void QualityPanel::connectChoices() {
    connect(m_quality, &QComboBox::activated, this, &QualityPanel::chooseTolerance);
    connect(m_tolerance, &QLineEdit::editingFinished, this, &QualityPanel::typeTolerance);
    connect(m_reconstruction, &QComboBox::activated, this, [this] {
        change(tr("Reconstruction"), [this](scene::Scene &scene) {
            scene.image.reconstruction =
                scene::Reconstruction(m_reconstruction->currentData().toInt());
        });
    });
    connect(m_kernel, &QComboBox::activated, this, [this] {
        change(tr("Kernel"), [this](scene::Scene &scene) {
            const std::string name = m_kernel->currentData().toString().toStdString();
            scene.interpolation.kernel.reset();
            if (!name.empty())
                scene.interpolation.kernel = fourier::kernelFromName(name);
        });
    });
}

QWidget *QualityPanel::corner() {
    return m_more;
}

void QualityPanel::change(const QString &what, const std::function<void(scene::Scene &)> &edit) {
    if (!editScene(m_document, what, noDrag, edit))
        emit chosenAgain();
}

void QualityPanel::chooseTolerance(int index) {
    const QVariant tolerance = m_quality->itemData(index);
    if (!tolerance.isValid()) { // custom: typed in the edit box
        m_more->setChecked(true);
        m_tolerance->setFocus();
        m_tolerance->selectAll();
        return;
    }
    change(tr("Quality"), [&](scene::Scene &scene) { scene.tolerance = tolerance.toDouble(); });
}

void QualityPanel::typeTolerance() {
    if (m_tolerance->text() == percent(m_document.scene().tolerance))
        return;
    bool isNumber = false;
    // Accept both decimal separators in any locale.
    const QString text = m_tolerance->text().remove('%').replace(',', '.').trimmed();
    const double typed = text.toDouble(&isNumber) / 100.0;
    // Below 1e-6, single precision cannot follow; above 0.3, the picture is useless.
    const bool good = isNumber && std::isfinite(typed) && typed >= 1e-6 && typed <= 0.3;
    if (good) {
        // With focus, the edit box would take the undo keys.
        m_tolerance->clearFocus();
        change(tr("Tolerance"), [&](scene::Scene &scene) { scene.tolerance = typed; });
    } else {
        showReason(tr("'%1' is not a tolerance: enter 0.0001 to 30 percent").arg(text), true);
    }
    showScene();
}

void QualityPanel::showScene() {
    const scene::Scene &scene = m_document.scene();
    const int own = m_quality->count() - 1;
    int quality = own;
    for (int n = 0; n < own; ++n)
        if (m_quality->itemData(n).toDouble() == scene.tolerance)
            quality = n;
    m_quality->setCurrentIndex(quality);
    m_tolerance->setText(percent(scene.tolerance));
    m_reconstruction->setCurrentIndex(m_reconstruction->findData(int(scene.image.reconstruction)));
    const auto &fixed = scene.interpolation.kernel;
    const QString kernel = fixed ? QString::fromStdString(fourier::kernelName(*fixed)) : QString();
    if (m_kernel->findData(kernel) < 0) // from a scene file
        m_kernel->addItem(kernel, kernel);
    m_kernel->setCurrentIndex(m_kernel->findData(kernel));
}

void QualityPanel::clearPlan() {
    for (PlainLabel *label : {m_time, m_error, m_plan})
        label->setText(QString::fromUtf8("\xe2\x80\x93"));
    m_reason->clear();
}

void QualityPanel::showPlan(const ShownEngine &shown, EngineStage stage) {
    const bool coarse = stage == EngineStage::coarse;
    const plan::RenderPlan &plan = shown.prepared.plan;
    const auto &spectrum = plan.spectrum;
    const bool missed = plan.predictedError > m_document.scene().tolerance;
    // No bound is known for a coarse picture, which lacks detail of the study, or for a sum of
    // layers.
    const auto bound = prepare::boundOf(shown.prepared, m_document.scene().image);
    m_error->setText(bound ? tr("at most %1").arg(percent(bound->relative)) : tr("not known yet"));
    m_plan->setText(tr("%1, %2 bit, %3 MB")
                        .arg(QString::fromStdString(spectrum.kernels[0].name()),
                             QString::number(8 * fourier::bytesPerCell(spectrum.storage) / 2),
                             QString::number(spectrum.bytes() >> 20)));
    const QString reason = translated(plan.reason);
    const bool isSum = shown.prepared.of == plan::SpectrumOf::layer;
    showReason(isSum ? tr("Preview while weights change")
               : coarse || stage == EngineStage::live
                   ? tr("A coarse picture first; the full one follows")
               : missed ? tr("The error exceeds the tolerance: %1").arg(reason)
                        : tr("Plan: %1").arg(reason),
               missed && (stage == EngineStage::full || stage == EngineStage::settled));
}

void QualityPanel::showReason(const QString &text, bool isWarning) {
    setMessage(*m_reason, text, isWarning ? "warning" : "muted");
}

void QualityPanel::showError(const error::StatedError &measured) {
    m_error->setText(tr("measured: %1").arg(percent(measured.relative)));
}

void QualityPanel::showFrame(const picture::FrameTimes &times, bool draft) {
    const QString text = millisecondsText(times.totalMs());
    m_time->setText(draft ? tr("%1, draft").arg(text) : text);
}

} // namespace pellucid::ui
