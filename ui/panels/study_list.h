// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <QAbstractItemModel>
#include <QHash>

#include "ui/library/study_library.h"
#include "ui/library/thumbnail_maker.h"
#include "ui/servers/remote_study.h"
#include "ui/studies/study_facts.h"

namespace pellucid::ui {

class Document;

/// The model of the list of studies: matching open studies that are not in the library, then
/// matching studies of the library, a page at a time, then those that only servers have. Each of
/// the former has its volumes as children, read on demand.
class StudyList : public QAbstractItemModel {
    Q_OBJECT
public:
    StudyList(Document &document, StudyLibrary &library, QObject *parent = nullptr);

    void setSearch(const QString &search);
    void setOrder(StudyOrder order);
    const QString &search() const { return m_search; }
    StudyOrder order() const { return m_order; }
    /// The number of matching studies, fetched or not.
    int studyCount() const { return m_openCount + m_libraryCount + int(m_onlyRemote.size()); }
    /// The same without an open study that is listed although it does not match.
    int matchCount() const { return studyCount() - (m_hasOther ? 1 : 0); }

    /// What servers have, folded with what is here.
    void setRemote(const std::vector<RemoteStudy> &remote);
    /// Set for the row of a study that only servers have, or have more of.
    const RemoteStudy *remote(const QModelIndex &index) const;
    /// Whether no file of it is here.
    bool isOnlyRemote(const QModelIndex &index) const;
    /// Where else a study is, and how much of it is here; empty if nothing is known.
    QString whereText(const QModelIndex &index) const;

    /// The study of a row; for a volume, its parent.
    const StudyFacts &study(const QModelIndex &index) const;
    /// Null for the row of a study.
    const VolumeFacts *volume(const QModelIndex &index) const;
    QImage thumbnail(const QModelIndex &index) const;
    /// The files of a volume's series, or of all series of a study.
    QStringList files(const QModelIndex &index) const;
    /// The row of a source of the document; invalid if it has not been fetched.
    QModelIndex find(int source);
    /// The source of the document for an open volume; -1 if it is not open.
    int source(const QModelIndex &index) const;
    /// Whether the volume is shown in the panes.
    bool isOpen(const QModelIndex &index) const;

    QModelIndex index(int row, int column, const QModelIndex &parent = {}) const override;
    QModelIndex parent(const QModelIndex &index) const override;
    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex & = {}) const override { return 1; }
    bool hasChildren(const QModelIndex &parent = {}) const override;
    bool canFetchMore(const QModelIndex &parent) const override;
    void fetchMore(const QModelIndex &parent) override;
    QVariant data(const QModelIndex &index, int role) const override;
    /// Studies can be dragged, as their files.
    Qt::ItemFlags flags(const QModelIndex &index) const override;
    QStringList mimeTypes() const override { return {"text/uri-list"}; }
    QMimeData *mimeData(const QModelIndexList &indexes) const override;

private:
    struct Entry {
        StudyFacts study;
        std::vector<VolumeFacts> volumes; ///< one per row; phases share a row
        std::vector<QStringList> keys;    ///< of all volumes of each row
        bool isRead = false;
        int row = 0;
        std::optional<RemoteStudy> remote;
        int instancesHere = 0; ///< set with `remote`
    };
    Entry &entryAt(int row) const;
    void placeRemote();
    int objectsHere(const QString &studyUid);
    void rebuild();
    void append(StudyFacts study, bool isRead);
    static void addVolumes(Entry &entry, const std::vector<VolumeFacts> &volumes);
    bool matches(const StudyFacts &study, const std::vector<VolumeFacts> &volumes) const;

    Document &m_document;
    StudyLibrary &m_library;
    QString m_search;
    StudyOrder m_order = StudyOrder::newestFirst;
    std::vector<std::unique_ptr<Entry>> m_entries;
    QHash<QString, int> m_objectsHere; ///< from servers, by study
    std::vector<RemoteStudy> m_remote;
    std::vector<std::unique_ptr<Entry>> m_onlyRemote; ///< after `m_entries`
    int m_openCount = 0, m_libraryCount = 0;
    bool m_hasOther = false; ///< the open study does not match the search
    /// Thumbnails of open volumes that are not in the library, by key; made on demand.
    mutable QHash<QString, QImage> m_thumbnails;
    mutable ThumbnailMaker m_maker;
};

} // namespace pellucid::ui
