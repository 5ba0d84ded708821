// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

struct ssl_ctx_st; // OpenSSL's SSL_CTX

namespace pellucid::network::process {

/// Makes TLS connections follow BCP 195 (RFC 8996 and 9325), as PS3.15, B.12 demands: TLS 1.2 and
/// 1.3; keys that are exchanged by elliptic curves, so that a stolen key opens no recorded
/// connection; authenticated encryption; neither renegotiation nor compression.
void applyTlsProfile(ssl_ctx_st *context);

} // namespace pellucid::network::process
