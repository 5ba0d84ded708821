// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <QObject>

#include "core/dicom/reasons.h"
#include "core/dicom/write_series.h"
#include "core/files/reasons.h"
#include "core/phantom/phantom.h"
#include "tests/support/temporary_folder.h"
#include "ui/library/library.h"

namespace pellucid::test {

inline ui::LibrarySeries librarySeries(int number, const QString &name, const QString &description,
                                       int files) {
    ui::LibrarySeries s;
    s.study.patientId = QString("ID%1").arg(number);
    s.study.patientName = name;
    s.study.uid = QString("1.2.%1").arg(number);
    s.study.date = QString("20%1%2%3")
                       .arg(number % 24, 2, 10, QChar('0'))
                       .arg(1 + number % 12, 2, 10, QChar('0'))
                       .arg(1 + number % 28, 2, 10, QChar('0'));
    s.study.description = description;
    ui::VolumeFacts v;
    v.seriesUid = s.study.uid + ".1";
    v.modality = "CT";
    v.description = "Soft kernel";
    v.bodyPart = "CHEST";
    v.seriesNumber = 3;
    v.size = {512, 512, files};
    v.spacingMm = {0.5, 0.5, 1.0};
    v.warnings = {task::because::without("IM 4\n.dcm", task::because::isTruncated)};
    s.volumes = {v};
    for (int n = 0; n < files; ++n)
        s.files.push_back({"/archive/" + std::to_string(number) + "/" + std::to_string(n) + ".dcm",
                           (v.seriesUid + "." + QString::number(n)).toStdString()});
    return s;
}

inline std::vector<ui::LibrarySeries> many(int studies, int files) {
    std::vector<ui::LibrarySeries> all;
    for (int n = 0; n < studies; ++n)
        all.push_back(librarySeries(n, QString("Doe%1^Jane").arg(n), "Thorax", files));
    return all;
}

inline int filesBelow(const std::filesystem::path &folder) {
    int count = 0;
    std::error_code none;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder, none))
        count += entry.is_regular_file() ? 1 : 0;
    return count;
}

inline int count(const ui::Library &library, const QString &search = {}) {
    return library.find(search, ui::StudyOrder::byName, 0, 1).count;
}

/// A series of 20 slices below a folder that goes with the test, and libraries beside it.
class LibraryFolder : public QObject {
protected:
    void writeHead() const {
        qputenv("XDG_CACHE_HOME", QByteArray::fromStdString((m_folder / "cache").string()));
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{32, 32, 20}});
        dicom::writeCtSeries(m_folder / "head", phantom::makePhantom(phantom::Kind::head, lattice),
                             {.patientName = "Head^Test"}, dicom::TransferSyntax::explicitLittle);
    }
    ui::LibraryPlace place(const std::string &name) const {
        std::filesystem::create_directories(m_folder / name);
        return {m_folder / name};
    }

    TemporaryFolder m_folder;
};

} // namespace pellucid::test
