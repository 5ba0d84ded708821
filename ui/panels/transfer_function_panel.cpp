// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/transfer_function_panel.h"

#include <algorithm>
#include <cmath>

#include <QClipboard>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/language/names.h"
#include "ui/language/number_text.h"
#include "ui/language/reasons.h"
#include "ui/panels/curve_editor.h"
#include "ui/widgets/form.h"
#include "ui/widgets/limit_box.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

constexpr int histogramBins = 96;
constexpr double maxValue = 9e8, typicalRange = 2000.0;

QPushButton *addLink(QHBoxLayout *row, const QString &text, const char *name, const QString &tip) {
    QPushButton *button = makeLink(text, name, tip);
    row->addWidget(button);
    return button;
}

} // namespace

TransferFunctionPanel::TransferFunctionPanel(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_editor(new CurveEditor), m_subject(new PlainLabel),
      m_points(new QSpinBox), m_weight(new QDoubleSpinBox),
      m_low(new LimitBox("curveLowBox", -maxValue, maxValue, typicalRange)),
      m_high(new LimitBox("curveHighBox", -maxValue, maxValue, typicalRange)) {
    setPanelBackground(*this, "transferFunctionPanel");
    using classify::TransferFunction;
    m_subject->setObjectName("transferFunctionSubject");
    m_subject->setProperty("role", "muted");
    m_points->setObjectName("pointsBox");
    m_points->setAccessibleName(tr("Number of control points"));
    m_points->setToolTip(tr("Number of control points; more give a finer curve"));
    m_points->setRange(TransferFunction::minPoints, TransferFunction::maxPoints);
    m_points->setSuffix(tr(" points"));
    m_points->setKeyboardTracking(false);
    m_weight->setObjectName("weightBox");
    m_weight->setAccessibleName(tr("Weight of the selected point"));
    m_weight->setToolTip(tr("Weight of the selected point, 0 to 2"));
    m_weight->setRange(0.0, TransferFunction::largestWeight);
    m_weight->setSingleStep(0.05);
    m_weight->setDecimals(2);
    m_weight->setKeyboardTracking(false); // apply only complete input
    layOut();
    connect(m_editor, &CurveEditor::weightChanged, this, &TransferFunctionPanel::setWeight);
    connect(m_editor, &CurveEditor::rangeChanged, this, &TransferFunctionPanel::setRange);
    for (LimitBox *box : {m_low, m_high})
        connect(box, &QDoubleSpinBox::valueChanged, this, &TransferFunctionPanel::typeRange);
    connect(m_editor, &CurveEditor::pointSelected, this, &TransferFunctionPanel::showScene);
    connect(m_points, &QSpinBox::valueChanged, this, [this](int points) {
        if (points != int(function().weights.size()))
            change(classify::withPoints(function(), points), tr("Control points"));
    });
    connect(m_weight, &QDoubleSpinBox::valueChanged, this, [this](double weight) {
        const int at = m_editor->selectedPoint();
        if (std::abs(weight - function().weights[std::size_t(at)]) > 0.005)
            setWeight(at, weight, noDrag);
    });
    document.whenever(Change::scene | Change::selection, this, [this](Changes changes) {
        if (changes & Change::volume) {
            setEnabled(m_document.volume().has_value() && !m_document.isPreview());
            m_points->setEnabled(isEnabled());
            m_histogram = {};
        }
        showScene();
    });
    setEnabled(false);
    m_points->setEnabled(false);
    showScene();
}

void TransferFunctionPanel::layOut() {
    auto *bottom = new QHBoxLayout;
    bottom->setSpacing(2);
    bottom->addWidget(m_weight);
    bottom->addStretch();
    QPushButton *reset = addLink(bottom, tr("Reset"), "resetCurveButton",
                                 tr("Set all weights to 1 and cover all values"));
    QPushButton *copyLink =
        addLink(bottom, tr("Copy"), "copyCurveButton", tr("Copy the weights as text"));
    QPushButton *pasteLink =
        addLink(bottom, tr("Paste"), "pasteCurveButton", tr("Paste 2 to 16 weights from 0 to 2"));
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(14, 2, 14, 8);
    column->setSpacing(4);
    m_low->setToolTip(tr("The value at the left end of the curve; lower values have its weight"));
    m_low->setAccessibleName(tr("Lowest value of the curve"));
    m_high->setToolTip(
        tr("The value at the right end of the curve; higher values have its weight"));
    m_high->setAccessibleName(tr("Highest value of the curve"));
    m_subject->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    auto *top = new QHBoxLayout;
    top->setSpacing(4);
    top->addWidget(m_subject, 1);
    for (LimitBox *box : {m_low, m_high}) {
        box->setButtonSymbols(QAbstractSpinBox::NoButtons);
        box->setKeyboardTracking(false);
        box->setAlignment(Qt::AlignRight);
        box->setFixedWidth(76);
        top->addWidget(box);
    }
    column->addLayout(top);
    column->addWidget(m_editor, 1);
    column->addLayout(bottom);
    connect(reset, &QPushButton::clicked, this, [this] {
        change({std::vector<double>(function().weights.size(), 1.0)}, tr("Reset curve"));
    });
    connect(copyLink, &QPushButton::clicked, this, &TransferFunctionPanel::copy);
    connect(pasteLink, &QPushButton::clicked, this, &TransferFunctionPanel::paste);
}

QWidget *TransferFunctionPanel::corner() {
    return m_points;
}

const classify::TransferFunction &TransferFunctionPanel::function() const {
    static const classify::TransferFunction plain;
    const classify::Look &look = m_document.scene().look;
    const int selected = m_document.selectedClass();
    if (selected < 0)
        return look.transferFunction;
    const auto &own = look.classes[std::size_t(selected)].transferFunction;
    return own ? *own : plain;
}

void TransferFunctionPanel::change(const classify::TransferFunction &function, const QString &what,
                                   DragId drag) {
    editScene(m_document, what, drag, [&](scene::Scene &scene) {
        const int selected = m_document.selectedClass();
        if (selected < 0)
            scene.look.transferFunction = function;
        else
            scene.look.classes[std::size_t(selected)].transferFunction = function;
    });
}

void TransferFunctionPanel::setWeight(int index, double weight, DragId drag) {
    classify::TransferFunction bent = function();
    bent.weights[std::size_t(index)] = weight;
    change(bent, tr("Transfer function"), drag);
}

void TransferFunctionPanel::setRange(double low, double high, DragId drag) {
    // Always from the curve before the drag: refitted at each step, it would lose its shape.
    if (drag == noDrag || drag != m_rangeDrag || !(function() == m_lastRanged))
        m_beforeRange = function();
    m_rangeDrag = drag;
    m_lastRanged = classify::withRange(m_beforeRange, low, high);
    change(m_lastRanged, tr("Range of the curve"), drag);
}

void TransferFunctionPanel::typeRange() {
    using classify::TransferFunction;
    const classify::FieldWindow window = m_document.fieldWindow();
    const double width = window.high - window.low;
    if (!m_document.volume() || !(width > 0.0))
        return;
    // The end that was not edited stays exactly where it is.
    const auto density = [&](const LimitBox *box, double now) {
        const double shown = window.low + now * width;
        const double typed = box->exact();
        return std::abs(typed - shown) < 1e-9 * width ? now : (typed - window.low) / width;
    };
    double low =
        std::clamp(density(m_low, function().low), 0.0, 1.0 - TransferFunction::narrowestRange);
    double high = std::clamp(density(m_high, function().high), 0.0, 1.0);
    if (high - low < TransferFunction::narrowestRange)
        high = low + TransferFunction::narrowestRange;
    if (low != function().low || high != function().high)
        setRange(low, std::min(high, 1.0), noDrag);
    showScene(); // also restores a number that is out of range
    if (m_low->hasFocus() || m_high->hasFocus())
        m_editor->setFocus(); // in a field, Undo would be that of its text
}

void TransferFunctionPanel::copy() {
    QStringList weights;
    for (const double weight : function().weights)
        weights << QString::number(weight);
    QGuiApplication::clipboard()->setText(weights.join(", "));
}

void TransferFunctionPanel::paste() {
    classify::TransferFunction pasted{{}, function().low, function().high};
    for (const QString &part : QGuiApplication::clipboard()->text().split(',')) {
        bool isNumber = false;
        pasted.weights.push_back(part.trimmed().toDouble(&isNumber));
        if (!isNumber) {
            m_subject->setText(tr("The clipboard contains no weights"));
            return;
        }
    }
    try {
        classify::validate(pasted);
        change(pasted, tr("Paste curve"));
    } catch (const task::Error &error) {
        m_subject->setText(translated(error.reason()));
    }
}

classify::FieldWindow TransferFunctionPanel::shownRange() const {
    const classify::FieldWindow window = m_document.fieldWindow();
    const double width = window.high - window.low;
    return {window.low + function().low * width, window.low + function().high * width};
}

void TransferFunctionPanel::setHistogram(const volume::Histogram &histogram) {
    m_histogram = histogram;
    showHistogram();
}

void TransferFunctionPanel::showHistogram() {
    const classify::FieldWindow window = shownRange();
    const double step = (m_histogram.high - m_histogram.low) / double(m_histogram.counts.size());
    std::vector<double> heights;
    if (!m_histogram.counts.empty() && window.high > window.low && step > 0.0) {
        // Logarithmic: bone has a thousandth of the samples of air.
        heights.assign(histogramBins, 0.0);
        const double width = (window.high - window.low) / histogramBins;
        if (width < step) { // a range narrower than the histogram's own bins
            const auto last = double(m_histogram.counts.size() - 1);
            for (std::size_t n = 0; n < heights.size(); ++n) {
                const double value = window.low + (double(n) + 0.5) * width;
                const double at = std::clamp((value - m_histogram.low) / step - 0.5, 0.0, last);
                const auto left = std::size_t(at), right = std::min(left + 1, std::size_t(last));
                heights[n] = std::lerp(double(m_histogram.counts[left]),
                                       double(m_histogram.counts[right]), at - double(left));
            }
        } else {
            for (std::size_t n = 0; n < m_histogram.counts.size(); ++n) {
                const double value = m_histogram.low + (double(n) + 0.5) * step;
                const double f = (value - window.low) / (window.high - window.low);
                if (f >= 0.0 && f < 1.0)
                    heights[std::size_t(f * histogramBins)] += double(m_histogram.counts[n]);
            }
        }
        double most = 0.0;
        for (double &height : heights)
            most = std::max(most, height = std::log1p(height));
        for (double &height : heights)
            height = most > 0.0 ? height / most : 0.0;
    }
    m_editor->setHistogram(std::move(heights));
}

void TransferFunctionPanel::showScene() {
    const int selected = m_document.selectedClass();
    m_subject->setText(
        selected < 0 ? tr("Whole volume")
                     : translatedName(m_document.scene().look.classes[std::size_t(selected)].name));
    m_editor->setFunction(function());
    const auto &volume = m_document.volume();
    m_editor->setWindow(m_document.fieldWindow(), volume ? unitText(volume->unit()) : QString());
    const QSignalBlocker noPoints(m_points), noWeight(m_weight), noLow(m_low), noHigh(m_high);
    for (LimitBox *box : {m_low, m_high}) {
        const double width = shownRange().high - shownRange().low;
        box->setDecimals(width >= 50.0 ? 0 : width >= 1.0 ? 2 : 5);
        box->setSuffix(volume ? unitSuffix(volume->unit()) : QString());
    }
    m_low->setNumber(shownRange().low);
    m_high->setNumber(shownRange().high);
    m_points->setValue(int(function().weights.size()));
    m_weight->setValue(function().weights[std::size_t(m_editor->selectedPoint())]);
    showHistogram();
}

} // namespace pellucid::ui
