// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of files and servers are shown letter by letter: whatever they contain, nothing is read,
// and nobody reads a different text.
#include "tests/ui/studies_window.h"

#include <atomic>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <QAbstractItemView>
#include <QClipboard>
#include <QHelpEvent>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPointer>
#include <QProcess>
#include <QTableWidget>
#include <QTextDocument>
#include <QToolTip>
#include <QTreeWidget>

#include "core/archive/reasons.h"
#include "core/presets/preset_library.h"
#include "core/segment/write_segmentation.h"
#include "tests/support/dicom_writer.h"
#include "ui/beside/study_beside.h"
#include "ui/dialogs/huge_question.h"
#include "ui/document/commands.h"
#include "ui/document/region_marking.h"
#include "ui/language/shown_text.h"
#include "ui/panels/class_row.h"
#include "ui/servers/login_dialog.h"
#include "ui/widgets/plain_label.h"
#include "ui/window/workbench.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

namespace {

// Notices whoever opens a named pipe to read it, and lets him go.
class WatchedPipe {
public:
    explicit WatchedPipe(const fs::path &path) {
        if (::mkfifo(path.c_str(), 0600) != 0)
            qFatal("no pipe");
        m_watching = std::jthread([this, path](const std::stop_token &stop) {
            while (!stop.stop_requested()) {
                // Succeeds only if there is a reader.
                if (const int end = ::open(path.c_str(), O_WRONLY | O_NONBLOCK); end >= 0) {
                    m_isRead = true;
                    ::close(end);
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
            }
        });
    }
    bool isRead() const { return m_isRead; }

private:
    std::atomic<bool> m_isRead = false;
    std::jthread m_watching;
};

// Characters that nobody sees: the first reverses the letters after it, the second has no width.
const QString reversal(QChar(0x202E)), noWidth(QChar(0x200B));

bool isShownInFull(const QString &text) {
    return !text.contains(reversal) && !text.contains(noWidth) && !text.contains('\r') &&
           !text.contains(QChar(0x1B));
}

// Where an ampersand marks a key, each is doubled.
bool isUnmarked(QString text) {
    return !text.remove("&&").contains('&') || !text.contains("Q&A");
}

QString clean(const QString &text) {
    return QString(text).remove(reversal).remove(noWidth);
}

} // namespace

class ShownTextsTest : public StudiesWindow {
    Q_OBJECT
private slots:
    // A name that looks like the rest of the heading neither replaces it nor hides it.
    void noNamePassesForAnotherField() {
        ui::StudySource source;
        source.study.patientName = QString::fromUtf8("SMITH^JOHN  ·  M  ·  ID 4711  •  CT") +
                                   QString(200, QChar(0x2800)) + QString(200, 'x');
        source.study.patientId = "REAL";
        source.study.birthDate = "19500101";
        const QString banner = ui::bannerText(source);
        const QString gap = QString::fromUtf8("  ·  ");
        QCOMPARE(banner.section(gap, 0, 0).size(), 64);
        QCOMPARE(banner.section(gap, 1, 1), QString("1950-01-01"));
        QCOMPARE(banner.section(gap, 2, 2), QString("ID REAL"));
    }

    void initTestCase() {
        StudiesWindow::initTestCase();
        const std::string pipe = (m_folder / "p").string();
        m_pipe = std::make_unique<WatchedPipe>(pipe);
        m_image = "<img src=\"" + QString::fromStdString(pipe) + "\">";
        m_name = "Q&A" + reversal + noWidth + m_image;
        for (const int series : {1, 2})
            writeSeries(m_folder / "study" / std::to_string(series), knobs(series));
        // Within an archive, and within a folder, a file with such a name.
        const fs::path named = m_folder / "study" / (m_image + "x").toStdString();
        fs::create_directories(named.parent_path());
        writeText(named, ""); // listed by its name
        QProcess packer;
        packer.start("python3",
                     {"-c",
                      "import sys, zipfile\n"
                      "zipfile.ZipFile(sys.argv[1], 'w').writestr(sys.argv[2], 'no image')",
                      path("names.zip"), "<b>/" + m_image + "x"});
        QVERIFY(packer.waitForFinished(patienceMs) && packer.exitCode() == 0);
    }

    // The test would notice a text that is read.
    void aTextThatIsReadIsNoticed() {
        QTextDocument document;
        document.setHtml(m_image);
        document.size();
        QTRY_VERIFY(m_pipe->isRead());
        fs::remove(m_folder / "p");
        m_pipe.reset();
        m_pipe = std::make_unique<WatchedPipe>(m_folder / "p");
    }

