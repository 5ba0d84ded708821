// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/transport.h"

#include <algorithm>
#include <array>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>
#include <openssl/x509v3.h>
#include <string_view>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dcmtrans.h>
#include <dcmtk/dcmtls/tlslayer.h>
#include <dcmtk/dcmtls/tlstrans.h>

#include "core/network/client/reasons.h"
#include "core/network/process/authorities.h"
#include "core/network/process/control.h"
#include "core/network/process/reasons.h"
#include "core/network/process/tls_profile.h"
#include "core/network/process/tls_reasons.h"
#include "core/platform/socket.h"
#include "core/task/error.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;

using platform::HandleView, platform::Opened;

class PlainConnection : public DcmTCPConnection {
public:
    explicit PlainConnection(DcmNativeSocketType socket) : DcmTCPConnection(socket) {}
    ssize_t read(void *to, size_t bytes) override {
        const ssize_t got = DcmTCPConnection::read(to, bytes);
        platform::acknowledgeAtOnce(HandleView(platform::Native(getSocket()), Opened::socket));
        return got;
    }
};

class PlainLayer : public DcmTransportLayer {
public:
    explicit PlainLayer(std::shared_ptr<Transport::State> state) : m_state(std::move(state)) {}
    DcmTransportConnection *createConnection(DcmNativeSocketType socket, OFBool) override {
        return new PlainConnection(DcmNativeSocketType(m_state->connected(socket)));
    }

private:
    std::shared_ptr<Transport::State> m_state;
};

std::string textOfLastError() {
    std::string text(256, '\0');
    const unsigned long code = ::ERR_peek_last_error();
    if (code == 0)
        return {};
    if (const char *const reason = ::ERR_reason_error_string(code))
        return reason;
    ::ERR_error_string_n(code, text.data(), text.size());
    return text.c_str();
}

// Whether a certificate has a host's name or address. Its common name counts only if it has no
// other names (RFC 6125, 6.4.4).
bool isCertificateOf(X509 *certificate, const std::string &host) {
    const bool hasNames = ::X509_get_ext_by_NID(certificate, NID_subject_alt_name, -1) >= 0;
    if (platform::addressKind(host) && hasNames)
        return ::X509_check_ip_asc(certificate, host.c_str(), 0) == 1;
    return ::X509_check_host(certificate, host.c_str(), host.size(),
                             hasNames ? X509_CHECK_FLAG_NEVER_CHECK_SUBJECT : 0, nullptr) == 1;
}

// The names and addresses of a certificate, for the user.
std::string namesIn(X509 *certificate) {
    constexpr std::size_t longest = 200;
    std::string names;
    const auto add = [&](const std::string &name) { names += (names.empty() ? "" : ", ") + name; };
    auto *const all = static_cast<GENERAL_NAMES *>(
        ::X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr));
    for (int n = 0; n < sk_GENERAL_NAME_num(all); ++n) {
        const GENERAL_NAME *const one = sk_GENERAL_NAME_value(all, n);
        if (one->type == GEN_DNS)
            add({reinterpret_cast<const char *>(::ASN1_STRING_get0_data(one->d.dNSName)),
                 std::size_t(::ASN1_STRING_length(one->d.dNSName))});
        else if (one->type == GEN_IPADD)
            add(platform::addressText({::ASN1_STRING_get0_data(one->d.iPAddress),
                                       std::size_t(::ASN1_STRING_length(one->d.iPAddress))}));
    }
    ::GENERAL_NAMES_free(all);
    std::array<char, longest> common{};
    if (names.empty() &&
        ::X509_NAME_get_text_by_NID(::X509_get_subject_name(certificate), NID_commonName,
                                    common.data(), int(common.size())) > 0)
        add(common.data());
    return shortened(names, longest);
}

class SecureConnection : public DcmTLSConnection {
public:
    SecureConnection(DcmNativeSocketType socket, SSL *ssl, std::shared_ptr<Transport::State> state,
                     const std::vector<std::string> &clientHosts)
        : DcmTLSConnection(socket, ssl), m_ssl(ssl), m_state(std::move(state)),
          m_clientHosts(clientHosts) {}

