// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/network/client/query.h"

namespace pellucid::network::process {

/// The data sets of an answer in DICOM JSON (PS3.18, annex F): the texts and numbers of their top
/// level, in UTF-8. *Throws* Error{unusable} if it is not such an answer.
std::vector<Attributes> readDicomJson(const std::string &text);

/// What a server reports about the objects it was sent (PS3.18, 10.5.3).
struct StoreAnswer {
    struct Item {
        std::string uid;
        int reason = 0; ///< of the failure or the warning, as a status of C-STORE; 0: none
    };
    std::vector<Item> stored, failed;
};
/// *Throws* as `readDicomJson`.
StoreAnswer readStoreAnswer(const std::string &text);

} // namespace pellucid::network::process
