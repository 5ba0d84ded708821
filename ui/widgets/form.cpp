// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/form.h"

#include <QPushButton>
#include <QStyle>

#include "ui/language/shown_text.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

QPushButton *makeButton(const QString &text, const char *name, const QString &tip) {
    auto *button = new QPushButton(text);
    button->setObjectName(name);
    button->setToolTip(plainToolTip(tip));
    return button;
}

QPushButton *makeLink(const QString &text, const char *name, const QString &tip) {
    QPushButton *button = makeButton(text, name, tip);
    button->setProperty("role", "link");
    return button;
}

void setRole(QWidget &widget, const char *role) {
    widget.setProperty("role", role);
    widget.style()->unpolish(&widget); // the style sheet depends on the role
    widget.style()->polish(&widget);
}

void setMessage(PlainLabel &label, const QString &text, const char *role) {
    label.setText(text);
    setRole(label, role);
}

} // namespace pellucid::ui
