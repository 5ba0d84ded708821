// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/subtraction_dialog.h"

#include <utility>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/document/document.h"
#include "ui/language/shown_text.h"
#include "ui/library/study_library.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

// A patient with more studies is found by a narrower search first.
constexpr int maxStudies = 100;

} // namespace

std::vector<StudySource> subtrahends(const Document &document, StudyLibrary &library) {
    const auto &sources = document.sources();
    const int open = document.currentSource();
    if (open < 0)
        return {};
    const StudySource &minuend = sources[std::size_t(open)];
    std::vector<StudySource> found;
    for (int n = 0; n < int(sources.size()); ++n) {
        const StudySource &other = sources[std::size_t(n)];
        if (n != open && !other.isClosed && other.volume.placed && !other.difference &&
            other.study.patientKey() == minuend.study.patientKey())
            found.push_back(other);
    }
    if (!minuend.study.hasPatient())
        return found; // volume files of different patients are alike
    const StudyPage page =
        library.find(patientText(minuend.study), StudyOrder::newestFirst, 0, maxStudies);
    for (const StudyFacts &study : page.studies) {
        if (study.patientKey() != minuend.study.patientKey())
            continue;
        for (const VolumeFacts &volume : library.volumes(study))
            if (volume.placed && document.sourceWith(study.key() + "\n" + volume.key()) < 0)
                found.push_back(librarySource(study, volume, library.files(study, volume)));
    }
    return found;
}

SubtractionDialog::SubtractionDialog(const StudySource &minuend,
                                     std::vector<StudySource> subtrahends, QWidget *parent)
    : QDialog(parent), m_subtrahends(std::move(subtrahends)), m_list(new QListWidget),
      m_align(new QCheckBox(tr("&Align it first (rotation and shift)"))), m_beside(new QComboBox) {
    setObjectName("subtractionDialog");
    setWindowTitle(tr("Subtract a volume"));
    setAttribute(Qt::WA_DeleteOnClose);
    setMinimumWidth(460);
    auto *what = new PlainLabel(tr("Subtract from %1, for example the pre-contrast phase:")
                                    .arg(seriesText(minuend.volume)));
    what->setWordWrap(true);
    m_list->setObjectName("subtrahendList");
    m_list->setAccessibleName(tr("Volumes of the patient"));
    for (const StudySource &source : m_subtrahends) {
        QString text = seriesText(source.volume);
        if (source.study.key() != minuend.study.key())
            text += ", " + studyText(source.study);
        auto *item = new QListWidgetItem(text, m_list);
        item->setToolTip(plainToolTip(sizeText(source.volume)));
    }
    m_align->setObjectName("alignBox");
    m_align->setToolTip(tr("By mutual information; takes several seconds"));
    m_beside->setObjectName("besideBox");
    m_beside->addItem(tr("Nothing"));
    m_beside->addItem(tr("The open volume"));
    m_beside->setAccessibleName(tr("Beside the difference"));
    m_beside->setToolTip(tr("Opens it at the right; both sides move together"));
    connect(m_align, &QCheckBox::toggled, this, &SubtractionDialog::showAlignment);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    m_subtract = buttons->addButton(tr("Subtract"), QDialogButtonBox::AcceptRole);
    m_subtract->setObjectName("subtractNowButton");
    m_subtract->setEnabled(!m_subtrahends.empty());
    connect(buttons, &QDialogButtonBox::accepted, this, &SubtractionDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &SubtractionDialog::reject);
    connect(m_list, &QListWidget::itemActivated, this, &SubtractionDialog::accept);
    auto *layout = new QVBoxLayout(this);
    layout->setSpacing(10);
    layout->addWidget(what);
    layout->addWidget(m_list);
    if (m_subtrahends.empty()) {
        auto *none =
            new PlainLabel(tr("No other volume of this patient is open or in the library."));
        none->setObjectName("noSubtrahend");
        none->setWordWrap(true);
        layout->addWidget(none);
    } else {
        m_list->setCurrentRow(0);
    }
    auto *form = new QFormLayout;
    form->addRow(m_align);
    form->addRow(tr("Beside the difference"), m_beside);
    layout->addLayout(form);
    layout->addWidget(buttons);
}

// Only an aligned volume is worth checking.
void SubtractionDialog::showAlignment() {
    const int aligned = int(BesideDifference::alignedSubtrahend);
    if (!m_align->isChecked()) {
        if (m_beside->currentIndex() == aligned)
            m_beside->setCurrentIndex(int(BesideDifference::nothing));
        m_beside->removeItem(aligned);
    } else if (m_beside->count() == aligned) {
        m_beside->addItem(tr("The aligned volume, to check the alignment"));
    }
}

void SubtractionDialog::accept() {
    const int row = m_list->currentRow();
    if (row < 0)
        return;
    emit chosen(m_subtrahends[std::size_t(row)],
                m_align->isChecked() ? std::make_shared<Alignment>() : nullptr,
                BesideDifference(m_beside->currentIndex()));
    QDialog::accept();
}

} // namespace pellucid::ui
