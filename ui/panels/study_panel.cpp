// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/study_panel.h"

#include <set>

#include <QActionGroup>
#include <QApplication>
#include <QDragEnterEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QShortcut>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>

#include "ui/dialogs/header_dialog.h"
#include "ui/dialogs/study_details.h"
#include "ui/document/document.h"
#include "ui/jobs/job_strip.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/panels/problem_list.h"
#include "ui/panels/study_row_painter.h"
#include "ui/servers/server_search.h"
#include "ui/settings/file_dialogs.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"
#include "ui/widgets/question.h"

namespace pellucid::ui {

namespace {

// Up to this many studies are expanded.
constexpr int maxExpandedStudies = 20;
// A search starts when typing pauses.
constexpr int typingMs = 120;
// Servers are asked after a longer pause.
constexpr int restingMs = 900, fewestLetters = 3;

} // namespace

StudyPanel::StudyPanel(Document &document, StudyLibrary &library, ServerSearch &servers,
                       QWidget *parent)
    : QWidget(parent), m_document(document), m_library(library), m_list(document, library),
      m_search(new QLineEdit), m_tree(new QTreeView), m_corner(new QPushButton(tr("Import"))),
      m_empty(new PlainLabel), m_servers(servers), m_serverStates(new PlainLabel),
      m_logins(new QWidget) {
    setPanelBackground(*this, "studyPanel");
    setAcceptDrops(true);
    m_search->setObjectName("studySearch");
    m_search->setPlaceholderText(tr("Search studies"));
    m_search->setToolTip(tr(
        "Words that a study must contain: name, identifier, date, modality, description (Ctrl+F)"));
    m_search->setAccessibleName(tr("Search studies"));
    m_search->setClearButtonEnabled(true);
    auto *order = new QToolButton;
    order->setObjectName("studyOrderButton");
    order->setText(tr("Sort"));
    order->setProperty("role", "heading");
    order->setToolTip(tr("Sort order of the studies"));
    order->setPopupMode(QToolButton::InstantPopup);
    order->setMenu(orderMenu());
    m_corner->setObjectName("importButton");
    m_corner->setProperty("role", "link");
    m_corner->setToolTip(tr("Add studies to the library (Ctrl+I)"));
    m_empty->setObjectName("studiesEmpty");
    m_empty->setProperty("role", "muted");
    m_empty->setWordWrap(true);
    m_serverStates->setObjectName("serverStates");
    m_serverStates->setProperty("role", "muted");
    m_serverStates->setWordWrap(true);
    m_serverStates->hide();
    (new QVBoxLayout(m_logins))->setContentsMargins({});
    m_logins->hide();
    m_tree->setObjectName("seriesTree");
    m_tree->setAccessibleName(tr("Studies"));
    m_tree->setHeaderHidden(true);
    m_tree->setIndentation(0);
    m_tree->setRootIsDecorated(false);
    m_tree->setMouseTracking(true);
    m_tree->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_tree->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_tree->setContextMenuPolicy(Qt::CustomContextMenu);
    m_tree->setDragEnabled(true);
    m_tree->setDragDropMode(QAbstractItemView::DragOnly);
    m_tree->setModel(&m_list);
    m_tree->setItemDelegate(new StudyRowPainter(m_list, this));
    m_tree->header()->setSectionResizeMode(QHeaderView::Stretch);
    auto *top = new QHBoxLayout;
    top->addWidget(m_search, 1);
    top->addWidget(order);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(14, 4, 10, 12);
    layout->setSpacing(6);
    layout->addLayout(top);
    layout->addWidget(m_serverStates);
    layout->addWidget(m_logins);
    layout->addWidget(m_empty, 0, Qt::AlignTop);
    layout->addWidget(m_tree, 1);
    layout->addWidget(new JobStrip(library.jobs(), "import"));
    layout->addWidget(new ProblemList(document));
    connectControls();
    expandFew();
    showEmpty();
}

void StudyPanel::connectControls() {
    m_typing.setSingleShot(true);
    m_typing.setInterval(typingMs);
    connect(m_search, &QLineEdit::textChanged, &m_typing, qOverload<>(&QTimer::start));
    connect(&m_typing, &QTimer::timeout, this, [this] { m_list.setSearch(m_search->text()); });
    m_resting.setSingleShot(true);
    m_resting.setInterval(restingMs);
    connect(m_search, &QLineEdit::textChanged, this, [this](const QString &text) {
        // A server is not asked for every letter, nor for the names that begin with one.
        if (text.trimmed().size() >= fewestLetters)
            m_resting.start();
        else
            m_resting.stop();
        if (text.isEmpty())
            m_servers.clear();
    });
    connect(&m_resting, &QTimer::timeout, this, [this] { searchServers(nullptr); });
    connect(m_search, &QLineEdit::returnPressed, this, [this] {
        m_list.setSearch(m_search->text());
        searchServers(window());
        m_tree->setFocus();
    });
    connect(&m_servers, &ServerSearch::changed, this, &StudyPanel::showServers);
    connect(new QShortcut(Qt::Key_Escape, m_search, nullptr, nullptr, Qt::WidgetShortcut),
            &QShortcut::activated, this, [this] {
                m_search->clear();
                m_tree->setFocus();
            });
    connect(m_corner, &QPushButton::clicked, this, [this] { emit importRequested({}); });
    connect(&m_list, &QAbstractItemModel::modelReset, this, [this] {
        expandFew();
        showCurrent();
        showEmpty();
    });
    m_document.whenever(Change::currentSource, this, &StudyPanel::showCurrent);
    m_tree->setExpandsOnDoubleClick(false);
    connect(m_tree, &QTreeView::clicked, this, &StudyPanel::activate);
    connect(m_tree, &QTreeView::activated, this, &StudyPanel::activate);
    const auto retrieve = [this](const QModelIndex &index) {
        if (const RemoteStudy *const remote = m_list.remote(index);
            remote != nullptr && m_list.isOnlyRemote(index))
            emit retrieveRequested(*remote);
    };
    connect(m_tree, &QTreeView::activated, this, retrieve);
    connect(m_tree, &QWidget::customContextMenuRequested, this, &StudyPanel::showMenu);
}

QMenu *StudyPanel::orderMenu() {
    auto *menu = new QMenu(this);
    auto *group = new QActionGroup(menu);
    const struct {
        QString text;
        const char *name;
        StudyOrder order;
    } orders[] = {{tr("Newest first"), "newestFirstAction", StudyOrder::newestFirst},
                  {tr("By name"), "byNameAction", StudyOrder::byName},
                  {tr("Last added first"), "lastAddedFirstAction", StudyOrder::lastAddedFirst}};
    for (const auto &o : orders) {
        QAction *action = menu->addAction(o.text);
        action->setObjectName(o.name);
        action->setCheckable(true);
        action->setChecked(o.order == m_list.order());
        group->addAction(action);
        connect(action, &QAction::triggered, this,
                [this, order = o.order] { m_list.setOrder(order); });
    }
    return menu;
}

QWidget *StudyPanel::corner() {
    return m_corner;
}

// Only Enter asks for passwords: `asking` is null while the user types.
void StudyPanel::searchServers(QWidget *asking) {
    m_resting.stop();
    m_servers.search(m_search->text().trimmed(), asking);
}

void StudyPanel::showServers() {
    m_list.setRemote(m_servers.found());
    QStringList texts, tips;
    QStringList locked;
    for (const auto &[name, state] : m_servers.states()) {
        switch (state.kind) {
        case ServerState::Kind::searching:
            texts << tr("%1: searching").arg(name);
            break;
        case ServerState::Kind::answered:
            texts << (state.hasMore ? tr("%1: more results than shown").arg(name) : name);
            break;
        case ServerState::Kind::failed:
            texts << QString::fromUtf8("\u26A0 ") + name;
            tips << name + ": " + translated(*state.reason);
            break;
        case ServerState::Kind::locked:
            locked << name;
            break;
        }
    }
    m_serverStates->setText(texts.join(QString::fromUtf8(" \u00B7 ")));
    m_serverStates->setToolTip(plainToolTip(tips.join("\n")));
    m_serverStates->setVisible(!texts.isEmpty());
    showLogins(locked);
    showEmpty();
}

// The rows of servers that await a login. Those that stay keep the keyboard.
void StudyPanel::showLogins(const QStringList &locked) {
    for (auto it = m_loginButtons.begin(); it != m_loginButtons.end();) {
        if (locked.contains(it.key())) {
            ++it;
            continue;
        }
        it.value()->hide();
        it.value()->deleteLater(); // it may have been clicked
        it = m_loginButtons.erase(it);
    }
    for (const QString &name : locked)
        if (!m_loginButtons.contains(name))
            addLogin(name);
    m_logins->setVisible(!locked.isEmpty());
}

void StudyPanel::addLogin(const QString &server) {
    auto *button = new QPushButton(tr("Log in to %1").arg(menuText(server)));
    button->setObjectName("loginButton");
    button->setFlat(true);
    m_logins->layout()->addWidget(button);
    m_loginButtons[server] = button;
    connect(button, &QPushButton::clicked, this,
            [this, server] { m_servers.unlock(server, window()); });
}

void StudyPanel::focusSearch() {
    m_search->setFocus();
    m_search->selectAll();
}

void StudyPanel::showEmpty() {
    const bool isSearching = !m_list.search().trimmed().isEmpty();
    const int matching = m_list.matchCount();
    m_empty->setVisible(matching == 0);
    // The open study stays in the list, whatever is searched for.
    if (isSearching)
        m_empty->setText(m_list.rowCount() > 0 ? tr("No other study found") : tr("Nothing found"));
    else
        m_empty->setText(tr("No studies yet. Open one, or import studies into the library; files "
                            "may also be dropped here."));
}

void StudyPanel::expandFew() {
    if (m_list.studyCount() > maxExpandedStudies)
        return;
    for (int row = 0; row < m_list.rowCount(); ++row)
        m_tree->expand(m_list.index(row, 0));
}

void StudyPanel::showCurrent() {
    const QModelIndex current = m_list.find(m_document.currentSource());
    if (current.isValid()) {
        m_tree->expand(current.parent());
        m_tree->scrollTo(current);
    }
    m_tree->setCurrentIndex(current);
}

void StudyPanel::activate(const QModelIndex &index) {
    if (m_list.isOnlyRemote(index)) // a double-click or Enter retrieves it
        return;
    const VolumeFacts *const volume = m_list.volume(index);
    if (volume == nullptr) {
        // A click may also arrive as an activation, and a double-click as three events.
        if (!m_sinceToggle.isValid() ||
            m_sinceToggle.elapsed() > QApplication::doubleClickInterval())
            m_tree->setExpanded(index, !m_tree->isExpanded(index));
        m_sinceToggle.restart();
        return;
    }
    if (const int source = m_list.source(index); source >= 0)
        emit sourceActivated(source);
    else
        emit libraryVolumeActivated(m_list.study(index), *volume);
}

void StudyPanel::showMenu(const QPoint &at) {
    const QModelIndex index = m_tree->indexAt(at);
    if (!index.isValid())
        return;
    const StudyFacts study = m_list.study(index);
    const VolumeFacts *const volume = m_list.volume(index);
    auto *menu = new QMenu(this);
    menu->setObjectName("studyMenu");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const QPersistentModelIndex row(index);
    const auto add = [&](const QString &text, const char *name, auto run) {
        QAction *action = menu->addAction(text);
        action->setObjectName(name);
        connect(action, &QAction::triggered, this, run);
    };
    if (volume != nullptr) {
        add(tr("Open"), "openVolumeAction", [this, row] { activate(row); });
        if (m_document.volume())
            add(tr("Open side by side"), "openBesideAction", [this, row] { openBeside(row); });
        add(tr("Details..."), "volumeDetailsAction", [this, row] { showDetails(row); });
        if (volume->file.isEmpty() && !m_list.files(index).isEmpty())
            add(tr("DICOM header..."), "volumeHeaderAction", [this, row] {
                if (const QStringList files = m_list.files(row); !files.isEmpty())
                    (new HeaderDialog(files, 0, window()))->show();
            });
        menu->addSeparator();
    }
    if (const RemoteStudy *const remote = m_list.remote(index))
        add(tr("Retrieve from %1").arg(menuText(remote->servers.value(0))), "retrieveStudyAction",
            [this, remote = *remote] { emit retrieveRequested(remote); });
    addServersTo(*menu, index);
    if (m_list.isOnlyRemote(index)) {
        menu->popup(m_tree->viewport()->mapToGlobal(at));
        return;
    }
    if (study.libraryId != 0)
        add(tr("Remove from the library..."), "removeStudyAction",
            [this, study] { remove(study); });
    else if (study.origin != Origin::phantom)
        add(tr("Add to the library..."), "addStudyAction", [this, study] { importOpen(study); });
    if (!sourcesOf(study).empty())
        add(tr("Close"), "closeStudyAction", [this, study] { close(study); });
    menu->popup(m_tree->viewport()->mapToGlobal(at));
}

// The servers that the study, or the series of a volume, can be sent to.
void StudyPanel::addServersTo(QMenu &menu, const QModelIndex &index) {
    const QStringList servers = m_servers.serverNames();
    if (servers.isEmpty() || m_list.isOnlyRemote(index) ||
        m_list.study(index).origin == Origin::phantom)
        return;
    QMenu *const send = menu.addMenu(tr("Send to"));
    send->setObjectName("sendMenu");
    const QPersistentModelIndex row(index);
    for (const QString &server : servers)
        connect(send->addAction(menuText(server)), &QAction::triggered, this,
                [this, row, server] { emit sendRequested(m_list.files(row), server); });
}

void StudyPanel::openBeside(const QModelIndex &index) {
    const VolumeFacts *const volume = m_list.volume(index);
    if (volume == nullptr)
        return;
    const int source = m_list.source(index);
    emit besideRequested(source >= 0
                             ? m_document.sources()[std::size_t(source)]
                             : librarySource(m_list.study(index), *volume,
                                             m_library.files(m_list.study(index), *volume)));
}

void StudyPanel::showDetails(const QModelIndex &index) {
    if (const VolumeFacts *const volume = m_list.volume(index))
        showStudyDetails(m_list.study(index), *volume, m_list.files(index), m_list.thumbnail(index),
                         window());
}

void StudyPanel::importOpen(const StudyFacts &study) {
    QStringList paths;
    for (const StudySource &source : m_document.sources())
        if (source.study.key() == study.key())
            paths << source.files;
    paths.removeDuplicates();
    emit importRequested(paths);
}

void StudyPanel::remove(const StudyFacts &study) {
    int copied = 0, referred = 0;
    std::set<QString> series;
    for (const VolumeFacts &volume : m_library.volumes(study))
        if (series.insert(volume.seriesUid + volume.file).second)
            (volume.isCopied ? copied : referred) += volume.files;
    QString what =
        tr("Remove the study %1 of %2 from the library?").arg(studyText(study), patientText(study));
    if (copied > 0)
        what += "\n\n" + tr("%n files that were copied into the library are deleted.", "", copied);
    if (referred > 0)
        what += "\n\n" + tr("%n files elsewhere stay where they are.", "", referred);
    ask(window(), {"removeStudyQuestion", tr("Remove from the library"), what, tr("Remove")},
        [this, study] {
            close(study);
            m_library.remove(study);
        });
}

std::vector<int> StudyPanel::sourcesOf(const StudyFacts &study) const {
    std::vector<int> open;
    for (std::size_t n = 0; n < m_document.sources().size(); ++n)
        if (const StudySource &source = m_document.sources()[n];
            !source.isClosed && source.study.key() == study.key())
            open.push_back(int(n));
    return open;
}

void StudyPanel::close(const StudyFacts &study) {
    for (const int source : sourcesOf(study))
        emit closeRequested(source);
}

void StudyPanel::dragEnterEvent(QDragEnterEvent *event) {
    // A study of this list is dragged to a server.
    if (event->source() != m_tree && !localPaths(*event->mimeData()).isEmpty())
        event->acceptProposedAction();
}

void StudyPanel::dropEvent(QDropEvent *event) {
    event->acceptProposedAction();
    emit importRequested(localPaths(*event->mimeData()));
}

} // namespace pellucid::ui
