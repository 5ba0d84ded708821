// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace pellucid::ui {

/// What a link of another program asks for, such as a worklist:
/// pellucid://open?server=NAME&studyUID=UID.
struct OpenRequest {
    QString server, studyUid;
};

/// Whether an argument of the program is meant as a link.
bool isLink(const QString &text);

/// *Throws* Error{usage} if it is not such a link.
OpenRequest openRequestOf(const QString &link);

} // namespace pellucid::ui
