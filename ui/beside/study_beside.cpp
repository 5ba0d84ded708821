// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/beside/study_beside.h"

#include <QDate>
#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/beside/study_projection.h"
#include "ui/jobs/job_strip.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/views/mpr_view.h"
#include "ui/views/pane_area.h"
#include "ui/views/projection_view.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

QString headingText(const StudySource &source) {
    return patientText(source.study) + ", " + studyText(source.study) + ", " +
           seriesText(source.volume);
}

namespace {

constexpr auto gapOfBanner = "  ·  ";

// A text from outside in a banner. It passes for no other part, and pushes none out of sight.
QString bannerPart(const QString &value) {
    constexpr int longest = 64;
    QString text = shownText(value).simplified();
    for (const char *const dot : {" · ", " • "})
        text.replace(QString::fromUtf8(dot), " - ");
    return text.size() > longest ? text.left(longest - 1) + QString::fromUtf8("…") : text;
}

} // namespace

QString bannerText(const StudySource &source) {
    const StudyFacts &study = source.study;
    QStringList patient{bannerPart(patientText(study))};
    if (study.hasPatient()) {
        if (!study.sex.isEmpty())
            patient << bannerPart(study.sex);
        const QDate birth = QDate::fromString(study.birthDate, "yyyyMMdd"),
                    scan = QDate::fromString(study.date, "yyyyMMdd");
        if (birth.isValid()) {
            int years = scan.year() - birth.year();
            if (scan.isValid() && birth.addYears(years) > scan)
                --years;
            patient << (scan.isValid() && years >= 0
                            ? StudyBeside::tr("%1 (%2 y)")
                                  .arg(dateText(study.birthDate), QString::number(years))
                            : dateText(study.birthDate));
        }
        if (!study.patientId.isEmpty())
            patient << StudyBeside::tr("ID %1").arg(bannerPart(study.patientId));
    }
    const QString gap = QString::fromUtf8(gapOfBanner);
    return patient.join(gap) + gap + bannerPart(studyText(study)) + gap +
           bannerPart(seriesText(source.volume));
}

StudyBeside::StudyBeside(const Viewer &leader, GraphicsCard &card, QWidget *parent)
    : QWidget(parent), m_study(card), m_measurements(m_study.document), m_viewer(makeViewer()),
      m_link(new StudyLink(leader, m_viewer, this)), m_name(new PlainLabel),
      m_linked(new QToolButton) {
    setObjectName("studyBeside");
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(makeHeading());
    layout->addWidget(m_viewer.area, 1);
    m_viewer.area->arrangeAs(*leader.area);
    connectProjection(m_study, *m_viewer.projection, card);
    connect(&m_study.jobs, &JobRunner::failed, this, &StudyBeside::failed);
    connect(&m_measurements, &MeasurementStore::failed, this, &StudyBeside::failed);
    // Also if a load is cancelled and the former study comes back. A failed load keeps its name.
    document().whenever(Change::currentSource, this, &StudyBeside::showName);
    document().whenever(Change::volume, this, [this] {
        if (jobs().isRunning()) { // the volume was loaded
            beginLink();
            return;
        }
        // Linked now, the view of the leader would change this scene before the preparer knows that
        // the engine of a kept study comes back.
        m_link->hold();
        QMetaObject::invokeMethod(this, &StudyBeside::beginLink, Qt::QueuedConnection);
    });
}

void StudyBeside::toggleLink() {
    m_linked->toggle();
}

void StudyBeside::setNameShown(bool isShown) {
    m_showsName = isShown;
    showName();
}

void StudyBeside::showName() {
    const int current = document().currentSource();
    if (current < 0)
        return;
    const StudySource &source = document().sources()[std::size_t(current)];
    const QString text = m_showsName ? headingText(source) : seriesText(source.volume);
    m_name->setText(text);
    m_name->setToolTip(plainToolTip(text));
}

void StudyBeside::beginLink() {
    if (document().volume() && !document().isPreview())
        m_link->begin();
}

StudyBeside::~StudyBeside() {
    // Before the document, which they refer to.
    delete m_link;
    delete m_viewer.area;
}

Viewer StudyBeside::makeViewer() {
    Viewer viewer{document(), {}, nullptr, nullptr};
    std::array<QWidget *, 4> panes{};
    for (const auto orientation : mpr::allOrientations) {
        auto *plane = new MprView(document(), orientation);
        plane->setObjectName("beside_" + plane->objectName());
        connect(plane, &MprView::readoutChanged, this, &StudyBeside::readoutChanged);
        panes[std::size_t(orientation)] = viewer.planes[std::size_t(orientation)] = plane;
    }
    viewer.projection = new ProjectionView(document());
    viewer.projection->setObjectName("beside_projectionView");
    panes[3] = viewer.projection;
    viewer.area = new PaneArea(panes);
    viewer.area->setObjectName("beside_paneArea");
    for (MprView *plane : viewer.planes)
        connect(plane, &MprView::maximizeRequested, viewer.area, &PaneArea::toggleMaximized);
    connect(viewer.projection, &ProjectionView::maximizeRequested, viewer.area,
            &PaneArea::toggleMaximized);
    return viewer;
}

QWidget *StudyBeside::makeHeading() {
    auto *heading = new QWidget;
    heading->setAttribute(Qt::WA_StyledBackground);
    heading->setProperty("role", "studyHeading");
    heading->setFixedHeight(headingHeight);
    m_name->setObjectName("besideName");
    // A long name leaves room for the buttons.
    m_name->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_linked->setObjectName("linkButton");
    m_linked->setText(tr("Linked"));
    m_linked->setCheckable(true);
    m_linked->setChecked(true);
    m_linked->setToolTip(tr("View, planes and window of both studies move together; unlink, match "
                            "the planes by hand, and link again (Shift+Y)"));
    auto *close = new QToolButton;
    close->setObjectName("closeBesideButton");
    close->setText(tr("Close"));
    close->setToolTip(tr("Close the second study"));
    auto *row = new QHBoxLayout(heading);
    row->setContentsMargins(10, 2, 6, 2);
    row->addWidget(m_name, 1);
    row->addWidget(new JobStrip(jobs(), "beside"));
    row->addWidget(m_linked);
    row->addWidget(close);
    connect(m_linked, &QToolButton::toggled, this, [this](bool isLinked) {
        m_link->setLinked(isLinked);
        emit linkChanged(isLinked);
    });
    connect(close, &QToolButton::clicked, this, &StudyBeside::closeRequested);
    return heading;
}

void StudyBeside::open(const StudySource &source) {
    m_link->hold();
    m_study.opener.openSource(document().addSources({source}).front());
    beginLink(); // if it is open already
}

void StudyBeside::setTool(Tool tool) {
    const bool edits = tool == Tool::crop || marksRegions(tool);
    const Tool here = edits ? Tool::window : tool;
    for (MprView *plane : m_viewer.planes)
        plane->setTool(here);
    m_viewer.projection->setTool(here);
}

} // namespace pellucid::ui
