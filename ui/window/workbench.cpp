// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/workbench.h"

namespace pellucid::ui {

Workbench::Workbench(std::optional<EngineChoice> engine)
    : card(engine), study(card), notices(study.document), library(unlistedFiles()),
      serverSearch(servers), receiver(servers), transfers(servers, library, receiver),
      earlier(library, servers), measurements(study.document) {
    study.document.addProblems(library.notices());
    if (const auto fault = session.fault())
        study.document.addProblems({{fault->path(), fault->reason()}});
    const auto report = [this](auto &from, auto failed) {
        QObject::connect(&from, failed, &notices, &Notices::report);
    };
    report(study.regions.jobs(), &JobRunner::failed);
    report(library, &StudyLibrary::failed);
    report(measurements, &MeasurementStore::failed);
    report(servers, &ServerBook::failed);
    report(transfers, &TransferQueue::failed);
    report(receiver, &StudyReceiver::failed);
}

Workbench::~Workbench() {
    // Their work refers to the other members. That of `study` refers to itself alone.
    exports.join();
    library.jobs().join();
}

} // namespace pellucid::ui
