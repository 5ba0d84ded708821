// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/huge_question.h"

#include <QCoreApplication>
#include <QMessageBox>
#include <QPushButton>

#include "ui/language/reasons.h"

namespace pellucid::ui {

namespace {

struct HugeQuestionTexts {
    Q_DECLARE_TR_FUNCTIONS(HugeQuestionTexts)
};

} // namespace

void askForHuge(QWidget *window, const std::vector<dicom::Skipped> &huge,
                const std::function<void()> &open) {
    QString what = HugeQuestionTexts::tr("%1 %2.", "file name, then what is odd about it")
                       .arg(QString::fromStdString(huge.front().path.filename().string()),
                            translated(huge.front().reason));
    if (huge.size() > 1)
        what += " " + HugeQuestionTexts::tr("So are %n others.", "", int(huge.size()) - 1);
    what += "\n\n" + HugeQuestionTexts::tr("Opening may use all memory and take a long time.");
    auto *const question =
        new QMessageBox(QMessageBox::NoIcon, HugeQuestionTexts::tr("Unusually large"), what,
                        QMessageBox::Cancel, window);
    question->setObjectName("hugeQuestion");
    question->setAttribute(Qt::WA_DeleteOnClose);
    QPushButton *const yes =
        question->addButton(HugeQuestionTexts::tr("Open"), QMessageBox::AcceptRole);
    question->setDefaultButton(QMessageBox::Cancel);
    QObject::connect(question, &QMessageBox::buttonClicked, question,
                     [open, yes](const QAbstractButton *button) {
                         if (button == static_cast<const void *>(yes))
                             open();
                     });
    question->open();
}

} // namespace pellucid::ui
