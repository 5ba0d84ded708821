// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "app/cli/card_choice.h"
#include "app/cli/commands.h"
#include "core/batch/done_record.h"
#include "core/batch/memory_shares.h"
#include "core/batch/recipe.h"
#include "core/dicom/catalogue.h"

namespace pellucid::cli {

/// A study of a batch.
struct StudyToRender {
    const dicom::Catalogue &catalogue;
    const dicom::Patient &patient;
    const dicom::Study &study;
    std::string inputs; ///< the digest of its files
};

/// Loads the series of a study that a recipe asks for, and writes all outputs into a folder.
/// Outputs that differ in their views only share one preparation. What is made does not depend on
/// the memory: if the share of this job is too small, the study waits until it has all of it.
/// *Throws* as loading and rendering; Error{output}.
batch::DoneRecord renderStudy(const batch::Recipe &recipe, const StudyToRender &study,
                              const std::filesystem::path &folder, batch::MemoryShares &memory,
                              const CardChoice &card, const Context &context);

} // namespace pellucid::cli
