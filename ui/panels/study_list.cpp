// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/study_list.h"

#include <algorithm>

#include "ui/document/document.h"
#include "ui/studies/search_words.h"

namespace pellucid::ui {

namespace {

constexpr int pageSize = 200;

} // namespace

StudyList::StudyList(Document &document, StudyLibrary &library, QObject *parent)
    : QAbstractItemModel(parent), m_document(document), m_library(library) {
    connect(&document, &Document::sourcesChanged, this, &StudyList::rebuild);
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
    m_entries.push_back(
        std::make_unique<Entry>(Entry{std::move(study), {}, {}, isRead, int(m_entries.size())}));
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
    endResetModel();
}

const StudyFacts &StudyList::study(const QModelIndex &at) const {
    const QModelIndex study = at.parent().isValid() ? at.parent() : at;
    return m_entries.at(std::size_t(study.row()))->study;
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
    return createIndex(row, column,
                       parent.isValid() ? m_entries[std::size_t(parent.row())].get() : nullptr);
}

QModelIndex StudyList::parent(const QModelIndex &at) const {
    const auto *const entry =
        at.isValid() ? static_cast<const Entry *>(at.internalPointer()) : nullptr;
    return entry == nullptr ? QModelIndex() : createIndex(entry->row, 0, nullptr);
}

int StudyList::rowCount(const QModelIndex &parent) const {
    if (!parent.isValid())
        return int(m_entries.size());
    return parent.parent().isValid() ? 0
                                     : int(m_entries[std::size_t(parent.row())]->volumes.size());
}

bool StudyList::hasChildren(const QModelIndex &parent) const {
    return !parent.isValid() || !parent.parent().isValid();
}

bool StudyList::canFetchMore(const QModelIndex &parent) const {
    if (!parent.isValid())
        return int(m_entries.size()) - m_openCount < m_libraryCount;
    return !parent.parent().isValid() && !m_entries[std::size_t(parent.row())]->isRead;
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
                   : patientText(s) + ", " + studyText(s);
    case Qt::ToolTipRole:
        return v != nullptr
                   ? (QStringList{seriesText(*v), sizeText(*v)} + warningTexts(*v)).join("\n")
                   : (QStringList{patientText(s), s.patientId, studyText(s)}).join("\n");
    case Qt::DecorationRole:
        return v != nullptr ? QVariant(thumbnail(at)) : QVariant();
    default:
        return {};
    }
}

} // namespace pellucid::ui
