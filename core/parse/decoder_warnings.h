// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::parse {

/// Listens, as long as it lives, to what DCMTK's decoders of pixels say on their log alone: they go
/// on with damaged data. One at a time.
class DecoderWarnings {
public:
    DecoderWarnings();
    ~DecoderWarnings();
    DecoderWarnings(const DecoderWarnings &) = delete;
    DecoderWarnings &operator=(const DecoderWarnings &) = delete;

    /// Whether one of them found its data damaged or too short.
    bool sayDamaged() const;
};

} // namespace pellucid::parse
