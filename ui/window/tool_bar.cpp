// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/tool_bar.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QMainWindow>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>

#include "ui/theme/icons.h"
#include "ui/window/actions/commands.h"

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

ToolBar makeToolBar(QMainWindow &window, ActionTable &actions) {
    QToolBar *bar = window.addToolBar(ToolBarTexts::tr("Tools"));
    bar->setObjectName("toolBar");
    bar->setMovable(false);
    bar->setIconSize({20, 20});
    const auto add = [&](std::initializer_list<const char *> ids) {
        for (const char *const id : ids)
            bar->addAction(actions[id]);
        bar->addSeparator();
    };
    add({"openFilesAction", "importAction"});
    add({"undoAction", "redoAction"});
    addToolButtons(*bar, actions);
    bar->addSeparator();
    auto *views = new QToolButton;
    views->setObjectName("viewsButton");
    views->setText(ToolBarTexts::tr("View"));
    views->setIcon(themedIcon("cube"));
    views->setToolTip(ToolBarTexts::tr("Standard views and C-arm angles"));
    views->setPopupMode(QToolButton::InstantPopup);
    QObject::connect(bar, &QToolBar::toolButtonStyleChanged, views,
                     &QToolButton::setToolButtonStyle);
    auto *sides = new QMenu(views);
    actions.fill(*sides, standardViews());
    views->setMenu(sides);
    bar->addWidget(views);
    add({"onePlusThreeAction", "twoByTwoAction"});
    bar->addAction(actions["exportPictureAction"]);
    auto *space = new QWidget;
    space->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    bar->addWidget(space);
    QComboBox *windows = makeWindowBox();
    bar->addWidget(windows);
    // Qt draws the overflow arrow in the colors of its own style.
    if (auto *more = bar->findChild<QToolButton *>("qt_toolbar_ext_button")) {
        more->setIcon(themedIcon("down"));
        more->setToolTip(ToolBarTexts::tr("More"));
        more->setAccessibleName(ToolBarTexts::tr("More"));
    }
    return {bar, windows};
}

void setToolBarStyle(QToolBar &bar, ToolBarStyle style) {
    bar.setToolButtonStyle(buttonStyle(style));
}

} // namespace pellucid::ui
