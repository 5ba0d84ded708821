// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/card_ray_sum.h"

#include <algorithm>
#include <cmath>

#include <epoxy/gl.h>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>

#include "gpu/transform_passes.h"

namespace pellucid::bench {

struct CardRaySum::Resources {
    gpu::TextureName field = gpu::makeTexture();
    gpu::PixelTexture picture;
    gpu::QueryName begin = gpu::makeQuery(), end = gpu::makeQuery();
};

CardRaySum::CardRaySum(std::shared_ptr<gpu::FramePasses> passes, const volume::Field &field)
    : m_passes(std::move(passes)), m_lattice(field.lattice()) {
    const volume::GridSize n = m_lattice.size();
    std::vector<std::uint16_t> samples;
    samples.reserve(n.count());
    std::vector<float> row(std::size_t(n.i));
    for (int k = 0; k < n.k; ++k)
        for (int j = 0; j < n.j; ++j) {
            field.copyRow({0, j, k}, n.i, row.data());
            for (const float f : row)
                samples.push_back(
                    std::uint16_t(std::lround(65535.0 * std::clamp(double(f), 0.0, 1.0))));
        }
    m_passes->device().run([&] {
        gpu::Device *const device = &m_passes->device();
        m_resources =
            gpu::OnDevice<Resources>(new Resources, gpu::DeleteOnDevice<Resources>{device});
        glBindTexture(GL_TEXTURE_3D, m_resources->field.name());
        glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
            glTexParameteri(GL_TEXTURE_3D, wrap, GL_CLAMP_TO_BORDER);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
        glTexStorage3D(GL_TEXTURE_3D, 1, GL_R16, n.i, n.j, n.k);
        glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, n.i, n.j, n.k, GL_RED, GL_UNSIGNED_SHORT,
                        samples.data());
        gpu::checkErrors("a volume");
    });
}

CardRaySum::~CardRaySum() = default;

CardRaySum::Image CardRaySum::render(const scene::Camera &camera, double stepMm) {
    const glm::dmat3 axes = camera.axes();
    const glm::dmat3 toVoxels =
        glm::inverse(glm::dmat3(m_lattice.step(0), m_lattice.step(1), m_lattice.step(2)));
    const volume::GridSize n = m_lattice.size();
    const glm::dvec3 size(n.i, n.j, n.k);
    // The centre of the lattice is the middle of the texture.
    const auto inTexture = [&](const glm::dvec3 &mm) { return glm::vec3(toVoxels * mm / size); };
    const double left = camera.panMm.x - 0.5 * (camera.width - 1) * camera.pixelMm;
    const double top = camera.panMm.y + 0.5 * (camera.height - 1) * camera.pixelMm;
    const glm::vec3 corner = inTexture(left * axes[0] + top * axes[1]) + glm::vec3(0.5F);
    Image image;
    m_passes->device().run([&] {
        m_resources->picture.reserve(camera.width, camera.height, 1);
        const gpu::Program &program = m_passes->device().program("ray_sum.comp");
        glUseProgram(program.id());
        const auto set = [&](const char *name, const glm::vec3 &value) {
            glUniform3fv(program.uniform(name), 1, glm::value_ptr(value));
        };
        set("corner", corner);
        set("perColumn", inTexture(camera.pixelMm * axes[0]));
        set("perRow", inTexture(-camera.pixelMm * axes[1]));
        set("perStep", inTexture(stepMm * axes[2]));
        glUniform2i(program.uniform("size"), camera.width, camera.height);
        glUniform1f(program.uniform("stepLength"), float(stepMm));
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_3D, m_resources->field.name());
        glBindImageTexture(0, m_resources->picture.id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
        glQueryCounter(m_resources->begin.name(), GL_TIMESTAMP);
        gpu::dispatchGroups((camera.width + 7) / 8, (camera.height + 7) / 8, 1);
        glQueryCounter(m_resources->end.name(), GL_TIMESTAMP);
        image.samples = m_resources->picture.download();
        GLuint64 begin = 0, end = 0;
        glGetQueryObjectui64v(m_resources->begin.name(), GL_QUERY_RESULT, &begin);
        glGetQueryObjectui64v(m_resources->end.name(), GL_QUERY_RESULT, &end);
        image.cardMs = 1e-6 * double(end - begin);
        gpu::checkErrors("a ray sum");
    });
    return image;
}

} // namespace pellucid::bench
