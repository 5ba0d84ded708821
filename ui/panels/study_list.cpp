// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/study_list.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <QMimeData>
#include <QUrl>

#include "core/archive/run_transfer.h"
#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/language/shown_text.h"
#include "ui/studies/search_words.h"

namespace pellucid::ui {

namespace {

constexpr int pageSize = 200;

// The objects of a study that servers have sent.
int receivedObjects(const QString &studyUid) {
    std::error_code none;
    std::filesystem::path folder;
    try {
        folder = archive::libraryObjectFolder() / studyUid.toStdString();
    } catch (const task::Error &) { // no folder for the user's data
        return 0;
    }
    int count = 0;
    for (std::filesystem::recursive_directory_iterator it(folder, none), end; !none && it != end;
         it.increment(none))
        count += it->path().extension() == ".dcm" ? 1 : 0;
    return count;
}

} // namespace

StudyList::StudyList(Document &document, StudyLibrary &library, QObject *parent)
    : QAbstractItemModel(parent), m_document(document), m_library(library) {
    document.whenever(Change::sources, this, &StudyList::rebuild);
    connect(&library, &StudyLibrary::changed, this, &StudyList::rebuild);
    connect(&m_maker, &ThumbnailMaker::made, this, [this](const QString &key, const QImage &image) {
        m_thumbnails[key] = image;
        for (int row = 0; row < m_openCount; ++row)
            if (const int count = int(m_entries[std::size_t(row)]->volumes.size()); count > 0)
                emit dataChanged(index(0, 0, index(row, 0)), index(count - 1, 0, index(row, 0)),
                                 {Qt::DecorationRole});
    });
    rebuild();
}

void StudyList::setSearch(const QString &search) {
    if (search == m_search)
        return;
    m_search = search;
    rebuild();
}

void StudyList::setOrder(StudyOrder order) {
    m_order = order;
    rebuild();
}

bool StudyList::matches(const StudyFacts &study, const std::vector<VolumeFacts> &volumes) const {
    QStringList texts{study.patientId, patientText(study), study.date, studyText(study)};
    for (const VolumeFacts &v : volumes)
        texts << seriesText(v) << v.modality << v.bodyPart;
    return containsWords(texts.join('\n'), m_search);
}

void StudyList::append(StudyFacts study, bool isRead) {
    auto entry = std::make_unique<Entry>();
    entry->study = std::move(study);
    entry->isRead = isRead;
    entry->row = int(m_entries.size());
    m_entries.push_back(std::move(entry));
}

// The phases of a series share one row; the phase bar selects among them.
void StudyList::addVolumes(Entry &entry, const std::vector<VolumeFacts> &volumes) {
    for (const VolumeFacts &volume : volumes) {
        const auto row = std::find_if(entry.volumes.begin(), entry.volumes.end(),
                                      [&](const VolumeFacts &v) { return arePhases(v, volume); });
        if (row == entry.volumes.end()) {
            entry.volumes.push_back(volume);
            entry.keys.push_back({volume.key()});
        } else {
            ++row->phases;
            entry.keys[std::size_t(row - entry.volumes.begin())] << volume.key();
        }
    }
}

void StudyList::rebuild() {
    m_objectsHere.clear();
    beginResetModel();
    m_entries.clear();
    QHash<QString, std::size_t> rows; // by study
    for (const StudySource &source : m_document.sources()) {
        if (source.isClosed || m_library.contains(source.study, source.volume))
            continue;
        const QString key = source.study.key();
        if (!rows.contains(key)) {
            rows.insert(key, m_entries.size());
            append(source.study, true);
        }
        addVolumes(*m_entries[rows.value(key)], {source.volume});
    }
    // A search never hides what is open.
    const int open = m_document.currentSource();
    const QString shown =
        open < 0 ? QString() : m_document.sources()[std::size_t(open)].study.key();
    m_hasOther = false;
    std::erase_if(m_entries, [&](const auto &entry) {
        const bool isFound = matches(entry->study, entry->volumes);
        const bool isOpen = entry->study.key() == shown;
        m_hasOther = m_hasOther || (isOpen && !isFound);
        return !isFound && !isOpen;
    });
    m_openCount = int(m_entries.size());
    for (int row = 0; row < m_openCount; ++row)
        m_entries[std::size_t(row)]->row = row;
    StudyPage page = m_library.find(m_search, m_order, 0, pageSize);
    m_libraryCount = page.count;
    for (StudyFacts &study : page.studies)
        append(std::move(study), false);
    placeRemote();
    endResetModel();
}

StudyList::Entry &StudyList::entryAt(int row) const {
    const auto at = std::size_t(row);
    return at < m_entries.size() ? *m_entries[at] : *m_onlyRemote.at(at - m_entries.size());
}

int StudyList::objectsHere(const QString &studyUid) {
    auto count = m_objectsHere.find(studyUid);
    if (count == m_objectsHere.end())
        count = m_objectsHere.insert(studyUid, receivedObjects(studyUid));
    return *count;
}

void StudyList::setRemote(const std::vector<RemoteStudy> &remote) {
    beginResetModel();
    m_remote = remote;
    placeRemote();
    endResetModel();
}

// A study is the same wherever it is: its UID tells.
void StudyList::placeRemote() {
    m_onlyRemote.clear();
    QHash<QString, Entry *> here;
    for (const auto &entry : m_entries) {
        entry->remote.reset();
        here.insert(entry->study.uid, entry.get());
    }
    for (const RemoteStudy &remote : m_remote) {
        if (Entry *const entry = here.value(remote.study.uid)) {
            entry->remote = remote;
            entry->instancesHere = 0;
            QStringList counted; // phases of a series share its files
            const auto &volumes =
                entry->study.libraryId != 0 ? m_library.volumes(entry->study) : entry->volumes;
            for (const VolumeFacts &volume : volumes)
                if (!counted.contains(volume.seriesUid)) {
                    counted << volume.seriesUid;
                    entry->instancesHere += volume.files;
                }
            // Objects that are no images are in no volume.
            entry->instancesHere = std::max(entry->instancesHere, objectsHere(remote.study.uid));
            continue;
        }
        auto entry = std::make_unique<Entry>();
        entry->study = remote.study;
        entry->isRead = true;
        entry->row = int(m_entries.size() + m_onlyRemote.size());
        entry->remote = remote;
        m_onlyRemote.push_back(std::move(entry));
    }
}

const RemoteStudy *StudyList::remote(const QModelIndex &at) const {
    if (!at.isValid() || at.parent().isValid())
        return nullptr;
    const auto &remote = entryAt(at.row()).remote;
    return remote ? &*remote : nullptr;
}

bool StudyList::isOnlyRemote(const QModelIndex &at) const {
    return at.isValid() && !at.parent().isValid() && at.row() >= int(m_entries.size());
}

QString StudyList::whereText(const QModelIndex &at) const {
    const RemoteStudy *const remote = this->remote(at);
    if (remote == nullptr)
        return {};
    const QString servers = shownText(remote->servers.join(", "));
    const int here = isOnlyRemote(at) ? 0 : entryAt(at.row()).instancesHere;
    if (remote->instances == 0)
        return servers;
    return here == 0 ? tr("%1: %n images", "", remote->instances).arg(servers)
                     : tr("%1: %2 of %3 here")
                           .arg(servers, QString::number(here), QString::number(remote->instances));
}

const StudyFacts &StudyList::study(const QModelIndex &at) const {
    const QModelIndex study = at.parent().isValid() ? at.parent() : at;
    return entryAt(study.row()).study;
}

const VolumeFacts *StudyList::volume(const QModelIndex &at) const {
    if (!at.isValid() || !at.parent().isValid())
        return nullptr;
    return &m_entries.at(std::size_t(at.parent().row()))->volumes.at(std::size_t(at.row()));
}

int StudyList::source(const QModelIndex &at) const {
    if (volume(at) == nullptr)
        return -1;
    // Prefer the source that is shown in the panes.
    int found = -1;
    const QString study = this->study(at).key();
    for (const QString &key :
         m_entries.at(std::size_t(at.parent().row()))->keys.at(std::size_t(at.row())))
        if (const int source = m_document.sourceWith(study + "\n" + key);
            source >= 0 && (found < 0 || source == m_document.currentSource()))
            found = source;
    return found;
}

QStringList StudyList::files(const QModelIndex &at) const {
    if (!at.isValid())
        return {};
    if (const VolumeFacts *const one = volume(at)) {
        if (const int open = source(at); open >= 0)
            return m_document.sources()[std::size_t(open)].files;
        QStringList files;
        for (const dicom::InstanceFile &file : m_library.files(study(at), *one))
            files << QString::fromStdString(file.path.string());
        return files;
    }
    QStringList files;
    const StudyFacts &whole = study(at);
    if (whole.libraryId != 0)
        for (const VolumeFacts &one : m_library.volumes(whole))
            for (const dicom::InstanceFile &file : m_library.files(whole, one))
                files << QString::fromStdString(file.path.string());
    else
        for (const StudySource &open : m_document.sources())
            if (open.study.key() == whole.key())
                files << open.files;
    files.removeDuplicates();
    return files;
}

Qt::ItemFlags StudyList::flags(const QModelIndex &at) const {
    const Qt::ItemFlags usual = QAbstractItemModel::flags(at);
    const bool isHere = at.isValid() && !isOnlyRemote(at) && study(at).origin != Origin::phantom;
    return isHere ? usual | Qt::ItemIsDragEnabled : usual;
}

QMimeData *StudyList::mimeData(const QModelIndexList &indexes) const {
    QList<QUrl> urls;
    for (const QModelIndex &at : indexes)
        for (const QString &file : files(at))
            urls << QUrl::fromLocalFile(file);
    auto *const data = new QMimeData;
    data->setUrls(urls);
    return data;
}

bool StudyList::isOpen(const QModelIndex &at) const {
    const int open = m_document.currentSource();
    return open >= 0 && source(at) == open;
}

QModelIndex StudyList::find(int source) {
    if (source < 0)
        return {};
    const StudySource &wanted = m_document.sources().at(std::size_t(source));
    for (int row = 0; row < int(m_entries.size()); ++row) {
        Entry &entry = *m_entries[std::size_t(row)];
        if (entry.study.key() != wanted.study.key())
            continue;
        const QModelIndex parent = index(row, 0);
        fetchMore(parent);
        for (int n = 0; n < int(entry.volumes.size()); ++n)
            if (entry.keys[std::size_t(n)].contains(wanted.volume.key()))
                return index(n, 0, parent);
    }
    return {};
}

QImage StudyList::thumbnail(const QModelIndex &at) const {
    const VolumeFacts *const facts = volume(at);
    if (facts == nullptr)
        return {};
    if (!facts->thumbnail.isNull())
        return facts->thumbnail;
    const QString key = study(at).key() + "\n" + facts->key();
    if (const auto it = m_thumbnails.constFind(key); it != m_thumbnails.constEnd())
        return *it;
    m_thumbnails.insert(key, {}); // request it only once
    if (const int open = source(at); open >= 0)
        if (const auto &make = m_document.sources()[std::size_t(open)].makeThumbnail)
            m_maker.ask(key, make);
    return {};
}

// A volume's index points to its study's entry; a study's index has no pointer.
QModelIndex StudyList::index(int row, int column, const QModelIndex &parent) const {
    if (row < 0 || row >= rowCount(parent) || column != 0)
        return {};
    return createIndex(row, column, parent.isValid() ? &entryAt(parent.row()) : nullptr);
}

QModelIndex StudyList::parent(const QModelIndex &at) const {
    const auto *const entry =
        at.isValid() ? static_cast<const Entry *>(at.internalPointer()) : nullptr;
    return entry == nullptr ? QModelIndex() : createIndex(entry->row, 0, nullptr);
}

int StudyList::rowCount(const QModelIndex &parent) const {
    if (!parent.isValid())
        return int(m_entries.size() + m_onlyRemote.size());
    return parent.parent().isValid() ? 0 : int(entryAt(parent.row()).volumes.size());
}

bool StudyList::hasChildren(const QModelIndex &parent) const {
    return !parent.isValid() || (!parent.parent().isValid() && !isOnlyRemote(parent));
}

bool StudyList::canFetchMore(const QModelIndex &parent) const {
    if (!parent.isValid())
        return int(m_entries.size()) - m_openCount < m_libraryCount;
    return !parent.parent().isValid() && !entryAt(parent.row()).isRead;
}

void StudyList::fetchMore(const QModelIndex &parent) {
    if (!canFetchMore(parent))
        return;
    if (!parent.isValid()) {
        const auto offset = int(m_entries.size()) - m_openCount;
        auto page = m_library.find(m_search, m_order, offset, pageSize).studies;
        if (page.empty()) { // fewer than counted: another process has removed some
            m_libraryCount = offset;
            return;
        }
        const int first = int(m_entries.size());
        beginInsertRows({}, first, first + int(page.size()) - 1);
        for (StudyFacts &study : page)
            append(std::move(study), false);
        endInsertRows();
        // Some of them may have been listed as remote.
        if (!m_remote.empty())
            setRemote(std::vector(m_remote));
        return;
    }
    Entry &entry = *m_entries[std::size_t(parent.row())];
    std::vector<VolumeFacts> volumes = m_library.volumes(entry.study);
    entry.isRead = true;
    if (volumes.empty())
        return;
    Entry added;
    addVolumes(added, volumes);
    beginInsertRows(parent, 0, int(added.volumes.size()) - 1);
    entry.volumes = std::move(added.volumes);
    entry.keys = std::move(added.keys);
    endInsertRows();
}

QVariant StudyList::data(const QModelIndex &at, int role) const {
    if (!at.isValid())
        return {};
    const StudyFacts &s = study(at);
    const VolumeFacts *const v = volume(at);
    switch (role) {
    case Qt::DisplayRole:
        return v != nullptr ? seriesText(*v) : patientText(s);
    case Qt::AccessibleTextRole:
        return v != nullptr
                   ? (QStringList{seriesText(*v), sizeText(*v)} + warningTexts(*v)).join(", ")
                   : (QStringList{patientText(s), studyText(s)} +
                      (whereText(at).isEmpty() ? QStringList() : QStringList{whereText(at)}))
                         .join(", ");
    case Qt::ToolTipRole:
        return plainToolTip(
            v != nullptr ? (QStringList{seriesText(*v), sizeText(*v)} + warningTexts(*v)).join("\n")
                         : (QStringList{patientText(s), s.patientId, studyText(s), whereText(at)})
                               .join("\n")
                               .trimmed());
    case Qt::DecorationRole:
        return v != nullptr ? QVariant(thumbnail(at)) : QVariant();
    default:
        return {};
    }
}

} // namespace pellucid::ui
