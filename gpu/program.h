// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gpu/handle.h"

namespace pellucid::gpu {

/// What a shader's source is specialised by: macros and their values.
using Defines = std::vector<std::pair<std::string, int>>;

/// A linked program from files below shaders/. `#include "..."` lines are replaced by the named
/// file. Belongs to the context that is current when it is made; move-only.
class Program {
public:
    /// *Throws* Error{internal} with the compiler's words, which name file and line.
    Program(const std::string &vertexFile, const std::string &fragmentFile);
    /// A compute program.
    explicit Program(const std::string &computeFile, const Defines &defines = {});

    unsigned id() const { return m_program.name(); }
    int uniform(const char *name) const;

private:
    ProgramName m_program;
};

/// The text of a shader with its includes in place and #line directives before each part; the part
/// numbers index `files`.
struct ShaderText {
    std::string text;
    std::vector<std::string> files;
};
/// Defines come after the line with the version.
ShaderText assembledShader(const std::string &file, const Defines &defines = {});

} // namespace pellucid::gpu
