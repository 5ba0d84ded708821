// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/authorities.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/platform/windows/error.h"
// After windows.h.
#include <wincrypt.h>

namespace pellucid::platform {

namespace {

// Some certificates are trusted for code or mail alone.
bool isForServers(const CERT_CONTEXT *certificate) {
    DWORD size = 0;
    constexpr DWORD set = CERT_FIND_PROP_ONLY_ENHKEY_USAGE_FLAG; // by Windows, not by its issuer
    if (::CertGetEnhancedKeyUsage(certificate, set, nullptr, &size) == FALSE)
        return ::GetLastError() == DWORD(CRYPT_E_NOT_FOUND); // for everything
    std::vector<std::byte> bytes(size);
    auto *const usage = reinterpret_cast<CERT_ENHKEY_USAGE *>(bytes.data());
    if (::CertGetEnhancedKeyUsage(certificate, set, usage, &size) == FALSE)
        return false;
    const std::span names(usage->rgpszUsageIdentifier, usage->cUsageIdentifier);
    return std::any_of(names.begin(), names.end(), [](const char *name) {
        return std::string_view(name) == szOID_PKIX_KP_SERVER_AUTH;
    });
}

} // namespace

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
        if (!isForServers(each) || !write(nullptr))
            continue;
        text.resize(size);
        if (write(text.data()))
            all += text.c_str();
    }
    ::CertCloseStore(store, 0);
    return all;
}

} // namespace pellucid::platform
