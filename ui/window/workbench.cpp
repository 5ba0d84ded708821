// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/workbench.h"

namespace pellucid::ui {

Workbench::Workbench(std::optional<EngineChoice> engine)
    : preparer(document, jobs), card(engine), copier(document, jobs, card),
      opener(document, jobs, preparer), phases(document, opener, jobs), measurements(document) {
    QObject::connect(&preparer, &LookPreparer::engineReady, &copier, &CardCopier::show);
    document.addProblems(library.notices());
    if (const auto fault = session.fault())
        document.addProblems({{fault->path(), fault->reason()}});
}

Workbench::~Workbench() {
    // Work that still runs looks at the members.
    jobs.join();
    exports.join();
    library.jobs().join();
}

} // namespace pellucid::ui
