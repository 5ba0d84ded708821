// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/export_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>

#include "core/archive/sending.h"
#include "core/dicom/scan.h"
#include "core/files/session_folder.h"
#include "core/files/video_file.h"
#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/export/capture_labels.h"
#include "ui/export/reasons.h"
#include "ui/export/recipe_file.h"
#include "ui/jobs/job_runner.h"
#include "ui/jobs/job_strip.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/opening/recent_paths.h"
#include "ui/servers/server_book.h"
#include "ui/settings/file_dialogs.h"
#include "ui/views/mpr_view.h"
#include "ui/views/projection_view.h"
#include "ui/widgets/form.h"
#include "ui/widgets/plain_label.h"
#include "ui/widgets/question.h"

namespace pellucid::ui {

namespace {

QComboBox *box(const char *name, const QStringList &entries) {
    auto *box = new QComboBox;
    box->setObjectName(name);
    box->addItems(entries);
    return box;
}

} // namespace

ExportDialog::ExportDialog(const Document &document, const Panes &panes, JobRunner &jobs,
                           ServerBook &servers, QWidget *parent)
    : QDialog(parent), m_document(document), m_panes(panes), m_jobs(jobs), m_servers(servers),
      m_to(box("exportToBox", {})),
      m_pane(box("exportPaneBox", {tr("Axial"), tr("Coronal"), tr("Sagittal"), tr("Projection")})),
      m_format(box("exportFormatBox",
                   {tr("As it looks (PNG)"), tr("Grey in 16 bits (PNG)"),
                    tr("Values (NumPy, float)"), tr("Values (NRRD, float)"),
                    tr("DICOM Secondary Capture"), tr("Turntable, frames (PNG)"),
                    tr("Turntable, video (MP4)"), tr("Turntable, DICOM (multi-frame)")})),
      m_scale(box("exportScaleBox", {"1 x", "2 x", "3 x", "4 x"})),
      m_annotated(new QCheckBox(tr("With annotations"))), m_patient(new QComboBox),
      m_deidentified(new QCheckBox(tr("Without the patient's identity"))), m_path(new QLineEdit),
      m_where(new QWidget), m_frames(new QSpinBox), m_message(new PlainLabel) {
    setObjectName("exportDialog");
    setWindowTitle(tr("Export picture"));
    setAttribute(Qt::WA_DeleteOnClose);
    m_pane->setCurrentIndex(int(Pane::projection));
    if (!files::VideoFile::isAvailable())
        m_format->setItemText(int(PictureFormat::video), tr("Turntable video (MP4), needs ffmpeg"));
    m_annotated->setObjectName("exportAnnotatedBox");
    m_annotated->setChecked(true);
    m_annotated->setToolTip(tr("Names, letters, scale and measurements; without them the picture "
                               "does not mark the patient's sides"));
    m_deidentified->setObjectName("exportDeidentifiedBox");
    m_deidentified->setToolTip(tr("Removes the patient's name, ID, dates and study, and sets a new "
                                  "study UID (DICOM PS3.15, basic profile)"));
    m_patient->setObjectName("exportPatientBox");
    m_patient->setToolTip(tr("The patient's name in annotations: choose one or type a pseudonym"));
    m_patient->setEditable(true);
    m_patient->lineEdit()->setPlaceholderText(tr("no name"));
    m_patient->lineEdit()->setMaxLength(80);
    offerPatient();
    m_frames->setObjectName("exportFramesBox");
    m_frames->setRange(2, 720);
    m_frames->setValue(PictureExport().frameCount);
    m_frames->setToolTip(tr("Pictures of one turn around the patient"));
    m_path->setObjectName("exportPathEdit");
    m_path->setMinimumWidth(360);
    m_path->setText(QDir::toNativeSeparators(QDir(exportFolder()).filePath("projection.png")));
    m_message->setObjectName("exportMessage");
    m_message->setWordWrap(true);
    auto *other = new QPushButton(tr("Browse..."));
    other->setObjectName("exportBrowseButton");
    auto *where = new QHBoxLayout(m_where);
    where->setContentsMargins(0, 0, 0, 0);
    where->addWidget(m_path, 1);
    where->addWidget(other);
    m_to->setToolTip(tr("A file, or a server that stores DICOM pictures with the study"));
    auto *form = new QFormLayout(this);
    form->addRow(tr("Picture of"), m_pane);
    form->addRow(tr("Format"), m_format);
    form->addRow(tr("Size"), m_scale);
    form->addRow(QString(), m_annotated);
    form->addRow(tr("Patient"), m_patient);
    form->addRow(QString(), m_deidentified);
    form->addRow(tr("Frames"), m_frames);
    form->addRow(tr("To"), m_to);
    form->addRow(tr("File"), m_where);
    form->addRow(m_message);
    auto *buttons = new QDialogButtonBox;
    m_write = buttons->addButton(tr("Write"), QDialogButtonBox::AcceptRole);
    m_write->setObjectName("exportWriteButton");
    m_close = buttons->addButton(QDialogButtonBox::Cancel);
    m_recipe = buttons->addButton(tr("Save as recipe..."), QDialogButtonBox::ActionRole);
    m_recipe->setObjectName("saveRecipeButton");
    m_recipe->setToolTip(tr("A file for pellucid-cli batch, which makes the same picture of many "
                            "studies"));
    connect(m_recipe, &QPushButton::clicked, this, &ExportDialog::saveRecipe);
    form->addRow(new JobStrip(jobs, "export"));
    form->addRow(buttons);
    connect(&servers, &ServerBook::changed, this, &ExportDialog::offerServers);
    offerServers();
    connect(m_to, &QComboBox::currentIndexChanged, this, &ExportDialog::chooseCapture);
    for (QComboBox *choice : {m_pane, m_format, m_scale, m_to})
        connect(choice, &QComboBox::currentIndexChanged, this, &ExportDialog::showChosen);
    for (QCheckBox *choice : {m_annotated, m_deidentified})
        connect(choice, &QCheckBox::toggled, this, &ExportDialog::showChosen);
    connect(&m_panes.projection->frames(), &ProjectionFrames::finalShown, this,
            &ExportDialog::showChosen);
    document.whenever(Change::volume, this, [this] {
        offerPatient();
        showChosen();
    });
    connect(other, &QPushButton::clicked, this, &ExportDialog::browse);
    connect(buttons, &QDialogButtonBox::accepted, this, &ExportDialog::write);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    showChosen();
}

ExportDialog::~ExportDialog() {
    if (m_isWorking) // others use the runner, too
        m_jobs.cancel();
}

PictureExport ExportDialog::chosen() const {
    return {Pane(m_pane->currentIndex()),
            PictureFormat(m_format->currentIndex()),
            m_scale->currentIndex() + 1,
            m_annotated->isChecked(),
            m_frames->value(),
            m_deidentified->isEnabled() && m_deidentified->isChecked(),
            m_patient->currentText().trimmed()};
}

// A name belongs to one study, and so does a pseudonym.
void ExportDialog::offerPatient() {
    if (m_document.currentSource() == m_patientOf)
        return;
    m_patientOf = m_document.currentSource();
    m_patient->clear();
    if (m_patientOf >= 0) {
        const dicom::CaptureLabels study = studyLabels(m_document);
        const QString named = QStringList{personText(QString::fromStdString(study.patientName)),
                                          QString::fromStdString(study.patientId)}
                                  .join("  ")
                                  .trimmed();
        if (!named.isEmpty())
            m_patient->addItem(shownText(named));
    }
    m_patient->addItem(QString());
    m_patient->setCurrentIndex(0);
}

// Servers store nothing else.
void ExportDialog::chooseCapture() {
    const PictureExport what = chosen();
    if (!chosenServer().isEmpty() && !what.isCapture())
        m_format->setCurrentIndex(
            int(what.isTurn() ? PictureFormat::captureLoop : PictureFormat::capture));
}

void ExportDialog::showChosen() {
    const PictureExport what = chosen();
    m_annotated->setEnabled(what.isPicture());
    m_frames->setEnabled(what.isTurn());
    m_deidentified->setEnabled(what.isPicture());
    m_patient->setEnabled(what.isPicture() && what.isAnnotated && !what.isDeidentified);
    const QWidget *const pane = m_panes.of(what.pane);
    const QSize pixels = pane->size() * pane->devicePixelRatioF() * what.scale;
    const bool isSent = !chosenServer().isEmpty();
    auto why = obstacle(what, m_panes, m_document);
    if (!why && isSent && !what.isCapture())
        why = task::because::onlyCapturesAreSent;
    m_recipe->setEnabled(!obstacleToRecipe(what, m_panes, m_document));
    form()->setRowVisible(m_where, !isSent);
    m_write->setText(isSent ? tr("Send") : tr("Write"));
    if (m_jobs.isRunning()) // the choice is made
        return;
    QString text =
        tr("%1 x %2 pixels").arg(QString::number(pixels.width()), QString::number(pixels.height()));
    if (what.isCapture())
        text +=
            "; " + (m_deidentified->isChecked() ? tr("does not identify the patient")
                                                : tr("contains the patient's name and identifier"));
    if (what.format == PictureFormat::frames)
        text += "; " + tr("one file for each frame, numbered");
    showMessage(why ? translated(*why) : text, why ? "warning" : "muted");
    m_write->setEnabled(!why);
    // The suffix follows the format, unless the user chose another suffix.
    QString path = m_path->text();
    for (int format = 0; format < m_format->count(); ++format)
        if (const QString known = suffixOf(PictureFormat(format));
            path.endsWith(known, Qt::CaseInsensitive)) {
            path.chop(known.size());
            m_path->setText(path + suffixOf(what.format));
            break;
        }
}

void ExportDialog::browse() {
    const QString suffix = suffixOf(chosen().format);
    const QString path = askForSavePath(this, tr("Export picture"), m_path->text(), "*" + suffix);
    if (path.isEmpty())
        return;
    m_path->setText(QDir::toNativeSeparators(path));
    m_confirmed = m_path->text(); // the file dialog has asked
}

void ExportDialog::saveRecipe() {
    const QString path =
        askForSavePath(this, tr("Save as recipe"), QDir(exportFolder()).filePath("recipe.json"),
                       tr("Recipe (*.json)"));
    if (path.isEmpty())
        return;
    try {
        writeRecipe(path, chosen(), m_panes, m_document);
        showMessage(tr("Saved to %1").arg(path), "muted");
    } catch (const task::Error &error) {
        showMessage(translated(error.reason()), "warning");
    }
}

void ExportDialog::showMessage(const QString &text, const char *role) {
    setMessage(*m_message, text, role);
}

QFormLayout *ExportDialog::form() const {
    return static_cast<QFormLayout *>(layout());
}

QString ExportDialog::chosenServer() const {
    return m_to->currentData().toString();
}

void ExportDialog::offerServers() {
    const QString before = chosenServer();
    const QSignalBlocker quiet(m_to);
    m_to->clear();
    m_to->addItem(tr("File"));
    for (const QString &server : m_servers.names())
        m_to->addItem(shownText(server), server);
    m_to->setCurrentIndex(std::max(0, m_to->findData(before)));
    form()->setRowVisible(m_to, m_to->count() > 1);
}

void ExportDialog::write() {
    const QString server = chosenServer();
    if (server.isEmpty()) {
        writeTo(m_path->text());
        return;
    }
    if (m_jobs.isRunning()) {
        showMessage(tr("Another export is running"), "warning");
        return;
    }
    // Once, and what is chosen now, although it may take a while to get the password.
    m_write->setEnabled(false);
    m_servers.withSecrets({server}, this,
                          [self = QPointer<ExportDialog>(this),
                           what = chosen()](const std::vector<archive::Server> &servers) {
                              if (self == nullptr)
                                  return;
                              if (servers.empty() || self->m_jobs.isRunning())
                                  self->showChosen();
                              else
                                  self->send(servers.front(), what);
                          });
}

void ExportDialog::writeTo(const QString &path) {
    const QString first = firstFileOf(chosen(), path);
    const bool isConfirmed = path == m_confirmed && first == path;
    if (isConfirmed || !QFileInfo::exists(first))
        replace(path);
    else
        ask(this,
            {"replaceQuestion", tr("Export picture"),
             tr("%1 already exists. Replace it?").arg(QFileInfo(first).fileName()), tr("Replace")},
            [this, path] { replace(path); });
}

void ExportDialog::replace(const QString &path) {
    try {
        start(tr("Writing"),
              [this, path, isOfStudy = chosen().isCapture() && !chosen().isDeidentified,
               writer = pictureWriter(chosen(), m_panes, m_document, path)](const Job &job) {
                  writer(job.progress());
                  std::shared_ptr<const dicom::Catalogue> capture;
                  if (isOfStudy)
                      capture = std::make_shared<const dicom::Catalogue>(
                          dicom::scan({path.toStdString()}));
                  job.deliver([this, path, capture] {
                      setExportFolder(QFileInfo(path).absolutePath(), m_document);
                      emit written(path);
                      if (capture)
                          emit captured(capture);
                      close();
                  });
              });
    } catch (const task::Error &error) {
        showMessage(translated(error.reason()), "warning");
    }
}

void ExportDialog::send(const archive::Server &server, const PictureExport &what) {
    try {
        const auto folder = std::make_shared<const files::SessionFolder>();
        const std::filesystem::path file = folder->path() / "capture.dcm";
        start(tr("Sending to %1").arg(QString::fromStdString(server.name)),
              [this, server, folder, file,
               writer = pictureWriter(what, m_panes, m_document,
                                      QString::fromStdString(file.string()))](const Job &job) {
                  writer(job.progress());
                  const auto report = archive::send(server, {file}, {}, job.progress());
                  if (!report.notSent.empty())
                      throw task::Error(task::ErrorCode::incomplete, report.notSent.front().reason,
                                        server.name);
                  job.deliver([this, name = QString::fromStdString(server.name)] {
                      m_sentTo = name;
                      emit sent(name);
                  });
              });
    } catch (const task::Error &error) {
        showMessage(translated(error.reason()), "warning");
    }
}

void ExportDialog::start(const QString &title, const std::function<void(const Job &)> &work) {
    m_isWorking = true;
    m_sentTo.clear();
    m_jobs.start(title, work, [this](const Outcome &outcome) {
        m_isWorking = false;
        showChosen();
        if (outcome.kind == Outcome::Kind::done && !m_sentTo.isEmpty()) {
            // Not twice, unless something else is chosen.
            m_write->setEnabled(false);
            m_close->setText(tr("Close"));
            m_close->setFocus();
            showMessage(tr("Sent to %1").arg(m_sentTo), "muted");
        }
        if (outcome.kind == Outcome::Kind::failed)
            showMessage(translated(*outcome.reason), "warning");
    });
    if (m_jobs.isRunning()) // it is not if no thread could be had
        m_write->setEnabled(false);
}

} // namespace pellucid::ui
