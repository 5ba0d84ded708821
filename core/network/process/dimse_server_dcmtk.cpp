// SPDX-License-Identifier: GPL-3.0-or-later
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/dimse.h>

#include "core/network/process/dimse.h"
#include "core/network/process/dimse_dcmtk.h"
#include "core/network/process/reasons.h"

namespace pellucid::network::process {

namespace {

// Ends the association in order if the client asks for that. *Throws* Lost for any other end.
bool isReleased(Association &association, const OFCondition &condition) {
    if (condition != DUL_PEERREQUESTEDRELEASE)
        return false;
    ASC_acknowledgeRelease(association.get());
    return true;
}

} // namespace

void provide(Association &association, Control &control) {
    for (;;) {
        if (association.wait(control) == Association::Event::cancel)
            throw CancelledByProgram();
        T_DIMSE_Message message{};
        T_ASC_PresentationContextID context = 0;
        DcmDataset *detail = nullptr;
        const OFCondition received =
            DIMSE_receiveCommand(association.get(), DIMSE_NONBLOCKING, patienceOf(association),
                                 &context, &message, &detail);
        delete detail;
        if (isReleased(association, received))
            return;
        if (received.bad())
            association.fail(received.text());
        if (message.CommandField == DIMSE_C_STORE_RQ) {
            receiveObject(association, context, message.msg.CStoreRQ, control);
        } else if (message.CommandField == DIMSE_C_ECHO_RQ) {
            const OFCondition sent = DIMSE_sendEchoResponse(
                association.get(), context, &message.msg.CEchoRQ, STATUS_Success, nullptr);
            if (sent.bad())
                association.fail(sent.text());
            control.step(Step::service, {}); // progress
        } else {
            association.abort();
            throw Lost{task::because::clientSendsTheUnexpected};
        }
    }
}

} // namespace pellucid::network::process
