// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/authorities.h"

#include "core/platform/windows/error.h"
// After windows.h.
#include <wincrypt.h>

namespace pellucid::platform {

std::string systemAuthorities() {
    std::string all;
    const HCERTSTORE store = ::CertOpenSystemStoreW(0, L"ROOT");
    if (store == nullptr)
        return all;
    for (const CERT_CONTEXT *each = nullptr;
         (each = ::CertEnumCertificatesInStore(store, each)) != nullptr;) {
        DWORD size = 0;
        std::string text;
        const auto write = [&](char *to) {
            return ::CryptBinaryToStringA(each->pbCertEncoded, each->cbCertEncoded,
                                          CRYPT_STRING_BASE64HEADER | CRYPT_STRING_NOCR, to,
                                          &size) != FALSE;
        };
        if (!write(nullptr))
            continue;
        text.resize(size);
        if (write(text.data()))
            all += text.c_str();
    }
    ::CertCloseStore(store, 0);
    return all;
}

} // namespace pellucid::platform
