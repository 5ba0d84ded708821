// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(networkCannotBeSetUp, "the network cannot be set up")
PELLUCID_REASON(hostIsUnknown, "there is no host named '%1'; check the name, and the connection to the network")
PELLUCID_REASON(hostDoesNotAnswer, "the host does not answer; check address and port, and any firewall")
PELLUCID_REASON(connectionIsRefused, "the host refuses connections to this port; check the port, and that the server runs")
PELLUCID_REASON(isNoPemFile, "is not a usable file in PEM format: %1")
PELLUCID_REASON(systemTrustsNobody, "this system has no list of trusted CA certificates; name a file of CA certificates (on the command line: --authorities)")
PELLUCID_REASON(keyIsNotOfTheCertificate, "is not the private key of the certificate")
PELLUCID_REASON(certificateIsRefused, "the other side's certificate is not accepted: %1")
PELLUCID_REASON(tlsFails, "TLS fails: %1")
PELLUCID_REASON(certificateIsOfNoAuthority, "the other side's certificate is not accepted: %1; if you trust it, add its CA certificates (in the window: CA certificates; on the command line: server add with --authorities)")
PELLUCID_REASON(tlsIsNotAnswered, "the other side does not speak TLS on this port")
PELLUCID_REASON(tlsMayBeExpected, "the server ends the connection without accepting an association; perhaps it expects TLS")
PELLUCID_REASON(serverDoesNotAnswer, "the server accepts the connection, but does not answer")
PELLUCID_REASON(associationFails, "the server does not agree to a DICOM association: %1")
PELLUCID_REASON(serverDoesNotKnowUs, "the server does not know this program; register its AE title at the server")
PELLUCID_REASON(serverHasAnotherName, "the server does not accept this AE title as its own; check the AE title of the server")
PELLUCID_REASON(serverRejectsUs, "the server rejects the association")
PELLUCID_REASON(serverIsSilent, "the server has sent nothing for %1 s")
PELLUCID_REASON(connectionFails, "the connection fails: %1")
PELLUCID_REASON(serverSendsTheUnexpected, "unexpected response from the server")
PELLUCID_REASON(dataComeInAnotherContext, "the other side sent data in a different presentation context from its command")
PELLUCID_REASON(clientSendsTheUnexpected, "the sender asked for something other than storing")
PELLUCID_REASON(wrongCalledTitle, "the sender %1 called the AE title %2, which is not this program's")
PELLUCID_REASON(certificateNamesAnother, "the sender's certificate names %1, but the sender is %2")
PELLUCID_REASON(serverHadAFailure, "the server failed to process the request")
PELLUCID_REASON(serverSaysInvalidInstance, "the server does not accept the object")
PELLUCID_REASON(serverDoesNotKnowTheOperation, "the server does not know the operation")
PELLUCID_REASON(serverIsOutOfResources, "the server is out of resources")
PELLUCID_REASON(serverCannotCountMatches, "the server does not have enough resources to count the objects")
PELLUCID_REASON(serverCannotSendMore, "the server does not have enough resources to send the objects")
PELLUCID_REASON(serverDoesNotKnowTheDestination, "the server does not know where to send; register the AE title, address and port of this program at the server")
PELLUCID_REASON(serverCouldNotSendAll, "the server could not send all objects")
PELLUCID_REASON(serverTakesNoSuchSize, "the server does not accept objects of this size")
PELLUCID_REASON(serverSendsNoObject, "the server sends something other than DICOM objects")
PELLUCID_REASON(answerEndsTooEarly, "the server's answer is incomplete")
PELLUCID_REASON(redirectsTooOften, "the server redirects too often")
PELLUCID_REASON(serverSaysTheDataDoNotMatch, "the server reports that the data do not match the kind of object")
PELLUCID_REASON(serverCannotProcessIt, "the server cannot process the request")
PELLUCID_REASON(serverSendsNoDicomJson, "the server's answer is not DICOM JSON; check the path of the service")
PELLUCID_REASON(serverAnswerIsTooLong, "the server's answer is too long")
PELLUCID_REASON(serverWantsHttps, "the server wants https: change its address to %1")
PELLUCID_REASON(serverPointsElsewhere, "the server redirects to another server; redirects are not followed")
PELLUCID_REASON(serverDoesNotConfirm, "the server does not confirm that it stored the object")
PELLUCID_REASON(issuerHasNoDescription, "the login server does not publish its endpoints; enter the authorization URL and the token URL")
PELLUCID_REASON(loginTookTooLong, "nobody logged in within %1 s")
PELLUCID_REASON(loginIsDenied, "the login was denied")
PELLUCID_REASON(loginIsRefused, "the login server refuses the login: %1")
PELLUCID_REASON(loginAnswerHasNoToken, "the login server's answer has no usable token")
PELLUCID_REASON(storedWithChanges, "stored, but the server changed or left out attributes (%1)")
PELLUCID_REASON(proxyHasNoServer, "the server behind the proxy does not answer (HTTP status %1)")
PELLUCID_REASON(serverNeedsACertificate, "the server requires a client certificate")
// clang-format on

} // namespace pellucid::task::because
