// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/limn_runtime.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/techniques/illuminance/transport/transport_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace limn {

/// A transport file's bytes at an address that limnrt_open() accepts.
class AlignedBytes {
public:
    explicit AlignedBytes(const std::string& bytes)
        : m_blocks(bytes.size() / sizeof(Block) + 1), m_size(bytes.size()) {
        std::memcpy(m_blocks.data(), bytes.data(), bytes.size());
    }
    const void* data() const { return m_blocks.data(); }
    std::size_t size() const { return m_size; }

private:
    struct alignas(64) Block {
        char bytes[64];
    };
    std::vector<Block> m_blocks;
    std::size_t m_size;
};

/// A transport file opened by the runtime.
class OpenFile {
public:
    explicit OpenFile(const std::string& bytes, const limnrt_options* options = nullptr)
        : m_bytes(bytes) {
        char error[256] = "";
        m_scene = limnrt_open(m_bytes.data(), m_bytes.size(), options, error, sizeof error);
        message = error;
    }
    ~OpenFile() { limnrt_close(m_scene); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    operator limnrt_scene*() const { return m_scene; }
    limnrt_counts counts() const {
        limnrt_counts c;
        limnrt_get_counts(m_scene, &c);
        return c;
    }
    std::vector<float> lightmapSh() const {
        const limnrt_counts c = counts();
        std::vector<float> rgba(std::size_t(4) * c.lightmap_width * c.lightmap_height * c.bands *
                                c.bands);
        limnrt_lightmap_sh(m_scene, rgba.data());
        return rgba;
    }

    std::string message; ///< of a file that could not be opened

private:
    AlignedBytes m_bytes;
    limnrt_scene* m_scene;
};

/// The file of a bake, which must be made without error.
inline std::string fileOf(const Bake& bake, const Scene& scene,
                          const TransportLightmap* lightmap = nullptr) {
    Result<std::string> file = transportFile({bake, scene, lightmap, "test"});
    EXPECT_TRUE(file) << file.error().message;
    return file ? *file : "";
}

/// The light as the runtime takes it.
inline limnrt_light runtimeLight(const Light& l) {
    limnrt_light r{};
    r.kind = std::uint32_t(l.kind);
    r.flags = l.enabled ? 0 : LIMNRT_LIGHT_OFF;
    for (int k = 0; k < 3; ++k) {
        r.position[k] = l.position[k];
        r.direction[k] = l.direction[k];
        r.color[k] = l.color[k];
    }
    r.strength = l.strength;
    r.range = l.range;
    r.inner_angle = l.innerAngle;
    r.outer_angle = l.outerAngle;
    r.width = l.size.x;
    r.height = l.size.y;
    r.roll = l.roll;
    return r;
}

/// Root of the mean squared difference of red, green and blue, relative to the reference's.
inline double nrmse(const float* test, const glm::vec4* reference, std::size_t count) {
    double square = 0, difference = 0;
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            const double d = double(test[4 * i + std::size_t(k)]) - double(reference[i][k]);
            difference += d * d;
            square += double(reference[i][k]) * double(reference[i][k]);
        }
    return std::sqrt(difference / std::max(square, 1e-300));
}

} // namespace limn
