// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/classes_panel.h"

#include <algorithm>

#include <QColorDialog>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include "core/preprocess/segment_class.h"
#include "ui/dialogs/class_dialog.h"
#include "ui/document/document.h"
#include "ui/document/region_commands.h"
#include "ui/language/names.h"
#include "ui/language/shown_text.h"
#include "ui/panels/class_group.h"
#include "ui/panels/class_row.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

// A class for values that are not in HU: a band of the window.
classify::TissueClass ownClass(const classify::FieldWindow &window) {
    const double width = window.high - window.low;
    return {"Custom", window.low + 0.4 * width, window.low + 0.6 * width, 0.05 * width, 1.0, {}};
}

// More classes than a panel shows at once.
constexpr std::size_t manyClasses = 12;

QString capitalised(const std::string &name) {
    QString text = QString::fromStdString(name);
    return text.isEmpty() ? text : text.at(0).toUpper() + text.mid(1);
}

} // namespace

ClassesPanel::ClassesPanel(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_add(new QPushButton(tr("Add class"))),
      m_list(new QWidget), m_rows(new QVBoxLayout(m_list)),
      m_empty(new PlainLabel(tr("The transfer function applies to the whole volume. Add a class to "
                                "show tissues separately."))),
      m_search(new QLineEdit), m_area(new QScrollArea) {
    setPanelBackground(*this, "classesPanel");
    m_add->setObjectName("addClassButton");
    m_add->setToolTip(tr("Add a tissue class"));
    m_add->setProperty("role", "link");
    m_empty->setProperty("role", "muted");
    m_empty->setWordWrap(true);
    m_search->setObjectName("classSearch");
    m_search->setPlaceholderText(tr("Search classes"));
    m_search->setClearButtonEnabled(true);
    m_search->setToolTip(tr("Finds classes by their names and the terms of their codes"));
    m_search->setAccessibleName(tr("Search classes"));
    m_rows->setContentsMargins(0, 0, 4, 0);
    m_rows->setSpacing(1);
    m_rows->addWidget(m_empty);
    m_rows->addStretch();
    setPanelBackground(*m_list, "classList");
    setPanelBackground(*m_area, "classArea");
    m_area->setWidget(m_list);
    m_area->setWidgetResizable(true);
    m_area->setFrameShape(QFrame::NoFrame);
    m_area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(12, 0, 8, 6);
    column->setSpacing(2);
    column->addWidget(m_search);
    column->addWidget(m_area, 1);
    connect(m_add, &QPushButton::clicked, this, &ClassesPanel::showAddMenu);
    connect(m_search, &QLineEdit::textChanged, this, &ClassesPanel::arrange);
    document.whenever(Change::scene | Change::selection | Change::segments, this,
                      [this](Changes changes) {
                          if (changes & Change::volume) {
                              setEnabled(m_document.volume() && !m_document.isPreview());
                              m_add->setEnabled(isEnabled());
                              if (m_dialog)
                                  m_dialog->close();
                          }
                          showScene();
                      });
    setEnabled(false);
    m_add->setEnabled(false);
    showScene();
}

QWidget *ClassesPanel::corner() {
    return m_add;
}

void ClassesPanel::showScene() {
    const auto &classes = m_document.scene().look.classes;
    m_empty->setVisible(classes.empty());
    // The dialog refers to its class by index, which may have changed. A region tool may have added
    // steps, which the dialog would remove again.
    const bool isSame = m_dialog && m_shown.size() == classes.size() &&
                        classes[std::size_t(m_edited)].steps == m_dialog->original().steps;
    if (m_dialog && !isSame)
        m_dialog->close();
    makeRows(classes.size());
    for (std::size_t n = 0; n < classes.size(); ++n) {
        const segment::Segment *const segment =
            m_document.segments() ? m_document.segments()->find(classes[n].segment) : nullptr;
        m_shown[n]->show(classes[n], segment, int(n) == m_document.selectedClass());
    }
    m_search->setVisible(classes.size() > manyClasses);
    if (m_search->isHidden())
        m_search->clear();
    arrange();
}

void ClassesPanel::makeRows(std::size_t count) {
    while (m_shown.size() > count) {
        m_shown.back()->deleteLater();
        m_shown.pop_back();
    }
    while (m_shown.size() < count) {
        auto *row = new ClassRow(int(m_shown.size()), m_list);
        m_shown.push_back(row);
        connect(row, &ClassRow::chosen, &m_document, &Document::selectClass);
        connect(row, &ClassRow::toggled, this, &ClassesPanel::toggle);
        connect(row, &ClassRow::weightChanged, this, &ClassesPanel::setWeight);
        connect(row, &ClassRow::editRequested, this, &ClassesPanel::edit);
        connect(row, &ClassRow::menuRequested, this, &ClassesPanel::showMenu);
    }
}

const segment::Segmentation *ClassesPanel::fileOf(const classify::TissueClass &tissue) const {
    const auto &segments = m_document.segments();
    return segments ? segments->fileOf(tissue.segment) : nullptr;
}

// The search also finds the terms of a segment's codes, such as "bone".
bool ClassesPanel::isFound(const classify::TissueClass &tissue) const {
    const QString wanted = m_search->text().trimmed();
    const auto contains = [&](const std::string &text) {
        return QString::fromStdString(text).contains(wanted, Qt::CaseInsensitive);
    };
    const auto &segments = m_document.segments();
    const segment::Segment *const segment = segments ? segments->find(tissue.segment) : nullptr;
    return wanted.isEmpty() || contains(tissue.name) ||
           translatedName(tissue.name).contains(wanted, Qt::CaseInsensitive) ||
           (segment != nullptr &&
            (contains(segment->category.meaning) || contains(segment->type.meaning)));
}

void ClassesPanel::arrange() {
    const auto &classes = m_document.scene().look.classes;
    if (m_shown.size() != classes.size()) // a signal within a change; showScene follows
        return;
    std::vector<const segment::Segmentation *> files, fileOfClass;
    std::vector<bool> isListed;
    for (const classify::TissueClass &tissue : classes) {
        fileOfClass.push_back(fileOf(tissue));
        isListed.push_back(isFound(tissue));
        if (fileOfClass.back() != nullptr &&
            std::find(files.begin(), files.end(), fileOfClass.back()) == files.end())
            files.push_back(fileOfClass.back());
    }
    std::erase_if(m_groups, [&](ClassGroup *group) {
        const bool isGone = std::none_of(files.begin(), files.end(), [&](const auto *file) {
            return file->path == group->path();
        });
        if (isGone)
            group->deleteLater();
        return isGone;
    });
    std::vector<QWidget *> order{m_empty};
    const auto addRows = [&](const segment::Segmentation *file, bool isFolded) {
        for (std::size_t n = 0; n < classes.size(); ++n) {
            if (fileOfClass[n] != file)
                continue;
            order.push_back(m_shown[n]);
            m_shown[n]->setVisible(!isFolded && isListed[n]);
        }
    };
    addRows(nullptr, false);
    for (const segment::Segmentation *const file : files) {
        ClassGroup *const group = groupFor(*file);
        int shown = 0, listed = 0;
        for (std::size_t n = 0; n < classes.size(); ++n)
            if (fileOfClass[n] == file && isListed[n]) {
                ++listed;
                shown += classes[n].weight > 0.0 ? 1 : 0;
            }
        group->showCounts(shown, listed);
        order.push_back(group);
        group->setVisible(listed > 0);
        addRows(file, group->isFolded());
    }
    place(order);
}

ClassGroup *ClassesPanel::groupFor(const segment::Segmentation &file) {
    for (ClassGroup *const group : m_groups)
        if (group->path() == file.path)
            return group;
    auto *const group = new ClassGroup(QString::fromStdString(file.title), file.path, m_list);
    m_groups.push_back(group);
    connect(group, &ClassGroup::folded, this, &ClassesPanel::arrange);
    connect(group, &ClassGroup::toggled, this, [this, group] { toggleGroup(*group); });
    return group;
}

// During a drag nothing moves: laying out a hundred rows takes longer than a frame.
void ClassesPanel::place(const std::vector<QWidget *> &order) {
    bool isSame = m_rows->count() == int(order.size()) + 1; // the stretch
    for (std::size_t n = 0; isSame && n < order.size(); ++n)
        isSame = m_rows->itemAt(int(n))->widget() == order[n];
    if (isSame)
        return;
    while (m_rows->count() > 0)
        delete m_rows->takeAt(0); // the item; its widget stays
    for (QWidget *const widget : order)
        m_rows->addWidget(widget);
    m_rows->addStretch();
}

// Hides all that the list shows of a group, or shows them if all of them are hidden.
void ClassesPanel::toggleGroup(const ClassGroup &group) {
    const auto &classes = m_document.scene().look.classes;
    const auto belongs = [&](const classify::TissueClass &tissue) {
        const segment::Segmentation *const file = fileOf(tissue);
        return file != nullptr && file->path == group.path() && isFound(tissue);
    };
    const bool hides = std::any_of(classes.begin(), classes.end(), [&](const auto &tissue) {
        return belongs(tissue) && tissue.weight > 0.0;
    });
    const QString what =
        hides ? tr("Hide %1").arg(group.title()) : tr("Show %1").arg(group.title());
    change(what, [&](classify::Look &look) {
        for (classify::TissueClass &tissue : look.classes) {
            if (!belongs(tissue))
                continue;
            const QString name = QString::fromStdString(tissue.name);
            if (hides && tissue.weight > 0.0)
                m_hiddenWeight[name] = tissue.weight;
            tissue.weight = hides ? 0.0 : m_hiddenWeight.value(name, 1.0);
        }
    });
}

void ClassesPanel::change(const QString &what, const std::function<void(classify::Look &)> &edit,
                          DragId drag) {
    editLook(m_document, what, drag, edit);
}

void ClassesPanel::changeClass(int index, const QString &what,
                               const std::function<void(classify::TissueClass &)> &edit,
                               DragId drag) {
    // A different study may have been opened while a menu or a dialog was open.
    if (index < int(m_document.scene().look.classes.size()))
        change(
            what, [&](classify::Look &look) { edit(look.classes[std::size_t(index)]); }, drag);
}

void ClassesPanel::setWeight(int index, double weight, DragId drag) {
    changeClass(
        index, tr("Weight"), [&](classify::TissueClass &tissue) { tissue.weight = weight; }, drag);
}

void ClassesPanel::toggle(int index) {
    const auto &tissue = m_document.scene().look.classes[std::size_t(index)];
    const QString name = QString::fromStdString(tissue.name);
    if (tissue.weight > 0.0)
        m_hiddenWeight[name] = tissue.weight;
    const double weight = tissue.weight > 0.0 ? 0.0 : m_hiddenWeight.value(name, 1.0);
    const QString shownName = translatedName(tissue.name);
    changeClass(index,
                tissue.weight > 0.0 ? tr("Hide %1").arg(shownName) : tr("Show %1").arg(shownName),
                [&](classify::TissueClass &shown) { shown.weight = weight; });
}

void ClassesPanel::add(const classify::TissueClass &tissue) {
    change(tr("Add class"), [&](classify::Look &look) { classify::addClass(look, tissue); });
    m_document.selectClass(int(m_document.scene().look.classes.size()) - 1);
}

void ClassesPanel::showAddMenu() {
    QMenu menu;
    const auto &volume = m_document.volume();
    if (!volume || m_document.scene().look.classes.size() >= classify::maxClasses)
        return;
    // The standard ranges are in HU.
    const bool isHu = volume->unit() == volume::ValueUnit::hounsfield;
    if (isHu || volume->notes().isDifference) {
        for (classify::TissueClass tissue :
             isHu ? classify::standardClasses() : classify::differenceClasses()) {
            tissue.name = capitalised(tissue.name).toStdString();
            menu.addAction(menuText(translatedName(tissue.name)), this,
                           [this, tissue] { add(tissue); });
        }
        menu.addSeparator();
    }
    menu.addAction(tr("Custom range"), this, [this] {
        add(ownClass(m_document.fieldWindow()));
        edit(int(m_document.scene().look.classes.size()) - 1);
    });
    addSegments(menu);
    menu.setObjectName("addClassMenu");
    menu.exec(m_add->mapToGlobal(QPoint(0, m_add->height())));
}

// Segments that are loaded but not among the classes, the segmentations of the study, and others.
void ClassesPanel::addSegments(QMenu &menu) {
    menu.addSeparator();
    const auto &segments = m_document.segments();
    std::size_t index = m_document.scene().look.classes.size();
    const auto isShown = [&](const segment::Segment &segment) {
        const auto &classes = m_document.scene().look.classes;
        return std::any_of(classes.begin(), classes.end(),
                           [&](const auto &tissue) { return tissue.segment == segment.name; });
    };
    QStringList loaded;
    if (segments)
        for (const segment::Segmentation &segmentation : segments->segmentations()) {
            loaded << QString::fromStdString(segmentation.path.string());
            QMenu *of = nullptr;
            for (const segment::Segment &segment : segmentation.segments)
                if (!isShown(segment)) {
                    if (of == nullptr)
                        of = menu.addMenu(menuText(QString::fromStdString(segmentation.title)));
                    const auto tissue = preprocess::classOf(segment, index++);
                    of->addAction(menuText(QString::fromStdString(segment.name)), this,
                                  [this, tissue] { add(tissue); });
                }
        }
    if (const int source = m_document.currentSource(); source >= 0)
        for (const auto &[path, title] : m_document.sources()[std::size_t(source)].segmentations)
            if (!loaded.contains(path))
                menu.addAction(tr("Segments of %1").arg(menuText(title)), this,
                               [this, path = path] { emit segmentationRequested({path}); });
    menu.addAction(tr("Open segmentation..."), this, [this] { emit segmentationRequested({}); });
}

void ClassesPanel::showMenu(int index, const QPoint &globalAt) {
    QMenu menu;
    menu.setObjectName("classMenu");
    menu.addAction(tr("Edit..."), this, [this, index] { edit(index); });
    menu.addAction(tr("Color..."), this, [this, index] { chooseColor(index); });
    menu.addAction(tr("Show only this class"), this, [this, index] {
        change(tr("Show only this class"), [&](classify::Look &look) {
            for (std::size_t n = 0; n < look.classes.size(); ++n)
                if (int(n) != index)
                    look.classes[n].weight = 0.0;
                else if (look.classes[n].weight == 0.0)
                    look.classes[n].weight = 1.0;
        });
    });
    menu.addAction(tr("Volumes..."), this, &ClassesPanel::volumesRequested);
    menu.addSeparator();
    menu.addAction(tr("Remove"), this, [this, index] {
        change(tr("Remove class"), [&](classify::Look &look) {
            if (index < int(look.classes.size()))
                classify::removeClass(look, std::size_t(index));
        });
    });
    menu.exec(globalAt);
}

void ClassesPanel::edit(int index) {
    const auto &classes = m_document.scene().look.classes;
    if (index < 0 || index >= int(classes.size()))
        return;
    if (m_dialog)
        m_dialog->close();
    m_dialog = new ClassDialog(m_document, std::size_t(index), window());
    connect(m_dialog, &QDialog::accepted, this, [this, index, dialog = m_dialog.data()] {
        change(tr("Edit class"), [&](classify::Look &look) {
            if (index < int(look.classes.size()))
                classify::replaceClass(look, std::size_t(index),
                                       dialog->typed(look.classes[std::size_t(index)]));
        });
        askForPoints(m_document);
    });
    m_edited = index;
    m_dialog->show();
}

void ClassesPanel::chooseColor(int index) {
    const auto &classes = m_document.scene().look.classes;
    if (index >= int(classes.size()))
        return;
    const classify::Color c = classes[std::size_t(index)].color;
    const QColor chosen = QColorDialog::getColor(
        QColor::fromRgbF(float(c.red), float(c.green), float(c.blue)), this, tr("Color"));
    if (chosen.isValid())
        changeClass(index, tr("Color"), [&](classify::TissueClass &tissue) {
            tissue.color = classify::colorFromText(chosen.name().toStdString());
        });
}

} // namespace pellucid::ui
