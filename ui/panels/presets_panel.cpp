// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/presets_panel.h"

#include <algorithm>

#include <QFileInfo>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QStyledItemDelegate>
#include <QUndoCommand>
#include <QVBoxLayout>

#include "core/classify/couch.h"
#include "core/dicom/reasons.h"
#include "core/presets/slicer_preset.h"
#include "core/task/error.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/document/region_commands.h"
#include "ui/engine/look_previewer.h"
#include "ui/language/names.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/opening/reasons.h"
#include "ui/panels/reasons.h"
#include "ui/settings/file_dialogs.h"
#include "ui/theme/theme.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"
#include "ui/widgets/question.h"

namespace pellucid::ui {

namespace {

// The untranslated name of a preset.
constexpr int nameRole = Qt::UserRole;

// It comes first of the built-in ones.
constexpr auto plainPreset = "X-ray";

constexpr QSize pictureSize{LookPreviewer::pictureWidth, LookPreviewer::pictureHeight};

QIcon emptyIcon() {
    QPixmap pixmap(pictureSize);
    pixmap.fill(QColor::fromRgb(pictureBackground));
    return QIcon(pixmap);
}

// Paints the picture of a preset and its name in up to two lines; Qt's own has one.
class PresetPainter : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter *painter, const QStyleOptionViewItem &option,
               const QModelIndex &index) const override {
        QStyleOptionViewItem item = option;
        initStyleOption(&item, index);
        const QWidget *const view = item.widget;
        view->style()->drawPrimitive(QStyle::PE_PanelItemViewItem, &item, painter, view);
        QRect picture(QPoint(), pictureSize);
        picture.moveCenter(item.rect.center());
        picture.moveTop(item.rect.top() + margin);
        item.icon.paint(painter, picture, Qt::AlignCenter,
                        item.state.testFlag(QStyle::State_Enabled) ? QIcon::Normal
                                                                   : QIcon::Disabled);
        painter->setFont(view->font());
        const bool isSelected = item.state.testFlag(QStyle::State_Selected);
        painter->setPen(item.palette.color(isSelected ? QPalette::Highlight : QPalette::Text));
        const QRect below = item.rect.adjusted(margin, 0, -margin, -margin);
        painter->drawText(QRect(below.left(), picture.bottom() + margin, below.width(),
                                below.bottom() - picture.bottom()),
                          Qt::AlignHCenter | Qt::AlignTop,
                          twoLines(item.text, view->fontMetrics(), below.width()));
    }

private:
    static constexpr int margin = 3;

    static QString twoLines(const QString &text, const QFontMetrics &metrics, int width) {
        if (metrics.horizontalAdvance(text) <= width)
            return text;
        // As many words as fit, then the rest.
        qsizetype at = -1;
        for (qsizetype space = text.indexOf(' '); space >= 0; space = text.indexOf(' ', space + 1))
            if (metrics.horizontalAdvance(text.left(space)) <= width)
                at = space;
        qsizetype end = at; // without a blank, as in Chinese, between letters
        while (at < 0 && metrics.horizontalAdvance(text.left(end + 1)) <= width)
            ++end;
        const QString first = text.left(end);
        const QString rest = text.mid(at < 0 ? end : at + 1);
        return first + "\n" + metrics.elidedText(rest, Qt::ElideRight, width);
    }
};

} // namespace

