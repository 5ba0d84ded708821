// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pellucid::network {

enum class Protocol { dicom, web };
/// `oauth`: a token that the program obtains by a login; a connection gets it as `bearer`.
enum class Authentication { none, basic, bearer, oauth };

/// What a connection to a server needs, secrets included. Paths name files in PEM format.
/// core/network/client/message.cpp lists the members for pellucid-net.
struct Peer {
    Protocol protocol = Protocol::dicom;
    std::string host;
    int port = 104;
    std::string calledAe = "ANY-SCP", callingAe = "PELLUCID";
    std::string path; ///< of a DICOMweb service, such as "/dicom-web"
    bool usesTls = false;
    std::string authorities; ///< certificates that are trusted; empty: those of the system
    std::string certificate, key, keyPassword; ///< of this program; empty: none
    Authentication authentication = Authentication::none;
    std::string user, secret; ///< the password or the token
    /// Whether others on the way may read the secret: the user has agreed to that.
    bool allowsInsecureLogin = false;
    std::string characterSet; ///< of answers that name none; a defined term such as ISO_IR 100
    double connectSeconds = 10.0, associationSeconds = 30.0, silenceSeconds = 60.0;

    bool operator==(const Peer &) const = default;
};

/// Whether no other computer can read what is sent to it: TLS, or it is this computer.
bool isPrivate(const Peer &peer);
/// Whether it would get a password or a token that others on the way can read, and the user has not
/// agreed to that.
bool hasInsecureLogin(const Peer &peer);
/// *Throws* Error{usage} in this case.
void requireSecureLogin(const Peer &peer);

/// A host as it stands in a URL before its port: an IPv6 address in brackets (RFC 3986, 3.2.2).
std::string hostPart(const std::string &host);

/// A kind of object, and one way to encode it (transfer syntax).
struct Encoding {
    std::string sopClassUid, transferSyntax;
    bool operator==(const Encoding &) const = default;
    auto operator<=>(const Encoding &) const = default;
};

/// The ways to encode objects that are asked for, as UIDs; the best first.
const std::vector<std::string> &transferSyntaxes();

/// The kinds of objects that are asked for if nobody knows what there is, as UIDs.
const std::vector<std::string> &commonClasses();

/// The purpose of a connection, for which a DICOM association is negotiated. `login`: to obtain
/// tokens from a login server.
enum class Purpose : std::int32_t { echo, find, get, move, store, login };

struct Connection {
    Peer peer;
    Purpose purpose = Purpose::echo;
    std::vector<std::string> sopClasses{}; ///< of `get`: what may arrive; empty: `commonClasses`
    /// Of `get`: the only encodings that are asked for; empty: all.
    std::vector<std::string> transferSyntaxes{};
    std::vector<Encoding> encodings{}; ///< of `store`: what is sent
};

} // namespace pellucid::network
