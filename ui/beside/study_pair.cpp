// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/beside/study_pair.h"

#include <QApplication>
#include <QVBoxLayout>

#include "ui/beside/study_beside.h"
#include "ui/document/document.h"
#include "ui/language/shown_text.h"
#include "ui/views/mpr_view.h"
#include "ui/views/pane_area.h"
#include "ui/views/projection_view.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

void showOverlaysOn(const Viewer &viewer, const Overlays &overlays) {
    for (MprView *const plane : viewer.planes)
        plane->setOverlays(overlays);
    viewer.projection->setOverlays(overlays);
}

} // namespace

StudyPair::StudyPair(const Viewer &open, GraphicsCard &card, QWidget *parent)
    : QSplitter(parent), m_open(open), m_card(card), m_heading(new PlainLabel) {
    setObjectName("viewers");
    setChildrenCollapsible(false);
    m_heading->setObjectName("studyHeading");
    m_heading->setProperty("role", "studyHeading");
    m_heading->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    m_heading->setFixedHeight(headingHeight);
    m_heading->hide();
    auto *panes = new QWidget;
    auto *column = new QVBoxLayout(panes);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(m_heading);
    column->addWidget(open.area, 1);
    addWidget(panes);
    open.document.whenever(Change::volume | Change::currentSource, this, &StudyPair::showHeading);
    connect(&open.document.marking(), &RegionMarking::toolRequested, this,
            [this](RegionTool wanted) {
                setTool(toolFor(wanted));
                emit changed();
            });
}

void StudyPair::openBeside(const StudySource &source) {
    if (m_beside == nullptr)
        makeBeside();
    showHeading();
    m_beside->open(source);
}

void StudyPair::makeBeside() {
    m_beside = new StudyBeside(m_open, m_card);
    addWidget(m_beside);
    setSizes({1, 1});
    m_beside->setTool(m_tool);
    m_beside->setNameShown(m_showsBanner);
    showOverlaysOn(m_beside->viewer(), m_overlays);
    connect(m_beside, &StudyBeside::closeRequested, this, &StudyPair::closeBeside,
            Qt::QueuedConnection); // the button is deleted with its heading
    connect(m_beside, &StudyBeside::linkChanged, this, &StudyPair::changed);
    connect(m_beside, &StudyBeside::readoutChanged, this, &StudyPair::readoutChanged);
    connect(m_beside, &StudyBeside::failed, this, &StudyPair::failed);
    emit besideOpened();
    emit changed();
}

void StudyPair::closeBeside() {
    if (m_beside == nullptr)
        return;
    delete m_beside;
    m_beside = nullptr;
    emit changed();
    showHeading();
}

void StudyPair::toggleLink() {
    m_beside->toggleLink();
}

bool StudyPair::isLinked() const {
    return m_beside != nullptr && m_beside->isLinked();
}

Viewer StudyPair::focused() const {
    const QWidget *const focus = QApplication::focusWidget();
    const bool isBeside = m_beside != nullptr && focus != nullptr && m_beside->isAncestorOf(focus);
    return isBeside ? m_beside->viewer() : m_open;
}

const Viewer *StudyPair::beside() const {
    return m_beside != nullptr ? &m_beside->viewer() : nullptr;
}

void StudyPair::setTool(Tool tool) {
    m_tool = tool;
    for (MprView *const plane : m_open.planes)
        plane->setTool(tool);
    m_open.projection->setTool(tool);
    m_open.document.marking().setTool(regionToolOf(tool));
    // What is drawn is seen.
    if (measuredBy(tool) && !m_overlays.texts)
        setOverlays({.texts = true, .crosshair = m_overlays.crosshair});
    if (m_beside != nullptr)
        m_beside->setTool(tool);
}

void StudyPair::setOverlays(const Overlays &overlays) {
    m_overlays = overlays;
    showOverlaysOn(m_open, overlays);
    if (m_beside != nullptr)
        showOverlaysOn(m_beside->viewer(), overlays);
}

void StudyPair::setBannerShown(bool isShown) {
    m_showsBanner = isShown;
    if (m_beside != nullptr)
        m_beside->setNameShown(isShown);
    showHeading();
}

void StudyPair::showHeading() {
    const Document &document = m_open.document;
    const int open = document.currentSource();
    m_heading->setVisible((m_showsBanner || m_beside != nullptr) && open >= 0);
    if (open < 0)
        return;
    const StudySource &source = document.sources()[std::size_t(open)];
    // Two headings say which study is which, also without names.
    const QString text = !m_showsBanner        ? seriesText(source.volume)
                         : m_beside != nullptr ? headingText(source)
                                               : bannerText(source);
    m_heading->setText(text);
    m_heading->setToolTip(plainToolTip(m_showsBanner ? bannerText(source) : text));
}

} // namespace pellucid::ui
