// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/huge_question.h"

#include <QCoreApplication>

#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/widgets/question.h"

namespace pellucid::ui {

namespace {

struct HugeQuestionTexts {
    Q_DECLARE_TR_FUNCTIONS(HugeQuestionTexts)
};

} // namespace

void askForHuge(QWidget *window, const std::vector<dicom::Skipped> &huge,
                const std::function<void()> &open) {
    QString what =
        HugeQuestionTexts::tr("%1 %2.", "file name, then what is odd about it")
            .arg(shownText(QString::fromStdString(huge.front().path.filename().string())),
                 translated(huge.front().reason));
    if (huge.size() > 1)
        what += " " + HugeQuestionTexts::tr("%n other images are also unusually large.", "",
                                            int(huge.size()) - 1);
    what += "\n\n" + HugeQuestionTexts::tr("Opening may use all memory and take a long time.");
    ask(window,
        {"hugeQuestion", HugeQuestionTexts::tr("Unusually large"), what,
         HugeQuestionTexts::tr("Open")},
        open);
}

} // namespace pellucid::ui
