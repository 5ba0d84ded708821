// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/tool_bar.h"

#include <QAction>
#include <QComboBox>
#include <QCoreApplication>
#include <QMainWindow>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>

#include "ui/theme/icons.h"
#include "ui/window/tools_menu.h"
#include "ui/window/window_chooser.h"

namespace pellucid::ui {

namespace {

struct ToolBarTexts {
    Q_DECLARE_TR_FUNCTIONS(ToolBarTexts)
};

Qt::ToolButtonStyle buttonStyle(ToolBarStyle style) {
    switch (style) {
    case ToolBarStyle::icons:
        return Qt::ToolButtonIconOnly;
    case ToolBarStyle::words:
        return Qt::ToolButtonTextOnly;
    case ToolBarStyle::both:
        break;
    }
    return Qt::ToolButtonTextBesideIcon;
}

QComboBox *makeWindowBox() {
    auto *box = new QComboBox;
    box->setObjectName("windowBox");
    box->setAccessibleName(ToolBarTexts::tr("Window presets of the planes"));
    box->setToolTip(ToolBarTexts::tr("Window width / center of the planes (keys 0 to 9)"));
    box->setMinimumWidth(64); // fits a screen 960 logical pixels wide
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(22);
    box->setMaximumWidth(260);
    return box;
}

} // namespace

WindowChooser *makeToolBar(QMainWindow &window, Document &document, ToolBarStyle style,
                           const ToolBarSources &sources) {
    QToolBar *bar = window.addToolBar(ToolBarTexts::tr("Tools"));
    bar->setObjectName("toolBar");
    bar->setMovable(false);
    bar->setIconSize({20, 20});
    bar->addAction(window.findChild<QAction *>("openFilesAction"));
    bar->addAction(window.findChild<QAction *>("importAction"));
    bar->addSeparator();
    bar->addAction(window.findChild<QAction *>("undoAction"));
    bar->addAction(window.findChild<QAction *>("redoAction"));
    bar->addSeparator();
    sources.tools.addTo(*bar);
    bar->addSeparator();
    auto *views = new QToolButton;
    views->setObjectName("viewsButton");
    views->setText(ToolBarTexts::tr("View"));
    views->setIcon(themedIcon("cube"));
    views->setToolTip(ToolBarTexts::tr("See the patient from a side, or at an angle"));
    views->setPopupMode(QToolButton::InstantPopup);
    QObject::connect(bar, &QToolBar::toolButtonStyleChanged, views,
                     &QToolButton::setToolButtonStyle);
    auto *sides = new QMenu(views);
    sides->addActions(sources.views);
    views->setMenu(sides);
    bar->addWidget(views);
    bar->addActions(sources.layouts);
    bar->addSeparator();
    bar->addAction(window.findChild<QAction *>("exportPictureAction"));
    auto *space = new QWidget;
    space->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    bar->addWidget(space);
    QComboBox *windowBox = makeWindowBox();
    bar->addWidget(windowBox);
    auto *chooser = new WindowChooser(document, sources.windowMenu, *windowBox);
    // Qt draws the overflow arrow in the colors of its own style.
    if (auto *more = bar->findChild<QToolButton *>("qt_toolbar_ext_button")) {
        more->setIcon(themedIcon("down"));
        more->setToolTip(ToolBarTexts::tr("More"));
        more->setAccessibleName(ToolBarTexts::tr("More"));
    }
    setToolBarStyle(window, style);
    return chooser;
}

void setToolBarStyle(QMainWindow &window, ToolBarStyle style) {
    window.findChild<QToolBar *>("toolBar")->setToolButtonStyle(buttonStyle(style));
}

} // namespace pellucid::ui
