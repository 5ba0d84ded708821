// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

struct ssl_ctx_st; // OpenSSL's SSL_CTX

namespace pellucid::network::process {

/// Makes TLS connections follow BCP 195 (RFC 8996 and 9325), as PS3.15, B.12 demands: TLS 1.2 and
/// 1.3; keys that are exchanged by elliptic curves, so that a stolen key opens no recorded
/// connection; authenticated encryption; neither renegotiation nor compression.
void applyTlsProfile(ssl_ctx_st *context);

/// Trusts the CA certificates of a text in PEM format. False if it has none, or one cannot be read.
bool trust(ssl_ctx_st *context, const std::string &certificates);

} // namespace pellucid::network::process
