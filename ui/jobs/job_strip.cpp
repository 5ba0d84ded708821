// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/jobs/job_strip.h"

#include <utility>

#include <QHBoxLayout>
#include <QProgressBar>
#include <QPushButton>

#include "ui/jobs/job_runner.h"
#include "ui/language/shown_text.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

JobStrip::JobStrip(JobRunner &jobs, const QString &name, std::function<void()> cancel,
                   QWidget *parent)
    : QWidget(parent), m_progress(new QProgressBar), m_title(new PlainLabel),
      m_cancel(new QPushButton(tr("Cancel"))) {
    setObjectName(name + "Strip");
    m_progress->setObjectName(name + "Progress");
    m_progress->setTextVisible(false);
    m_progress->setRange(0, 1000);
    m_progress->setMinimumWidth(60);
    m_progress->setMaximumWidth(220);
    m_title->setObjectName(name + "Title");
    m_cancel->setObjectName(name + "Cancel");
    m_cancel->setProperty("role", "link");
    m_cancel->setToolTip(tr("Stop the running job (Esc)"));
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    for (QWidget *widget : {static_cast<QWidget *>(m_progress), static_cast<QWidget *>(m_title),
                            static_cast<QWidget *>(m_cancel)})
        row->addWidget(widget);
    hide();
    connect(m_cancel, &QPushButton::clicked, this, [&jobs, cancel = std::move(cancel)] {
        if (cancel)
            cancel();
        else
            jobs.cancel();
    });
    connect(&jobs, &JobRunner::started, this, &JobStrip::showStarted);
    connect(&jobs, &JobRunner::progressed, this,
            [this](double fraction) { m_progress->setValue(int(1000 * fraction)); });
    connect(&jobs, &JobRunner::finished, this, [this] {
        m_title->clear();
        hide();
    });
}

void JobStrip::showStarted(const QString &title) {
    if (!isVisible()) // a further stage of the same job keeps its progress
        m_progress->setValue(0);
    m_title->setText(shownText(title));
    show();
}

} // namespace pellucid::ui
