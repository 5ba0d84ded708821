// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/dock.h"

#include <QCoreApplication>
#include <QDockWidget>
#include <QHBoxLayout>
#include <QToolButton>

namespace pellucid::ui {

namespace {

// The title of a dock, whose heading may be hidden while a tab names the dock.
struct DockTitle : QWidget {
    QToolButton *heading = new QToolButton;
};

} // namespace

QDockWidget *makeDock(const QString &title, const char *name, QWidget *panel, QWidget *corner) {
    auto *dock = new QDockWidget(title);
    dock->setObjectName(name);
    dock->setWidget(panel);
    // A click on the heading collapses or expands the panel.
    auto *bar = new DockTitle;
    QToolButton *const heading = bar->heading;
    heading->setObjectName(QString(name) + "Heading");
    heading->setText(title);
    heading->setToolTip(QCoreApplication::translate("Dock", "Collapse or expand"));
    heading->setProperty("role", "heading");
    QObject::connect(heading, &QToolButton::clicked, panel,
                     [panel] { panel->setVisible(!panel->isVisible()); });
    bar->setAttribute(Qt::WA_StyledBackground);
    bar->setProperty("role", "dockTitle");
    auto *row = new QHBoxLayout(bar);
    row->setContentsMargins(8, 6, 8, 0);
    row->addWidget(heading);
    row->addStretch();
    if (corner != nullptr)
        row->addWidget(corner);
    dock->setTitleBarWidget(bar);
    return dock;
}

void showHeading(QDockWidget &dock, bool isShown) {
    static_cast<DockTitle *>(dock.titleBarWidget())->heading->setVisible(isShown);
}

} // namespace pellucid::ui