    void labelsAndTooltipsThatQtMakesArePlain() {
        QWidget window;
        window.setToolTip(m_image);
        window.show();
        hover(window, {1, 1});
        QMessageBox box(QMessageBox::NoIcon, m_image, m_image, QMessageBox::Ok);
        box.setInformativeText(m_image);
        box.show();
        look();
        QInputDialog input;
        input.setLabelText(m_image);
        input.show();
        look();
    }

    // Also one that is measured before it is polished.
    void aPlainLabelIsPlainFromTheBeginning() {
        ui::PlainLabel label(m_name + "\n" + reversal + "b");
        QCOMPARE(label.textFormat(), Qt::PlainText);
        QCOMPARE(label.text(), clean(m_name) + "\nb");
        label.setWordWrap(true);
        label.setText(m_image);
        label.heightForWidth(100);
        QVERIFY(!m_pipe->isRead());
    }

    void aTooltipIsWrappedAndKeepsItsLines() {
        const QString words = QString("word ").repeated(60).trimmed();
        const QString tip = ui::plainToolTip(words + "\n\n<b>\u65E5\u672C</b>");
        const QStringList lines = tip.split('\n');
        QVERIFY(lines.size() > 4);
        QCOMPARE(lines.mid(0, lines.size() - 2).join(' '), words);
        QCOMPARE(lines.mid(lines.size() - 2), QStringList({"", "<b>\u65E5\u672C</b>"}));
        QCOMPARE(ui::plainToolTip({}), QString());
        for (const QString &line : ui::plainToolTip(QString(1000, 'x')).split('\n'))
            QVERIFY(line.size() < 200);
    }

    // The steps follow each other; the first that fails ends the test.
    void everyTextOfAStudyIsShownLetterByLetter() {
        using Step = void (ShownTextsTest::*)();
        for (const Step step : {&ShownTextsTest::openTheStudy, &ShownTextsTest::openAnArchive,
                                &ShownTextsTest::openASegmentation, &ShownTextsTest::editAClass,
                                &ShownTextsTest::chooseAPreset, &ShownTextsTest::readTheHeader,
                                &ShownTextsTest::askTheQuestions, &ShownTextsTest::exportAPicture,
                                &ShownTextsTest::subtract, &ShownTextsTest::measureTheClasses,
                                &ShownTextsTest::importAndRemove, &ShownTextsTest::useAServer}) {
            (this->*step)();
            QVERIFY2(!m_pipe->isRead(), "a text was read as HTML");
            if (QTest::currentTestFailed())
                return;
        }
        QVERIFY2(m_tooltips > 50, qPrintable(QString::number(m_tooltips)));
    }

