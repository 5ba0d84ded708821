// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/quality_panel.h"

#include <array>
#include <cmath>
#include <functional>

#include <QComboBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QStyle>

#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/plain_label.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/views/overlay.h"

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

QString spectraName(plan::SpectrumOf what) {
    switch (what) {
    case plan::SpectrumOf::look:
        return QObject::tr("look %1");
    case plan::SpectrumOf::color:
        return QObject::tr("colors %1");
    case plan::SpectrumOf::layer:
        return QObject::tr("layers %1");
    case plan::SpectrumOf::gradient:
        return QObject::tr("gradients %1");
    }
    return {};
}

QString whySpectra(plan::SpectrumOf what) {
    switch (what) {
    case plan::SpectrumOf::look:
        return QObject::tr("Everything shown has one color, so it adds up to one field");
    case plan::SpectrumOf::color:
        return QObject::tr("The look is mixed from two or three colors, and each has a field");
    case plan::SpectrumOf::layer:
        return QObject::tr("Weights are changing, so each layer keeps its own spectrum");
    case plan::SpectrumOf::gradient:
        return QObject::tr("Light acts on the gradient, which has its own spectrum");
    }
    return {};
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
    setObjectName("qualityPanel");
    setAttribute(Qt::WA_StyledBackground);
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
    const std::array<QWidget *, 8> expert{m_kernel,    m_padding, m_storage, m_padded,
                                          m_tolerance, m_model,   m_widths,  m_leftOut};
    const auto showExpert = [form, expert](bool isShown) {
        for (QWidget *widget : expert)
            form->setRowVisible(widget, isShown);
    };
    connect(m_more, &QPushButton::toggled, this, showExpert);
    showExpert(false);
    connectChoices();
    connect(&document, &Document::sceneChanged, this, &QualityPanel::showScene);
    connect(&document, &Document::volumeChanged, this, [this] {
        showScene();
        if (!m_document.isPreview())
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
    m_padding = addBox(form, tr("Padding"), "paddingBox",
                       tr("Minimum ratio of the padded size to the field's along each axis"));
    m_padding->addItem(tr("Automatic"), 0.0);
    for (const double padding : {1.25, 1.5, 2.0})
        m_padding->addItem(QString::number(padding), padding);
    m_storage = addBox(form, tr("Storage"), "storageBox", tr("Number format of the spectrum"));
    m_storage->addItem(tr("Automatic"), QString());
    m_storage->addItem(tr("16 bit"), QString("f16"));
    m_storage->addItem(tr("32 bit"), QString("f32"));
}

void QualityPanel::addFigures(QFormLayout *form) {
    m_time = addFigure(form, tr("Frame"), "frameTimeLabel", tr("Time of the last frame"));
    m_error = addFigure(form, tr("Error"), "predictedErrorLabel",
                        tr("Predicted relative error of a picture of the whole from any side; the "
                           "error of the picture shown is beside it"));
    m_plan = addFigure(form, tr("Plan"), "planLabel", tr("Kernel, storage and memory in use"));
    m_padded = addFigure(form, tr("Padded"), "paddingLabel",
                         tr("Padded size relative to the field's, along columns, rows and slices"));
    m_model = addFigure(form, tr("Per frame"), "modelLabel",
                        tr("Spectra, slices, images and multiplications that a frame needs"));
    m_model->setWordWrap(true);
    m_widths = addFigure(form, tr("Kernel widths"), "widthsLabel",
                         tr("Share of the frequencies that kernels of each width read. Narrow "
                            "kernels are accurate enough where there is little energy. "
                            "Frequencies with almost none are not read."));
    m_widths->setWordWrap(true);
    m_leftOut = addFigure(form, tr("Skipped"), "leftOutLabel",
                          tr("Stages that are skipped because this scene does not need them"));
    m_leftOut->setWordWrap(true);
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
    connect(m_padding, &QComboBox::activated, this, [this] {
        change(tr("Padding"), [this](scene::Scene &scene) {
            const double padding = m_padding->currentData().toDouble();
            scene.interpolation.padding.reset();
            if (padding > 0.0)
                scene.interpolation.padding = padding;
        });
    });
    connect(m_storage, &QComboBox::activated, this, [this] {
        change(tr("Storage"), [this](scene::Scene &scene) {
            const std::string name = m_storage->currentData().toString().toStdString();
            scene.interpolation.storage.reset();
            if (!name.empty())
                scene.interpolation.storage = fourier::storageFromName(name);
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
    const auto show = [](QComboBox *box, const std::string &name) {
        const QString text = QString::fromStdString(name);
        if (box->findData(text) < 0) // a value from a scene file
            box->addItem(text, text);
        box->setCurrentIndex(box->findData(text));
    };
    const scene::Interpolation &fixed = scene.interpolation;
    show(m_kernel, fixed.kernel ? fourier::kernelName(*fixed.kernel) : std::string());
    const double padding = fixed.padding.value_or(0.0);
    if (m_padding->findData(padding) < 0)
        m_padding->addItem(QString::number(padding), padding);
    m_padding->setCurrentIndex(m_padding->findData(padding));
    show(m_storage, fixed.storage ? fourier::storageName(*fixed.storage) : std::string());
}

void QualityPanel::clearPlan() {
    for (PlainLabel *label : {m_time, m_error, m_plan, m_padded, m_model, m_widths, m_leftOut})
        label->setText(QString::fromUtf8("\xe2\x80\x93"));
    m_reason->clear();
    m_shownFrame.reset();
    m_times = {};
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
    const volume::GridSize box = spectrum.box.size();
    const auto padding = [&](int d) {
        return QString::number(double(spectrum.padded[d]) / box[d], 'f', 2);
    };
    m_padded->setText(tr("%1 x %2 x %3").arg(padding(0), padding(1), padding(2)));
    m_plan->setText(tr("%1, %2 bit, %3 MB")
                        .arg(QString::fromStdString(spectrum.kernels[0].name()),
                             QString::number(8 * fourier::bytesPerCell(spectrum.storage) / 2),
                             QString::number(spectrum.bytes() >> 20)));
    const render::EngineParts parts = shown.prepared.engine->parts();
    m_shownFrame = {plan,
                    {int(parts.spectra.fields.size()), shown.prepared.of,
                     render::colorsOf(parts.channelWeights)},
                    !parts.spectra.gradients.empty()};
    showModel();
    const QString reason = translated(plan.reason);
    const bool isSum = shown.prepared.of == plan::SpectrumOf::layer;
    showReason(isSum ? tr("The layers of the look, summed while their weights change")
               : coarse || stage == EngineStage::live
                   ? tr("A coarse picture first; the full one follows")
               : missed ? tr("The error exceeds the tolerance: %1").arg(reason)
                        : tr("Plan: %1").arg(reason),
               missed && (stage == EngineStage::full || stage == EngineStage::settled));
}

void QualityPanel::showModel() {
    if (!m_document.volume() || !m_shownFrame)
        return;
    scene::Scene scene = m_document.scene();
    if (!m_shownFrame->isLit)
        scene.shading.lights.clear();
    const plan::FrameModel model =
        plan::modelFrame(m_shownFrame->plan, scene, m_shownFrame->fields,
                         m_document.volume()->lattice(), m_times.widthShares);
    QStringList spectra, reasons;
    for (const plan::FrameModel::Spectra &kind : model.spectra) {
        spectra << spectraName(kind.of).arg(kind.count);
        reasons << whySpectra(kind.of);
    }
    m_model->setText(tr("Spectra: %1; slices: %2; images: %3; multiplications: %4 million")
                         .arg(spectra.join(tr(", ")), QString::number(model.slices),
                              QString::number(model.images),
                              QString::number(1e-6 * model.multiplyAdds, 'f', 1)));
    m_model->setToolTip(plainToolTip(reasons.join('\n')));
    QStringList leftOut;
    for (const plan::LeftOut what : model.leftOut)
        switch (what) {
        case plan::LeftOut::light:
            leftOut << tr("light");
            break;
        case plan::LeftOut::depthCue:
            leftOut << tr("depth cue");
            break;
        case plan::LeftOut::color:
            leftOut << tr("color");
            break;
        case plan::LeftOut::emptySpace:
            leftOut << tr("empty space");
            break;
        case plan::LeftOut::secondHalf: // skipped in every plan
        case plan::LeftOut::cornersOfBand:
            break;
        }
    m_leftOut->setText(leftOut.isEmpty() ? tr("nothing") : leftOut.join(", "));
}

void QualityPanel::showReason(const QString &text, bool isWarning) {
    m_reason->setText(text);
    m_reason->setProperty("role", isWarning ? "warning" : "muted");
    m_reason->style()->polish(m_reason); // the style sheet depends on the role
}

void QualityPanel::showError(const error::StatedError &measured) {
    m_error->setText(tr("measured: %1").arg(percent(measured.relative)));
}

void QualityPanel::showFrame(const picture::FrameTimes &times, bool draft) {
    const QString text = millisecondsText(times.totalMs());
    m_time->setText(draft ? tr("%1, draft").arg(text) : text);
    if (draft)
        return;
    m_times = times;
    showModel(); // the size of the pane may have changed
    showWidths();
}

void QualityPanel::showWidths() {
    QStringList shares;
    for (std::size_t width = m_times.widthShares.size(); width-- > 0;)
        if (const double share = m_times.widthShares[width]; share > 0.0)
            shares << (width > 0 ? tr("width %1: %2").arg(QString::number(width), percent(share))
                                 : tr("not read: %1").arg(percent(share)));
    m_widths->setText(shares.isEmpty() ? QString::fromUtf8("\xe2\x80\x93") : shares.join(", "));
}

} // namespace pellucid::ui
