// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/tls_profile.h"

#include <openssl/err.h>
#include <openssl/pem.h>
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

bool trust(ssl_ctx_st *context, const std::string &certificates) {
    BIO *const text = ::BIO_new_mem_buf(certificates.data(), int(certificates.size()));
    bool hasAny = false;
    ::ERR_clear_error();
    while (text != nullptr) {
        X509 *const each = ::PEM_read_bio_X509(text, nullptr, nullptr, nullptr);
        if (each == nullptr)
            break;
        hasAny = ::X509_STORE_add_cert(::SSL_CTX_get_cert_store(context), each) == 1 || hasAny;
        ::X509_free(each);
    }
    const bool isAtEnd = ERR_GET_REASON(::ERR_peek_last_error()) == PEM_R_NO_START_LINE;
    ::BIO_free(text);
    ::ERR_clear_error();
    return hasAny && isAtEnd;
}

} // namespace pellucid::network::process