    // Pasted or opened in a spreadsheet, a name neither runs nor moves to another column.
    void aCopiedTableHasNoFormulasAndNoFurtherColumns() {
        open(headPath());
        choosePreset("Bone over soft tissue");
        ui::editLook(document(), "Names", ui::noDrag, [](classify::Look &look) {
            look.classes[0].name = "=HYPERLINK(\"x\")\ty";
            look.classes[1].name = "\t@SUM(1)";
        });
        find<QAction>("classVolumesAction")->trigger();
        auto *table = find<QTableWidget>("classVolumesTable");
        QTRY_COMPARE_WITH_TIMEOUT(table->rowCount(), 2, patienceMs);
        find<QPushButton>("copyVolumesButton")->click();
        const QStringList lines = QGuiApplication::clipboard()->text().split('\n');
        for (const int line : {0, 1, 2})
            QCOMPARE(lines[line].count('\t'), 5);
        QVERIFY2(lines[1].startsWith("\"'=HYPERLINK(\"\"x\"\") y\"\t"), qPrintable(lines[1]));
        QVERIFY2(lines[2].startsWith("' @SUM(1)\t"), qPrintable(lines[2]));
        QVERIFY2(!lines[1].contains("\t'"), qPrintable(lines[1])); // the numbers
    }

private:
    SeriesKnobs knobs(int series) const {
        SeriesKnobs knobs;
        knobs.rows = knobs.columns = 24;
        knobs.slices = 12;
        knobs.window = [](int) { return glm::dvec2(500, 2000); };
        knobs.change = [this, series](DicomWriter &w, int slice) {
            const std::string text = m_name.toStdString(), image = m_image.toStdString();
            const std::string number = std::to_string(series);
            w.put({0x0008, 0x0005}, "CS", std::string("ISO_IR 192"));
            w.put({0x0010, 0x0010}, "PN",
                  QString("<s>DOE" + reversal + noWidth + "^JANE</s>").toStdString());
            for (const DicomWriter::Tag &tag : {DicomWriter::Tag{0x0010, 0x0020},
                                                {0x0008, 0x1030},
                                                {0x0008, 0x103E},
                                                {0x0028, 0x1055},
                                                {0x0020, 0x0010}})
                w.put(tag, "LO", text);
            w.put({0x0010, 0x0030}, "DA", image);
            w.put({0x0010, 0x0040}, "CS", image);
            w.put({0x0018, 0x0015}, "CS", image);
            w.put({0x0008, 0x0020}, "DA", image);
            w.put({0x0020, 0x4000}, "LT", text + "\r\n=1+1\tx\x1b[2J");
            w.put({0x0020, 0x0011}, "IS", number);
            w.put({0x0020, 0x000E}, "UI", "1.2.826.0.1.3680043.8.498.3." + number);
            w.put({0x0008, 0x0018}, "UI",
                  "1.2.826.0.1.3680043.8.498.1." + number + "." + std::to_string(slice + 1));
        };
        return knobs;
    }
    QString path(const std::string &name) const {
        return QString::fromStdString((m_folder / name).string());
    }
    void hover(QWidget &widget, QPoint at) {
        QHelpEvent event(QEvent::ToolTip, at, widget.mapToGlobal(at));
        QCoreApplication::sendEvent(&widget, &event);
        for (const QWidget *top : QApplication::topLevelWidgets())
            if (const auto *tip = qobject_cast<const QLabel *>(top);
                tip != nullptr && top->inherits("QTipLabel")) {
                QCOMPARE(tip->textFormat(), Qt::PlainText);
                QVERIFY2(isShownInFull(tip->text()), qPrintable(tip->text()));
                ++m_tooltips;
            }
        QToolTip::hideText();
    }
    void look(QAbstractItemView &view, const QModelIndex &parent = {}) {
        constexpr int mostRows = 60;
        const QAbstractItemModel *const model = view.model();
        if (model == nullptr)
            return;
        for (int row = 0; row < std::min(mostRows, model->rowCount(parent)); ++row)
            for (int column = 0; column < model->columnCount(parent); ++column) {
                const QModelIndex index = model->index(row, column, parent);
                const QString text = index.data().toString();
                QVERIFY2(isShownInFull(text) && !text.contains('\t'), qPrintable(text));
                if (view.isVisible() && !index.data(Qt::ToolTipRole).toString().isEmpty()) {
                    view.scrollTo(index);
                    hover(*view.viewport(), view.visualRect(index).center());
                }
                if (column == 0)
                    look(view, index);
            }
    }
    // Every text that the program shows now.
    void look() {
        QCoreApplication::processEvents();
        const QWidgetList all = QApplication::allWidgets();
        // Tooltips come and go.
        for (const QPointer<QWidget> &widget : QList<QPointer<QWidget>>(all.begin(), all.end())) {
            if (widget == nullptr)
                continue;
            widget->ensurePolished();
            const QString what = widget->metaObject()->className() + (" " + widget->objectName());
            if (const auto *label = qobject_cast<const QLabel *>(widget.data())) {
                QVERIFY2(label->textFormat() == Qt::PlainText, qPrintable(what));
                QVERIFY2(isShownInFull(label->text()), qPrintable(what + label->text()));
            }
            if (const auto *button = qobject_cast<const QAbstractButton *>(widget.data()))
                QVERIFY2(isShownInFull(button->text()) && isUnmarked(button->text()),
                         qPrintable(what + button->text()));
            for (const QAction *action : widget->actions())
                QVERIFY2(isShownInFull(action->text()) && isUnmarked(action->text()) &&
                             isShownInFull(action->toolTip()),
                         qPrintable(what + action->text()));
            QVERIFY2(isShownInFull(widget->windowTitle()), qPrintable(widget->windowTitle()));
            if (widget->isVisible() && !widget->toolTip().isEmpty())
                hover(*widget, widget->rect().center());
            if (auto *view = qobject_cast<QAbstractItemView *>(widget.data()))
                look(*view);
            if (QTest::currentTestFailed())
                return;
        }
        QVERIFY2(!m_pipe->isRead(), "a text was read as HTML");
    }
    // Looks at a window and closes it.
    void lookAndClose(const char *name) {
        QTRY_VERIFY_WITH_TIMEOUT(dialog(name) != nullptr && dialog(name)->isVisible(), patienceMs);
        look();
        dialog(name)->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
    // Does what opens a menu that blocks, looks at the menu, and closes it.
    void lookAtMenuOf(const std::function<void()> &open) {
        bool isSeen = false;
        QTimer::singleShot(0, this, [&] {
            look();
            isSeen = QApplication::activePopupWidget() != nullptr;
            if (isSeen)
                QApplication::activePopupWidget()->close();
        });
        open();
        QTRY_VERIFY(isSeen);
    }

    void openTheStudy() {
        open(path("study"));
        QVERIFY(document().volume());
        auto *const heading = find<QLabel>("studyHeading");
        QVERIFY(heading->isVisible());
        QVERIFY2(heading->text().startsWith("<s>DOE JANE</s>  \u00B7  "),
                 qPrintable(heading->text()));
        QVERIFY2(heading->text().contains("ID " + clean(m_name)), qPrintable(heading->text()));
        QVERIFY(!heading->text().contains('\n'));
        QVERIFY(problems().contains("x: "));
        look();
        openPreferences();
        find<QAbstractButton>("patientTitleBox")->click();
        lookAndClose("preferencesDialog");
        QCOMPARE(mainWindow().windowTitle(), QString("<s>DOE JANE</s> - Pellucid"));
    }
    void openAnArchive() {
        const auto before = problems().size();
        open(path("names.zip"));
        QVERIFY(problems().size() > before);
        look();
    }
    void openASegmentation() {
        const volume::Volume &volume = *document().volume();
        const volume::GridSize size = volume.lattice().size();
        std::vector<segment::Segment> segments;
        for (const int n : {0, 1}) {
            volume::Coverage block;
            block.box = {{n * size.i / 2, 0, 0}, {(n + 1) * size.i / 2, size.j, size.k}};
            block.shares.assign(block.box.size().count(), volume::Coverage::whole);
            segment::Segment segment;
            segment.name = (QString::number(n) + m_name).toStdString();
            segment.type = {"39607008", "SCT", m_name.toStdString()};
            segment.coverage = std::make_shared<const volume::Coverage>(std::move(block));
            segments.push_back(segment);
        }
        segment::SegmentationLabels labels;
        labels.seriesDescription = m_name.toStdString();
        labels.study.studyUid = volume.notes().studyUid;
        labels.frameOfReferenceUid = volume.notes().frameOfReferenceUid;
        segment::writeSegmentation(m_folder / "seg.dcm", segments, volume.lattice(), labels);
        open(path("seg.dcm"));
        QCOMPARE(document().scene().look.classes.size(), std::size_t(2));
        QVERIFY(find<QLabel>("classGroupName")->text().startsWith(clean(m_name)));
        look();
        // The menu lists the segments that are not shown.
        ui::editLook(document(), m_name, ui::noDrag,
                     [](classify::Look &look) { look.classes.pop_back(); });
        settle();
        QVERIFY2(find<QAction>("undoAction")->text().contains("Q&&A"),
                 qPrintable(find<QAction>("undoAction")->text()));
        QCOMPARE(document().undoStack()->undoText(), ui::menuText(m_name));
        lookAtMenuOf([this] { find<QPushButton>("addClassButton")->click(); });
        document().undoStack()->undo();
        settle();
    }
    void editAClass() {
        ui::editLook(document(), "Step", ui::noDrag, [](classify::Look &look) {
            classify::Step step{classify::StepKind::difference};
            step.operand.name = look.classes[1].name;
            look.classes[0].steps.push_back(step);
        });
        document().selectClass(0);
        settle();
        document().marking().setTool(ui::RegionTool::connected);
        look();
        document().marking().setTool(ui::RegionTool::none);
        emit mainWindow().findChild<ui::ClassRow *>()->editRequested(0);
        lookAndClose("classDialog");
    }
    void chooseAPreset() {
        presets::Preset preset;
        preset.name = m_name.toStdString();
        preset.notes = m_name.toStdString() + "\n" + m_name.toStdString();
        preset.look.transferFunction.weights = {0.0, 1.0};
        presets::PresetLibrary::ofUser().save(preset);
        restart();
        open(path("study"));
        choosePreset(clean(m_name));
        QCOMPARE(document().undoStack()->undoText(), "Preset " + ui::menuText(m_name));
        look();
        auto *const gallery = find<QListWidget>("presetGallery");
        const QPoint at = gallery->visualItemRect(gallery->currentItem()).center();
        emit gallery->customContextMenuRequested(at);
        find<QAction>("removePresetAction")->trigger();
        lookAndClose("removePresetQuestion");
    }
    void readTheHeader() {
        find<QAction>("headerAction")->trigger();
        auto *const tree = find<QTreeWidget>("headerTree");
        QTRY_VERIFY_WITH_TIMEOUT(tree->topLevelItemCount() > 10, patienceMs);
        find<QPushButton>("copyHeaderButton")->click();
        for (const QString &line : QGuiApplication::clipboard()->text().split('\n'))
            QVERIFY2(line.isEmpty() || line.count('\t') == 3, qPrintable(line));
        lookAndClose("headerDialog");
    }
    void askTheQuestions() {
        ui::askForHuge(
            &mainWindow(),
            {{m_name.toStdString(), task::because::thereIsNoServer(m_name.toStdString())}}, [] {});
        lookAndClose("hugeQuestion");
        mainWindow().files().importPaths({m_name});
        lookAndClose("importDialog");
        ui::LoginDialog login(m_name, nullptr, &mainWindow());
        login.show();
        look();
    }
    void exportAPicture() {
        find<QAction>("exportPictureAction")->trigger();
        const fs::path picture = m_folder / "<b>x.png";
        writeText(picture, "");
        find<QLineEdit>("exportPathEdit")->setText(QString::fromStdString(picture.string()));
        find<QPushButton>("exportWriteButton")->click();
        lookAndClose("replaceQuestion");
        lookAndClose("exportDialog");
    }
    void subtract() {
        find<QAction>("subtractAction")->trigger();
        lookAndClose("subtractionDialog");
    }
    void measureTheClasses() {
        open(path("seg.dcm"));
        find<QAction>("classVolumesAction")->trigger();
        auto *const table = find<QTableWidget>("classVolumesTable");
        QTRY_VERIFY_WITH_TIMEOUT(table->rowCount() > 0, patienceMs);
        lookAndClose("classVolumesDialog");
    }
    void importAndRemove() {
        import(m_folder / "study", false);
        const QModelIndex study = list().index(0, 0);
        tree()->expand(study);
        QTRY_VERIFY(list().rowCount(study) > 1);
        choose(list().index(0, 0, study), "volumeDetailsAction");
        lookAndClose("studyDetails");
        choose(list().index(1, 0, study), "openBesideAction");
        QTRY_VERIFY_WITH_TIMEOUT(mainWindow().findChild<QLabel *>("besideName") != nullptr &&
                                     !jobs().isRunning(),
                                 patienceMs);
        QVERIFY(find<QLabel>("besideName")->text().startsWith("<s>DOE JANE</s>, "));
        look();
        choose(list().index(0, 0), "removeStudyAction");
        lookAndClose("removeStudyQuestion");
    }
    void useAServer() {
        archive::Server server;
        server.name = m_name.toStdString();
        server.peer.host = "127.0.0.1";
        server.peer.port = 9; // nobody answers
        server.peer.calledAe = "ANY";
        bench().servers.put(server);
        auto *const search = find<QLineEdit>("studySearch");
        search->setText("DOE");
        QTest::keyClick(search, Qt::Key_Return);
        QTRY_VERIFY_WITH_TIMEOUT(find<QLabel>("serverStates")->text().contains(QChar(0x26A0)),
                                 patienceMs);
        look();
        emit tree()->customContextMenuRequested(tree()->visualRect(list().index(0, 0)).center());
        QVERIFY(find<QMenu>("sendMenu")->actions().front()->text().startsWith("Q&&A"));
        lookAndClose("studyMenu");
        find<QAction>("serversAction")->trigger();
        lookAndClose("serversDialog");
        mainWindow().openLink(
            "pellucid://open?server=" + QString::fromUtf8(QUrl::toPercentEncoding(m_name)) +
            "&studyUID=1.2.3");
        lookAndClose("linkQuestion");
        server.peer.authentication = network::Authentication::basic;
        server.peer.usesTls = true;
        server.peer.user = m_name.toStdString();
        bench().servers.withSecrets({server}, &mainWindow(), [](const auto &) {});
        lookAndClose("secretDialog");
    }

    std::unique_ptr<WatchedPipe> m_pipe;
    QString m_image; ///< a tag that makes Qt open the pipe
    QString m_name;  ///< with it
    int m_tooltips = 0;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::ShownTextsTest>(argc, argv);
}

#include "shown_texts_test.moc"
