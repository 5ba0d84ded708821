// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gpu/handle.h"

namespace pellucid::gpu {

/// Macros that specialise a shader's source, and their values.
using Defines = std::vector<std::pair<std::string, int>>;

/// A linked program from files below shaders/. `#include "..."` lines are replaced by the named
/// file. Belongs to the context that is current when it is created; move-only.
class Program {
public:
    /// *Throws* Error{internal} with the compiler's message, which names file and line.
    Program(const std::string &vertexFile, const std::string &fragmentFile);
    /// A compute program.
    explicit Program(const std::string &computeFile, const Defines &defines = {});

    unsigned id() const { return m_program.name(); }
    int uniform(const char *name) const;

private:
    ProgramName m_program;
};

/// A shader's source with its includes expanded. #line directives precede each part; their source
/// numbers index `files`.
struct ShaderText {
    std::string text;
    std::vector<std::string> files;
};
/// Puts `defines` after the #version line.
ShaderText assembledShader(const std::string &file, const Defines &defines = {});

} // namespace pellucid::gpu
