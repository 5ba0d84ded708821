// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/authorities.h"

#include <fstream>
#include <iterator>

namespace pellucid::platform {

// Where distributions keep them. Not at OpenSSL's own path, which is that of the machine it was
// built on.
std::string systemAuthorities() {
    for (const char *const path :
         {"/etc/ssl/certs/ca-certificates.crt", "/etc/pki/tls/certs/ca-bundle.crt",
          "/etc/pki/ca-trust/extracted/pem/tls-ca-bundle.pem", "/etc/ssl/ca-bundle.pem",
          "/etc/ssl/cert.pem"})
        if (std::ifstream in(path, std::ios::binary); in)
            return {std::istreambuf_iterator<char>(in), {}};
    return {};
}

} // namespace pellucid::platform
