// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_table.h"
#include "engine/lightmap/atlas.h"

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>

#include <glm/vec3.hpp>

namespace limn {

/// A scene in light that is known: a grey quad whose lightmap holds the irradiance
/// quadIrradiance(), and a white ball lit by a grid of given harmonics. Both have their centre at
/// the origin, so a page shows one of them at a time.
struct KnownLight {
    using Harmonics = std::function<std::array<glm::vec3, 9>(glm::vec3 position)>;

    static constexpr std::uint32_t kTexels = 8; ///< of the lightmap, along each side
    static constexpr float kAlbedo = 0.5f;      ///< of the quad

    /// Irradiance at texel (x, y), row 0 at the top: the quad's corners are the centres of texels
    /// (0, 0) and (7, 7), and a lookup is linear in between.
    static glm::vec3 quadIrradiance(float x, float y) { return {0.25f + x / 8, 3 * y / 8, 5}; }

    /// Radiance of the test with number `i`: constant, and so much of harmonic i that irradiance
    /// stays positive.
    static std::array<glm::vec3, 9> probe(std::size_t i) {
        std::array<glm::vec3, 9> c{};
        const float y0 = std::sqrt(1 / (4 * std::numbers::pi_v<float>));
        c[0] = glm::vec3((i == 0 ? 1.f : 0.5f) / y0);
        if (i > 0)
            c[i] = glm::vec3(0.25f);
        return c;
    }

    explicit KnownLight(const Harmonics& harmonics, glm::uvec3 size = {4, 3, 5})
        : scene(makeScene(document)), trace(scene), layout(makeLayout(scene)) {
        field.bands = 3;
        setLightmap();
        setGrid(harmonics, size);
    }

    /// Makes the quad's lightmap hold the same harmonics everywhere.
    void setLightmap(const std::array<glm::vec3, 9>& harmonics) {
        for (std::size_t i = 0; i < 9; ++i)
            for (std::size_t texel = 0; texel < kTexels * kTexels; ++texel)
                field.lightmap[i * kTexels * kTexels + texel] = glm::vec4(harmonics[i], 0);
    }

    ExportScene view() const { return {document, scene, trace, layout, field}; }

    Document document;
    Scene scene;
    TraceScene trace;
    LightmapLayout layout;
    IndirectField field;

private:
    static Mesh quadMesh() {
        Mesh m;
        m.name = "quad";
        m.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
        m.normals.assign(4, {0, 0, 1});
        m.indices = {0, 1, 2, 0, 2, 3};
        return m;
    }

    static Mesh ballMesh() {
        Mesh m;
        m.name = "ball";
        m.material = 1;
        constexpr std::uint32_t kRows = 64, kColumns = 128;
        for (std::uint32_t row = 0; row <= kRows; ++row)
            for (std::uint32_t column = 0; column <= kColumns; ++column) {
                const double theta = std::numbers::pi * row / kRows;
                const double phi = 2 * std::numbers::pi * column / kColumns;
                const double r = row == 0 || row == kRows ? 0 : std::sin(theta);
                m.positions.emplace_back(r * std::cos(phi), std::cos(theta), r * std::sin(phi));
            }
        m.normals = m.positions;
        for (std::uint32_t row = 0; row < kRows; ++row)
            for (std::uint32_t column = 0; column < kColumns; ++column) {
                const std::uint32_t a = row * (kColumns + 1) + column, b = a + kColumns + 1;
                if (row > 0)
                    m.indices.insert(m.indices.end(), {a, a + 1, b});
                if (row + 1 < kRows)
                    m.indices.insert(m.indices.end(), {b, a + 1, b + 1});
            }
        return m;
    }

    static Scene makeScene(Document& document) {
        auto assets = std::make_shared<Assets>();
        assets->meshes = {quadMesh(), ballMesh()};
        Material grey, white;
        grey.name = "grey";
        grey.baseColor = glm::vec4(glm::vec3(kAlbedo), 1);
        white.name = "white";
        addObject(document, grey);
        addObject(document, white);
        for (const std::uint32_t mesh : {0U, 1U}) {
            Node node;
            node.name = assets->meshes[mesh].name;
            node.meshes = {mesh};
            node.dynamic = mesh == 1;
            addObject(document, node);
        }
        addObject(document, Camera{.name = "eye", .eye = {0, 0, 5}});
        return flatten(document, assets);
    }

    static LightmapLayout makeLayout(const Scene& scene) {
        LightmapLayout layout = layoutWithoutLightmap(scene);
        layout.width = layout.height = kTexels;
        layout.meshes.resize(2);
        layout.meshes[0] = {.sourceVertex = {0, 1, 2, 3},
                            .indices = {0, 1, 2, 0, 2, 3},
                            .chartOfTriangle = {0, 0},
                            .chartUv = {{0, 2}, {2, 2}, {2, 0}, {0, 0}},
                            .chartSize = {{2, 2}}};
        constexpr float kFirst = 0.5f / kTexels, kLast = 1 - kFirst;
        layout.instances.resize(2);
        layout.instances[0].uv = {
            {kFirst, kLast}, {kLast, kLast}, {kLast, kFirst}, {kFirst, kFirst}};
        return layout;
    }

    void setLightmap() {
        field.lightmapWidth = field.lightmapHeight = kTexels;
        field.lightmap.resize(field.coefficients() * kTexels * kTexels);
        // A quarter of it comes from harmonic (1, 0), whose axis is the quad's normal.
        const float pi = std::numbers::pi_v<float>, k0 = std::sqrt(1 / (4 * pi)),
                    k1 = std::sqrt(3 / (4 * pi));
        for (std::uint32_t y = 0; y < kTexels; ++y)
            for (std::uint32_t x = 0; x < kTexels; ++x) {
                const glm::vec4 e(quadIrradiance(float(x), float(y)), 0);
                const std::uint32_t texel = y * kTexels + x;
                field.lightmap[texel] = 0.75f * e / (pi * k0);
                field.lightmap[2 * kTexels * kTexels + texel] = 0.25f * e / (2 * pi / 3 * k1);
            }
    }

    void setGrid(const Harmonics& harmonics, glm::uvec3 n) {
        field.gridSize = n;
        field.gridBounds = {{-4, -4.5f, -8}, {4, 4.5f, 8}};
        const std::size_t cells = std::size_t(n.x) * n.y * n.z;
        field.grid.resize(field.coefficients() * cells);
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const glm::vec3 at(cell % n.x, cell / n.x % n.y, cell / n.x / n.y);
            const auto c = harmonics(field.gridBounds.lower +
                                     (at + 0.5f) / glm::vec3(n) * field.gridBounds.size());
            for (std::size_t i = 0; i < 9; ++i)
                field.grid[i * cells + cell] = glm::vec4(c[i], 0);
        }
    }
};

/// All formats but those with the transport of a bake, which known light does not have;
/// transport_formats_test.cpp has them.
inline std::vector<const ExportFormat*> formatsOfLight() {
    std::vector<const ExportFormat*> formats;
    for (const ExportFormat* format : exportFormats())
        if (const std::string_view name = format->name; name != "limnrt" && name != "web")
            formats.push_back(format);
    return formats;
}

} // namespace limn
