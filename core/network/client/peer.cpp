// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/client/peer.h"

#include "core/network/client/reasons.h"
#include "core/platform/socket.h"
#include "core/task/error.h"

namespace pellucid::network {

bool isPrivate(const Peer &peer) {
    return peer.usesTls || peer.host == "localhost" || platform::isLoopback(peer.host);
}

bool hasInsecureLogin(const Peer &peer) {
    return peer.authentication != Authentication::none && !peer.allowsInsecureLogin &&
           !isPrivate(peer);
}

void requireSecureLogin(const Peer &peer) {
    if (hasInsecureLogin(peer))
        throw task::Error(task::ErrorCode::usage, task::because::loginCanBeRead);
}

const std::vector<std::string> &transferSyntaxes() {
    static const std::vector<std::string> syntaxes{
        "1.2.840.10008.1.2.1",    // explicit VR little endian
        "1.2.840.10008.1.2",      // implicit VR little endian
        "1.2.840.10008.1.2.4.80", // JPEG-LS, lossless
        "1.2.840.10008.1.2.4.90", // JPEG 2000, lossless
        "1.2.840.10008.1.2.4.70", // JPEG, lossless, selection value 1
        "1.2.840.10008.1.2.5",    // run lengths
        "1.2.840.10008.1.2.4.91", // JPEG 2000
        "1.2.840.10008.1.2.4.81", // JPEG-LS, near-lossless
        "1.2.840.10008.1.2.4.57", // JPEG, lossless
        "1.2.840.10008.1.2.4.51", // JPEG, extended
        "1.2.840.10008.1.2.4.50", // JPEG, baseline
        "1.2.840.10008.1.2.1.99", // deflated
        "1.2.840.10008.1.2.2",    // explicit VR big endian
    };
    return syntaxes;
}

std::string hostPart(const std::string &host) {
    return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

const std::vector<std::string> &commonClasses() {
    static const std::vector<std::string> classes{
        "1.2.840.10008.5.1.4.1.1.2",     // CT
        "1.2.840.10008.5.1.4.1.1.4",     // MR
        "1.2.840.10008.5.1.4.1.1.128",   // PET
        "1.2.840.10008.5.1.4.1.1.7",     // Secondary Capture
        "1.2.840.10008.5.1.4.1.1.7.2",   // Multi-frame Secondary Capture, grey
        "1.2.840.10008.5.1.4.1.1.7.4",   // Multi-frame Secondary Capture, colored
        "1.2.840.10008.5.1.4.1.1.2.1",   // Enhanced CT
        "1.2.840.10008.5.1.4.1.1.4.1",   // Enhanced MR
        "1.2.840.10008.5.1.4.1.1.66.4",  // Segmentation
        "1.2.840.10008.5.1.4.1.1.481.3", // RT Structure Set
    };
    return classes;
}

} // namespace pellucid::network