PresetsPanel::PresetsPanel(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_library(presets::PresetLibrary::ofUser()),
      m_corner(new QWidget), m_listsAll(new QPushButton(tr("All"))), m_save(new QPushButton),
      m_gallery(new QListWidget), m_name(new QLineEdit), m_confirm(new QPushButton(tr("Save"))),
      m_nameRow(new QWidget), m_message(new PlainLabel), m_empty(new PlainLabel) {
    setPanelBackground(*this, "presetsPanel");
    m_gallery->setObjectName("presetGallery");
    m_gallery->setAccessibleName(tr("Presets"));
    m_gallery->setViewMode(QListView::IconMode);
    m_gallery->setMovement(QListView::Static);
    m_gallery->setResizeMode(QListView::Adjust);
    m_gallery->setIconSize(pictureSize);
    // Names have two lines.
    m_gallery->setGridSize(pictureSize + QSize(4, 36));
    m_gallery->setItemDelegate(new PresetPainter(m_gallery));
    m_gallery->setSpacing(0);
    m_gallery->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_gallery->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_gallery->setContextMenuPolicy(Qt::CustomContextMenu);
    m_save->setText(tr("Save look"));
    m_save->setObjectName("saveLookButton");
    m_save->setToolTip(tr("Save the current look as your own preset (Ctrl+S)"));
    m_save->setProperty("role", "link");
    m_listsAll->setObjectName("allPresetsButton");
    m_listsAll->setCheckable(true);
    m_listsAll->setToolTip(
        tr("List all presets, not only those for the body region of the open study"));
    m_listsAll->setProperty("role", "link");
    auto *corner = new QHBoxLayout(m_corner);
    corner->setContentsMargins(0, 0, 0, 0);
    corner->setSpacing(10);
    corner->addWidget(m_listsAll);
    corner->addWidget(m_save);
    m_name->setObjectName("lookNameEdit");
    m_name->setAccessibleName(tr("Name of the look"));
    m_name->setMaxLength(60);
    m_name->installEventFilter(this);
    m_confirm->setObjectName("confirmLookButton");
    m_message->setObjectName("presetMessage");
    m_message->setProperty("role", "warning");
    m_message->setWordWrap(true);
    m_message->hide();
    m_empty->setObjectName("presetsEmpty");
    m_empty->setProperty("role", "muted");
    m_empty->setWordWrap(true);

    auto *nameLayout = new QHBoxLayout(m_nameRow);
    nameLayout->setContentsMargins(0, 0, 0, 0);
    nameLayout->addWidget(m_name, 1);
    nameLayout->addWidget(m_confirm);
    m_nameRow->hide();
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(12, 0, 4, 6);
    column->setSpacing(2);
    column->addWidget(m_nameRow);
    column->addWidget(m_message);
    column->addWidget(m_empty, 0, Qt::AlignTop);
    column->addWidget(m_gallery, 1);
    connectControls();
    setEnabled(false);
    m_save->setEnabled(false);
    list();
}

void PresetsPanel::connectControls() {
    connect(m_save, &QPushButton::clicked, this, &PresetsPanel::askForName);
    connect(m_listsAll, &QPushButton::toggled, this, &PresetsPanel::list);
    connect(m_confirm, &QPushButton::clicked, this, &PresetsPanel::saveLook);
    connect(m_name, &QLineEdit::returnPressed, this, &PresetsPanel::saveLook);
    connect(m_gallery, &QListWidget::itemClicked, this, &PresetsPanel::apply);
    connect(m_gallery, &QListWidget::itemActivated, this, &PresetsPanel::apply);
    connect(m_gallery, &QListWidget::customContextMenuRequested, this, &PresetsPanel::showMenu);
    m_document.whenever(Change::scene, this, &PresetsPanel::showCurrent);
    m_document.whenever(Change::volume, this, [this] {
        if (m_document.isPreview())
            return;
        m_nameRow->hide();
        setEnabled(m_document.volume() && m_document.volume()->notes().placed);
        m_save->setEnabled(isEnabled());
        list();
    });
}

QWidget *PresetsPanel::corner() {
    return m_corner;
}

template <class F> void PresetsPanel::attempt(const F &what) {
    m_message->hide();
    try {
        what();
    } catch (const task::Error &error) {
        m_message->setText(translated(error.reason()));
        m_message->show();
        emit failed(error.reason(), QString::fromStdString(error.path().string()));
    }
}

bool PresetsPanel::suits(const presets::Preset &preset) const {
    const auto &volume = m_document.volume();
    return !volume || !presets::mismatch(preset, *volume);
}

bool PresetsPanel::isOffered(const presets::PresetEntry &entry) const {
    return suits(entry.preset) &&
           (m_listsAll->isChecked() || !entry.isBuiltIn() || !m_document.volume() ||
            presets::isFor(entry.preset, m_document.traits()));
}

void PresetsPanel::list() {
    std::vector<presets::Preset> listed;
    m_gallery->clear();
    // The user's own first, then those for the region, for any, and for others.
    std::vector<const presets::PresetEntry *> offered;
    for (const auto &entry : m_library.entries())
        if (isOffered(entry))
            offered.push_back(&entry);
    const auto rank = [this](const presets::PresetEntry *entry) {
        if (!entry->isBuiltIn())
            return 0;
        if (entry->preset.name == plainPreset)
            return 1;
        if (!presets::isFor(entry->preset, m_document.traits()))
            return 4;
        return entry->preset.regions.empty() ? 3 : 2;
    };
    std::stable_sort(offered.begin(), offered.end(),
                     [&](const auto *a, const auto *b) { return rank(a) < rank(b); });
    for (const presets::PresetEntry *offer : offered) {
        const presets::PresetEntry &entry = *offer;
        listed.push_back(entry.preset);
        const QString name = QString::fromStdString(entry.preset.name);
        auto *item = new QListWidgetItem(emptyIcon(), translatedName(entry.preset.name));
        item->setData(nameRole, name);
        item->setToolTip(plainToolTip(
            entry.preset.notes.empty() ? name
                                       : name + ": " + QString::fromStdString(entry.preset.notes)));
        item->setSizeHint(m_gallery->gridSize()); // of two lines, also if the name has one
        m_gallery->addItem(item);
    }
    const bool isOpen = m_document.volume().has_value();
    m_empty->setText(!isOpen ? tr("Open a study to see it with the presets.")
                             : tr("Pictures without positions have no projection, and so no "
                                  "presets."));
    m_empty->setVisible(!isOpen || !m_document.volume()->notes().placed);
    m_gallery->setVisible(m_empty->isHidden());
    showCurrent();
    if (!m_library.skipped().empty()) {
        const auto &first = m_library.skipped().front();
        m_message->setText(tr("%1 is not a preset: %2")
                               .arg(QString::fromStdString(first.path.filename().string()),
                                    translated(first.reason)));
        m_message->show();
    }
    if (m_document.volume()) // even without presets: the previewer also makes the histogram
        emit presetsListed(listed);
}

QListWidgetItem *PresetsPanel::itemOf(const QString &preset) const {
    for (int n = 0; n < m_gallery->count(); ++n)
        if (m_gallery->item(n)->data(nameRole) == preset)
            return m_gallery->item(n);
    return nullptr;
}

void PresetsPanel::setPicture(const QString &preset, const QImage &picture) {
    if (picture.isNull())
        return;
    if (QListWidgetItem *const item = itemOf(preset))
        item->setIcon(QIcon(QPixmap::fromImage(picture)));
}

void PresetsPanel::showCurrent() {
    const scene::Scene &scene = m_document.scene();
    const classify::FieldWindow shown = m_document.fieldWindow();
    m_gallery->setCurrentItem(nullptr);
    if (!m_document.volume()) {
        emit lookNamed({});
        return;
    }
    // All phases of values without a unit use the window of the first.
    const bool isFree = !volume::isCalibrated(m_document.volume()->unit());
    const classify::FieldWindow defaultWindow = isFree ? shown : m_document.defaultFieldWindow();
    QString current = tr("Custom look");
    // With or without the couch, it is the same preset.
    const auto isShown = [&](classify::Look look) {
        if (look == scene.look)
            return true;
        classify::Look present = scene.look;
        classify::removeCouch(look, shown);
        classify::removeCouch(present, shown);
        return look == present;
    };
    if (isShown({}) && scene.shading == shading::Shading() && shown == defaultWindow)
        current = tr("Plain density");
    const presets::PresetEntry *found = nullptr;
    for (const auto &entry : m_library.entries()) {
        const auto window = entry.preset.window.value_or(defaultWindow);
        if (!suits(entry.preset) || !(window == shown) ||
            !isShown(presets::lookFor(entry.preset, window)) ||
            !(entry.preset.shading == scene.shading))
            continue;
        // If several have the same look, prefer the last chosen or saved.
        const bool isChosen = QString::fromStdString(entry.preset.name) == m_chosen;
        if (found == nullptr || isChosen)
            found = &entry;
    }
    if (found != nullptr) {
        current = translatedName(found->preset.name);
        if (QListWidgetItem *const item = itemOf(QString::fromStdString(found->preset.name)))
            m_gallery->setCurrentItem(item);
    }
    emit lookNamed(current);
}

void PresetsPanel::apply(QListWidgetItem *item) {
    const auto *entry = m_library.find(item->data(nameRole).toString().toStdString());
    if (entry == nullptr || !m_document.volume())
        return;
    m_chosen = item->data(nameRole).toString();
    if (const QStringList missing =
            missingSegments(entry->preset.look, m_document.segments().get());
        !missing.isEmpty()) {
        emit failed(task::because::sceneNeedsSegments(missing.join(", ").toStdString()),
                    item->text());
        return;
    }
    editScene(m_document, tr("Preset %1").arg(item->text()), noDrag, [&](scene::Scene &scene) {
        const bool isWithoutCouch = classify::isWithoutCouch(scene.look);
        scene.fieldWindow = entry->preset.window;
        const auto window = scene.fieldWindow.value_or(m_document.defaultFieldWindow());
        scene.look = presets::lookFor(entry->preset, window);
        if (isWithoutCouch)
            classify::removeCouch(scene.look, window);
        scene.shading = entry->preset.shading;
    });
    askForPoints(m_document);
}

void PresetsPanel::askForName() {
    if (!isEnabled())
        return;
    // Suggest an unused name, so that a second click is enough.
    int number = 1;
    const auto name = [&] { return tr("Custom look %1").arg(number); };
    while (m_library.find(name().toStdString()) != nullptr)
        ++number;
    m_message->hide();
    m_name->setText(name());
    m_nameRow->show();
    m_name->setFocus();
    m_name->selectAll();
}

void PresetsPanel::saveLook() {
    if (!m_document.volume())
        return;
    attempt([&] {
        const QString name = m_name->text().trimmed();
        if (name.isEmpty())
            throw task::Error(task::ErrorCode::usage, task::because::lookNeedsAName);
        m_library.save(presets::presetOf(name.toStdString(), m_document.scene().look,
                                         m_document.scene().shading, m_document.fieldWindow(),
                                         *m_document.volume()));
        m_nameRow->hide();
        m_chosen = name;
        list();
        if (QListWidgetItem *const item = itemOf(name))
            m_gallery->scrollToItem(item);
        const classify::Look &look = m_document.scene().look;
        if (!(classify::withoutMarks(look) == look)) {
            m_message->setText(tr("Points, strokes and cuts belong to this study and are not saved "
                                  "in the preset. When you apply it, it asks for new points."));
            m_message->show();
        }
    });
}

bool PresetsPanel::eventFilter(QObject *watched, QEvent *event) {
    if (watched == m_name && event->type() == QEvent::KeyPress &&
        static_cast<QKeyEvent *>(event)->key() == Qt::Key_Escape) {
        m_nameRow->hide();
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

// Removes one of the user's presets and brings it back.
class PresetsPanel::Removal : public QUndoCommand {
public:
    Removal(PresetsPanel &panel, const presets::Preset &preset)
        : QUndoCommand(editText(tr("Delete preset %1").arg(QString::fromStdString(preset.name)))),
          m_panel(panel), m_preset(preset) {}
    void redo() override {
        if (m_isRemoved)
            return;
        change([&](presets::PresetLibrary &library) {
            library.remove(m_preset.name);
            m_isRemoved = true;
        });
    }
    void undo() override {
        change([&](presets::PresetLibrary &library) {
            if (library.find(m_preset.name) != nullptr) // saved since then: it stays
                throw task::Error(task::ErrorCode::usage, task::because::existsAlready);
            library.save(m_preset);
            m_isRemoved = false;
        });
    }

private:
    template <class F> void change(const F &what) {
        m_panel.attempt([&] {
            what(m_panel.m_library);
            m_panel.list();
        });
    }

    PresetsPanel &m_panel;
    const presets::Preset m_preset;
    bool m_isRemoved = false;
};

void PresetsPanel::askToRemove(const QString &name) {
    ask(window(),
        {"removePresetQuestion", tr("Delete preset"),
         tr("Delete the preset %1? Undo brings it back as long as the study is open.").arg(name),
         tr("Delete")},
        [this, name] {
            if (const auto *const entry = m_library.find(name.toStdString()))
                m_document.undoStack()->push(new Removal(*this, entry->preset));
        });
}

void PresetsPanel::importPreset() {
    const QString path = askForFile(this, tr("Import preset"),
                                    tr("Presets and 3D Slicer volume properties (*.json *.vp)"));
    if (path.isEmpty())
        return;
    attempt([&] {
        QString fit;
        presets::Preset preset;
        if (presets::isSlicerPreset(path.toStdString())) {
            auto imported = presets::importSlicerPreset(path.toStdString());
            preset = std::move(imported.preset);
            fit = tr("'%1' was fitted; the largest error of its opacity is %2")
                      .arg(QString::fromStdString(preset.name),
                           QString::number(imported.largestError, 'g', 2));
        } else {
            preset = presets::readPreset(path.toStdString());
        }
        // An import must not replace a saved preset of the same name.
        const std::string wanted = preset.name;
        for (int n = 2; m_library.find(preset.name) != nullptr; ++n)
            preset.name = wanted + " " + std::to_string(n);
        m_library.save(preset);
        list();
        m_message->setText(fit);
        m_message->setVisible(!fit.isEmpty());
    });
}

void PresetsPanel::exportPreset() {
    if (!m_document.volume())
        return;
    const QListWidgetItem *current = m_gallery->currentItem();
    const auto *entry = current != nullptr
                            ? m_library.find(current->data(nameRole).toString().toStdString())
                            : nullptr;
    const QString name = entry != nullptr ? current->data(nameRole).toString() : tr("Custom look");
    const auto exported = entry != nullptr
                              ? entry->preset
                              : presets::presetOf(name.toStdString(), m_document.scene().look,
                                                  m_document.scene().shading,
                                                  m_document.fieldWindow(), *m_document.volume());
    const QString path =
        askForSavePath(this, tr("Export preset"), name + ".json", tr("Preset (*.json)"));
    if (path.isEmpty())
        return;
    attempt([&] {
        m_document.requireOther({path.toStdString()});
        presets::writePreset(path.toStdString(), exported);
    });
}

void PresetsPanel::showMenu(const QPoint &at) {
    const QListWidgetItem *item = m_gallery->itemAt(at);
    // The gallery may be rebuilt while the menu is open.
    const QString name = item != nullptr ? item->data(nameRole).toString() : QString();
    const auto *entry = m_library.find(name.toStdString());
    if (entry == nullptr)
        return;
    auto *menu = new QMenu(this);
    menu->setObjectName("presetMenu");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    QAction *removal = menu->addAction(tr("Delete..."), this, [this, name] { askToRemove(name); });
    removal->setObjectName("removePresetAction");
    removal->setEnabled(!entry->isBuiltIn());
    if (entry->isBuiltIn())
        removal->setText(tr("Delete (built-in presets cannot be deleted)"));
    menu->popup(m_gallery->mapToGlobal(at));
}

} // namespace pellucid::ui
