// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/open_request.h"

#include <QUrl>
#include <QUrlQuery>

#include "core/network/client/query.h"
#include "core/task/error.h"
#include "ui/servers/reasons.h"

namespace pellucid::ui {

namespace {

constexpr int longestLink = 1024;
constexpr auto scheme = "pellucid";

} // namespace

bool isLink(const QString &text) {
    return text.startsWith(QString(scheme) + "://", Qt::CaseInsensitive);
}

OpenRequest openRequestOf(const QString &link) {
    const QUrl url(link.left(longestLink), QUrl::StrictMode);
    const QUrlQuery query(url);
    OpenRequest request;
    bool isUnderstood = link.size() <= longestLink && url.isValid() && url.scheme() == scheme &&
                        url.host() == "open" && (url.path().isEmpty() || url.path() == "/");
    for (const auto &[key, value] : query.queryItems(QUrl::FullyDecoded)) {
        if (key == "server" && request.server.isEmpty())
            request.server = value;
        else if (key == "studyUID" && request.studyUid.isEmpty())
            request.studyUid = value;
        else // what is not understood is not ignored
            isUnderstood = false;
    }
    if (!isUnderstood || request.server.isEmpty() ||
        !network::isUid(request.studyUid.toStdString()))
        throw task::Error(task::ErrorCode::usage, task::because::isNoLink,
                          link.left(80).toStdString());
    return request;
}

} // namespace pellucid::ui
