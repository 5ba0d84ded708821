// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/question.h"

#include <QMessageBox>
#include <QPushButton>

#include "ui/language/shown_text.h"

namespace pellucid::ui {

void ask(QWidget *window, const Question &question, const std::function<void()> &agreed,
         const std::function<void()> &cancelled) {
    delete window->findChild<QMessageBox *>(question.name);
    auto *const box =
        new QMessageBox(QMessageBox::NoIcon, question.title, {}, QMessageBox::Cancel, window);
    box->setObjectName(question.name);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setTextFormat(Qt::PlainText);
    box->setText(shownLines(question.text));
    const QPushButton *const agree = box->addButton(question.agree, QMessageBox::AcceptRole);
    box->setDefaultButton(QMessageBox::Cancel);
    QObject::connect(box, &QMessageBox::buttonClicked, box,
                     [box, agreed, cancelled, agree](const QAbstractButton *button) {
                         box->setObjectName({}); // it has its answer, whatever is asked next
                         if (button == static_cast<const void *>(agree))
                             agreed();
                         else if (cancelled)
                             cancelled();
                     });
    box->open();
}

} // namespace pellucid::ui