    OFCondition clientSideHandshake() override {
        return judged(DcmTLSConnection::clientSideHandshake());
    }
    OFCondition serverSideHandshake() override {
        return judged(DcmTLSConnection::serverSideHandshake());
    }
    ssize_t read(void *to, size_t bytes) override {
        ::ERR_clear_error();
        const ssize_t got = DcmTLSConnection::read(to, bytes);
        if (got < 0)
            takeAlert();
        platform::acknowledgeAtOnce(HandleView(platform::Native(getSocket()), Opened::socket));
        return got;
    }
    ssize_t write(void *from, size_t bytes) override {
        ::ERR_clear_error();
        const ssize_t sent = DcmTLSConnection::write(from, bytes);
        if (char next = 0;
            sent < 0 && platform::otherEndHasHungUp()) { // it may have said why before
            ::SSL_peek(m_ssl, &next, 1);
            takeAlert();
        }
        return sent;
    }

private:
    // TLS 1.3 reports a refused certificate of this program only after the handshake.
    void takeAlert() {
        const std::string text = textOfLastError();
        if (text.empty() || m_state->refusal)
            return;
        const task::Reason reason = tlsReason(text);
        m_state->refusal = // it has spoken TLS before
            reason.is(because::tlsIsNotAnswered) ? task::Reason(because::serverHungUp) : reason;
    }
    // Of a client: not a byte that it sends is read if its certificate is another's.
    bool isExpected() const {
        if (m_clientHosts.empty())
            return true;
        X509 *const certificate = ::SSL_get0_peer_certificate(m_ssl);
        if (certificate != nullptr &&
            std::any_of(m_clientHosts.begin(), m_clientHosts.end(), [&](const std::string &host) {
                return isCertificateOf(certificate, host);
            }))
            return true;
        m_state->refusal = because::certificateNamesAnother(
            certificate != nullptr ? namesIn(certificate) : std::string(), m_clientHosts.back());
        return false;
    }
    OFCondition judged(const OFCondition &shaken) {
        if (shaken.good()) {
            if (!isExpected())
                return EC_IllegalCall;
            m_state->events.secured(std::string(::SSL_get_version(m_ssl)) + ", " +
                                    ::SSL_get_cipher_name(m_ssl));
            return shaken;
        }
        const long verified = ::SSL_get_verify_result(m_ssl);
        if (verified != X509_V_OK) {
            const std::string text = ::X509_verify_cert_error_string(verified);
            m_state->refusal = ::SSL_is_server(m_ssl) == 1
                                   ? task::Reason(because::certificateIsRefused(text))
                                   : certificateReason(text);
        } else {
            // DCMTK has taken the error out of OpenSSL's queue, and repeats its text.
            std::string text = textOfLastError();
            if (text.empty())
                text = shaken.text();
            if (constexpr std::string_view prefix = "TLS error: "; text.starts_with(prefix))
                text.erase(0, prefix.size());
            m_state->refusal = tlsReason(text);
        }
        return shaken;
    }

    SSL *m_ssl; // the connection owns it
    std::shared_ptr<Transport::State> m_state;
    std::vector<std::string> m_clientHosts;
};

class SecureLayer : public DcmTLSTransportLayer {
public:
    SecureLayer(std::shared_ptr<Transport::State> state, const Certificates &certificates)
        : DcmTLSTransportLayer(certificates.host.empty() ? NET_ACCEPTOR : NET_REQUESTOR, nullptr,
                               OFTrue),
          m_state(std::move(state)), m_host(certificates.host),
          m_clientHosts(certificates.clientHosts) {
        const auto require = [](const OFCondition &condition, const std::string &path) {
            if (condition.bad())
                throw task::Error(task::ErrorCode::usage,
                                  because::isNoPemFile(std::string(condition.text())), path);
        };
        // Anybody gets a certificate from an authority of the system.
        if (certificates.authorities.empty() && m_host.empty())
            throw task::Error(task::ErrorCode::usage, because::receiverNeedsAuthorities);
        if (!trust(getNativeHandle(), authorityCertificates(certificates.authorities)))
            throw certificates.authorities.empty()
                ? task::Error(task::ErrorCode::usage, because::systemTrustsNobody)
                : task::Error(task::ErrorCode::usage,
                              because::isNoPemFile(std::string("no certificate")),
                              certificates.authorities);
        if (!certificates.certificate.empty()) {
            setPrivateKeyPasswd(certificates.keyPassword.c_str());
            require(setPrivateKeyFile(certificates.key.c_str(), DCF_Filetype_PEM),
                    certificates.key);
            require(setCertificateFile(certificates.certificate.c_str(), DCF_Filetype_PEM),
                    certificates.certificate);
            if (!checkPrivateKeyMatchesCertificate())
                throw task::Error(task::ErrorCode::usage, because::keyIsNotOfTheCertificate,
                                  certificates.key);
        }
        applyTlsProfile(getNativeHandle());
        setCertificateVerification(DCV_requireCertificate);
        if (!m_host.empty()) {
            X509_VERIFY_PARAM *const verified = ::SSL_CTX_get0_param(getNativeHandle());
            if (platform::addressKind(m_host))
                ::X509_VERIFY_PARAM_set1_ip_asc(verified, m_host.c_str());
            else
                ::X509_VERIFY_PARAM_set1_host(verified, m_host.c_str(), m_host.size());
        }
    }

    DcmTransportConnection *createConnection(DcmNativeSocketType made, OFBool) override {
        SSL *const ssl = ::SSL_new(getNativeHandle());
        if (ssl == nullptr)
            return nullptr;
        if (!m_host.empty() && !platform::addressKind(m_host))
            ::SSL_set_tlsext_host_name(ssl, m_host.c_str()); // names only (RFC 6066, 3)
        const auto socket = DcmNativeSocketType(m_state->connected(made));
        ::SSL_set_fd(ssl, int(socket));
        return new SecureConnection(socket, ssl, m_state, m_clientHosts);
    }

private:
    std::shared_ptr<Transport::State> m_state;
    std::string m_host;
    std::vector<std::string> m_clientHosts;
};

} // namespace

Transport::Transport(ConnectionEvents events)
    : m_state(std::make_shared<State>(State{std::move(events), {}, {}, {}, {}})),
      m_layer(std::make_unique<PlainLayer>(m_state)) {}

Transport::Transport(ConnectionEvents events, const Certificates &certificates)
    : m_state(std::make_shared<State>(State{std::move(events), {}, {}, {}, {}})), m_isSecure(true),
      m_layer(std::make_unique<SecureLayer>(m_state, certificates)) {}

Transport::~Transport() = default;

platform::Native Transport::State::connected(platform::Native made) {
    if (connection) {
        replaced = platform::Handle(made, Opened::socket);
        made = connection.release();
    }
    socket = HandleView(made, Opened::socket);
    platform::makeWaiting(socket);
    platform::sendAtOnce(socket);
    platform::acknowledgeAtOnce(socket);
    events.connected();
    return made;
}

} // namespace pellucid::network::process
