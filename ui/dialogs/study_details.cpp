// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/study_details.h"

#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QPixmap>
#include <QVBoxLayout>

#include "ui/studies/thumbnail.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

struct StudyDetailsTexts {
    Q_DECLARE_TR_FUNCTIONS(StudyDetailsTexts)
};

PlainLabel *value(const QString &text) {
    auto *label = new PlainLabel(text.isEmpty() ? QString::fromUtf8("–") : text);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    label->setWordWrap(true);
    return label;
}

QString folderOf(const QStringList &files) {
    return files.isEmpty() ? QString() : QFileInfo(files.front()).absolutePath();
}

void addFacts(QFormLayout *form, const StudyFacts &study, const VolumeFacts &volume,
              const QStringList &files) {
    const auto row = [form](const QString &name, const QString &text) {
        auto *label = new PlainLabel(name);
        label->setProperty("role", "muted");
        form->addRow(label, value(text));
    };
    row(StudyDetailsTexts::tr("Patient"), patientText(study));
    row(StudyDetailsTexts::tr("Patient ID"), study.patientId);
    row(StudyDetailsTexts::tr("Date of birth"), dateText(study.birthDate));
    row(StudyDetailsTexts::tr("Sex"), study.sex);
    row(StudyDetailsTexts::tr("Study"), studyText(study));
    row(StudyDetailsTexts::tr("Study UID"), study.uid);
    row(StudyDetailsTexts::tr("Series"), seriesText(volume));
    row(StudyDetailsTexts::tr("Series UID"), volume.seriesUid);
    row(StudyDetailsTexts::tr("Modality"), volume.modality);
    row(StudyDetailsTexts::tr("Body part"), volume.bodyPart);
    row(StudyDetailsTexts::tr("Slices, rows, columns"),
        QString::fromUtf8("%1 × %2 × %3")
            .arg(QString::number(volume.size.k), QString::number(volume.size.j),
                 QString::number(volume.size.i)));
    if (volume.spacingMm.x > 0.0)
        row(StudyDetailsTexts::tr("Pixel spacing"),
            QString::fromUtf8("%1 × %2 mm")
                .arg(QString::number(volume.spacingMm.x, 'f', 3),
                     QString::number(volume.spacingMm.y, 'f', 3)));
    if (volume.placed) {
        if (volume.spacingMm.z > 0.0)
            row(StudyDetailsTexts::tr("Slice spacing"),
                StudyDetailsTexts::tr("%1 mm").arg(volume.spacingMm.z, 0, 'f', 3));
        row(StudyDetailsTexts::tr("Tilt"),
            StudyDetailsTexts::tr("%1 degrees").arg(volume.tiltDeg, 0, 'f', 1));
    }
    row(StudyDetailsTexts::tr("Files"),
        volume.libraryId == 0 ? QString::number(files.size())
        : volume.isCopied ? StudyDetailsTexts::tr("%1, copied into the library").arg(files.size())
                          : StudyDetailsTexts::tr("%1, referenced in place").arg(files.size()));
    row(StudyDetailsTexts::tr("Folder"), folderOf(files));
    for (const QString &warning : warningTexts(volume)) {
        PlainLabel *const text = value(warning);
        text->setProperty("role", "warning");
        form->addRow(new PlainLabel, text);
    }
}

} // namespace

void showStudyDetails(const StudyFacts &study, const VolumeFacts &volume, const QStringList &files,
                      const QImage &thumbnail, QWidget *parent) {
    auto *dialog = new QDialog(parent);
    dialog->setObjectName("studyDetails");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(StudyDetailsTexts::tr("Series details"));
    auto *form = new QFormLayout;
    form->setLabelAlignment(Qt::AlignLeft);
    form->setHorizontalSpacing(18);
    addFacts(form, study, volume, files);
    auto *picture = new PlainLabel;
    picture->setFixedSize(thumbnailPixels + 16, thumbnailPixels + 16);
    picture->setAlignment(Qt::AlignCenter);
    picture->setStyleSheet("background: black;");
    picture->setPixmap(QPixmap::fromImage(thumbnail));
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    auto *top = new QHBoxLayout;
    top->setSpacing(18);
    top->addWidget(picture, 0, Qt::AlignTop);
    top->addLayout(form, 1);
    auto *layout = new QVBoxLayout(dialog);
    layout->addLayout(top);
    layout->addWidget(buttons);
    dialog->resize(620, dialog->sizeHint().height());
    dialog->show();
}

} // namespace pellucid::ui
