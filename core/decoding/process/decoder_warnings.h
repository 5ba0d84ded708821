// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::decoding::process {

/// While it exists, captures the warnings that DCMTK's pixel decoders only log before they continue
/// with damaged data. One at a time.
class DecoderWarnings {
public:
    DecoderWarnings();
    ~DecoderWarnings();
    DecoderWarnings(const DecoderWarnings &) = delete;
    DecoderWarnings &operator=(const DecoderWarnings &) = delete;

    /// Whether a decoder found its data damaged or truncated.
    bool foundDamage() const;
};

} // namespace pellucid::decoding::process
