// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/tls_profile.h"

#include <openssl/ssl.h>

namespace pellucid::network::process {

void applyTlsProfile(ssl_ctx_st *context) {
    ::SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
    ::SSL_CTX_set_max_proto_version(context, 0); // the latest that OpenSSL has
    // RFC 9325, 4.2
    ::SSL_CTX_set_cipher_list(context,
                              "ECDHE-RSA-AES128-GCM-SHA256:ECDHE-RSA-AES256-GCM-SHA384:"
                              "ECDHE-ECDSA-AES128-GCM-SHA256:ECDHE-ECDSA-AES256-GCM-SHA384");
    // RFC 8446, 9.1
    ::SSL_CTX_set_ciphersuites(
        context, "TLS_AES_128_GCM_SHA256:TLS_AES_256_GCM_SHA384:TLS_CHACHA20_POLY1305_SHA256");
    // Keys and signatures of 112 bits, such as RSA with 2048 (RFC 9325, 4.5)
    ::SSL_CTX_set_security_level(context, 2);
    // RFC 9325, 3.3 and 3.5
    ::SSL_CTX_set_options(context, SSL_OP_NO_COMPRESSION | SSL_OP_NO_RENEGOTIATION |
                                       SSL_OP_CIPHER_SERVER_PREFERENCE);
    ::SSL_CTX_clear_options(context, SSL_OP_LEGACY_SERVER_CONNECT |
                                         SSL_OP_ALLOW_UNSAFE_LEGACY_RENEGOTIATION);
}

} // namespace pellucid::network::process
