// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/remote_study.h"

#include <QRegularExpression>

namespace pellucid::ui {

RemoteStudy remoteStudy(const archive::FoundEntry &entry) {
    namespace tag = network::tag;
    const auto text = [&](std::uint32_t tag) { return QString::fromStdString(entry.text(tag)); };
    RemoteStudy remote;
    StudyFacts &study = remote.study;
    study.uid = text(tag::studyUid);
    study.patientId = text(tag::patientId);
    study.patientName = text(tag::patientName);
    study.birthDate = text(tag::birthDate);
    study.sex = text(tag::sex);
    study.date = text(tag::studyDate);
    study.description = text(tag::studyDescription);
    study.modalities = text(tag::modalitiesInStudy).replace('\\', ' ');
    remote.instances = text(tag::instancesInStudy).toInt();
    for (const std::string &server : entry.servers)
        remote.servers << QString::fromStdString(server);
    return remote;
}

archive::Patient patientOf(const StudyFacts &study) {
    return {study.patientName.toStdString(), study.patientId.toStdString(),
            study.birthDate.toStdString()};
}

archive::SearchTerms searchTermsOf(const QString &words) {
    static const QRegularExpression range("^\\d{8}-(\\d{8})?$|^-\\d{8}$"),
        isoDate("^(\\d{4})-(\\d{2})-(\\d{2})$"), hasDigit("\\d");
    static const QStringList modalities{"CT", "MR", "PT", "CR", "DX", "XA",
                                        "NM", "US", "MG", "RF", "SC", "OT"};
    archive::SearchTerms terms;
    QStringList name;
    for (const QString &word : words.split(QRegularExpression("[\\s^]+"), Qt::SkipEmptyParts)) {
        if (archive::isDay(word.toStdString()) || range.match(word).hasMatch())
            terms.date = word.toStdString();
        else if (const auto iso = isoDate.match(word); iso.hasMatch())
            terms.date = (iso.captured(1) + iso.captured(2) + iso.captured(3)).toStdString();
        else if (modalities.contains(word)) // in capitals: a name may have two letters
            terms.modality = word.toStdString();
        else if (hasDigit.match(word).hasMatch())
            terms.patientId = ("*" + word + "*").toStdString();
        else
            name << word;
    }
    if (!name.isEmpty())
        terms.patientName = ("*" + name.join('*') + "*").toStdString();
    return terms;
}

} // namespace pellucid::ui
