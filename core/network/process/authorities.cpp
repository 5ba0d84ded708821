// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/authorities.h"

#include <fstream>

namespace pellucid::network::process {

std::string systemAuthoritiesFile() {
    for (const char *const path :
         {"/etc/ssl/certs/ca-certificates.crt", "/etc/pki/tls/certs/ca-bundle.crt",
          "/etc/pki/ca-trust/extracted/pem/tls-ca-bundle.pem", "/etc/ssl/ca-bundle.pem",
          "/etc/ssl/cert.pem"})
        if (std::ifstream(path).is_open())
            return path;
    return {};
}

} // namespace pellucid::network::process
