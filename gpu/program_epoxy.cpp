// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/program.h"

#include <sstream>
#include <utility>

#include <epoxy/gl.h>

#include "core/task/error.h"
#include "gpu/shader_sources.h"

namespace pellucid::gpu {

namespace {

void append(ShaderText &out, const std::string &file) {
    const auto number = out.files.size();
    out.files.push_back(file);
    std::istringstream lines(shaderSource(file));
    int line = 0;
    for (std::string text; std::getline(lines, text);) {
        ++line;
        if (text.rfind("#include \"", 0) == 0) {
            append(out, text.substr(10, text.rfind('"') - 10));
            out.text += "#line " + std::to_string(line + 1) + " " + std::to_string(number) + "\n";
        } else {
            // Nothing but comments may stand before #version.
            if (line == 1 && number > 0)
                out.text += "#line 1 " + std::to_string(number) + "\n";
            out.text += text + "\n";
        }
    }
}

std::string fileNames(const ShaderText &shader) {
    std::string names;
    for (std::size_t n = 0; n < shader.files.size(); ++n)
        names += " " + std::to_string(n) + "=" + shader.files[n];
    return names;
}

unsigned compile(GLenum stage, const std::string &file) {
    const ShaderText shader = assembledShader(file);
    const unsigned id = glCreateShader(stage);
    const char *const text = shader.text.c_str();
    glShaderSource(id, 1, &text, nullptr);
    glCompileShader(id);
    int good = 0;
    glGetShaderiv(id, GL_COMPILE_STATUS, &good);
    if (good == 0) {
        std::string log(4096, '\0');
        int length = 0;
        glGetShaderInfoLog(id, int(log.size()), &length, log.data());
        log.resize(std::size_t(length));
        glDeleteShader(id);
        throw task::Error(task::ErrorCode::internal, "shader" + fileNames(shader) + ": " + log);
    }
    return id;
}

} // namespace

ShaderText assembledShader(const std::string &file) {
    ShaderText shader;
    append(shader, file);
    return shader;
}

Program::Program(const std::string &vertexFile, const std::string &fragmentFile) {
    const unsigned vertex = compile(GL_VERTEX_SHADER, vertexFile);
    unsigned fragment = 0;
    try {
        fragment = compile(GL_FRAGMENT_SHADER, fragmentFile);
    } catch (...) {
        glDeleteShader(vertex);
        throw;
    }
    m_id = glCreateProgram();
    glAttachShader(m_id, vertex);
    glAttachShader(m_id, fragment);
    glLinkProgram(m_id);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    int good = 0;
    glGetProgramiv(m_id, GL_LINK_STATUS, &good);
    if (good == 0) {
        std::string log(4096, '\0');
        int length = 0;
        glGetProgramInfoLog(m_id, int(log.size()), &length, log.data());
        log.resize(std::size_t(length));
        glDeleteProgram(m_id);
        throw task::Error(task::ErrorCode::internal,
                          vertexFile + " with " + fragmentFile + ": " + log);
    }
}

Program::~Program() {
    if (m_id != 0)
        glDeleteProgram(m_id);
}

Program::Program(Program &&other) noexcept : m_id(std::exchange(other.m_id, 0)) {}

Program &Program::operator=(Program &&other) noexcept {
    std::swap(m_id, other.m_id);
    return *this;
}

int Program::uniform(const char *name) const {
    return glGetUniformLocation(m_id, name);
}

} // namespace pellucid::gpu
