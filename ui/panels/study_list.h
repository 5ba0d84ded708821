// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include <QAbstractItemModel>
#include <QHash>

#include "ui/library/study_library.h"
#include "ui/library/thumbnail_maker.h"
#include "ui/studies/study_facts.h"

namespace pellucid::ui {

class Document;

/// The model of the list of studies: matching open studies that are not in the library, then
/// matching studies of the library, a page at a time. Each has its volumes as children, read on
/// demand.
class StudyList : public QAbstractItemModel {
    Q_OBJECT
public:
    StudyList(Document &document, StudyLibrary &library, QObject *parent = nullptr);

    void setSearch(const QString &search);
    void setOrder(StudyOrder order);
    const QString &search() const { return m_search; }
    StudyOrder order() const { return m_order; }
    /// The number of matching studies, fetched or not.
    int studyCount() const { return m_openCount + m_libraryCount; }
    /// The same without an open study that is listed although it does not match.
    int matchCount() const { return studyCount() - (m_hasOther ? 1 : 0); }

    /// The study of a row; for a volume, its parent.
    const StudyFacts &study(const QModelIndex &index) const;
    /// Null for the row of a study.
    const VolumeFacts *volume(const QModelIndex &index) const;
    QImage thumbnail(const QModelIndex &index) const;
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

private:
    struct Entry {
        StudyFacts study;
        std::vector<VolumeFacts> volumes; ///< one per row; phases share a row
        std::vector<QStringList> keys;    ///< of all volumes of each row
        bool isRead = false;
        int row = 0;
    };
    void rebuild();
    void append(StudyFacts study, bool isRead);
    static void addVolumes(Entry &entry, const std::vector<VolumeFacts> &volumes);
    bool matches(const StudyFacts &study, const std::vector<VolumeFacts> &volumes) const;

    Document &m_document;
    StudyLibrary &m_library;
    QString m_search;
    StudyOrder m_order = StudyOrder::newestFirst;
    std::vector<std::unique_ptr<Entry>> m_entries;
    int m_openCount = 0, m_libraryCount = 0;
    bool m_hasOther = false; ///< the open study does not match the search
    /// Thumbnails of open volumes that are not in the library, by key; made on demand.
    mutable QHash<QString, QImage> m_thumbnails;
    mutable ThumbnailMaker m_maker;
};

} // namespace pellucid::ui
