// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/shadow_cone.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kStart = 2;         // voxels; nearer ones are those of the receiver itself
constexpr float kDark = 1.f / 1024; // of the light; less counts as none
constexpr int kPublishedSteps = 32;

/// Two levels to interpolate between, for spheres of a radius in voxels.
struct LevelPair {
    std::uint32_t fine;
    float toCoarse;
    LevelPair(float radius, std::uint32_t levels) {
        const float level = std::clamp(std::log2(std::max(radius, 1.f)), 0.f, float(levels - 1));
        fine = std::min(std::uint32_t(level), levels - 1);
        toCoarse = level - float(fine);
    }
};

/// Whether no cell that these levels would be asked for around `p` has anything solid in it: a
/// trilinear lookup reaches one and a half cells.
bool isEmpty(const VoxelVolume& volume, LevelPair level, glm::vec3 p) {
    const std::uint32_t coarse = level.fine + (level.toCoarse > 0 ? 1 : 0);
    return isEmptyAbout(volume, p, 1.5f * float(1U << coarse));
}

float opacityOf(const VoxelVolume& volume, LevelPair level, glm::vec3 p, glm::vec3 weight) {
    const float fine = opacityAt(volume, level.fine, p, weight);
    if (!(level.toCoarse > 0))
        return fine;
    return fine + level.toCoarse * (opacityAt(volume, level.fine + 1, p, weight) - fine);
}

} // namespace

float coneVisibility(const VoxelVolume& volume, ConeShadows shadows, glm::vec3 from, glm::vec3 to,
                     float sine) {
    const float length = glm::distance(from, to);
    if (shadows == ConeShadows::None || !(length > kStart))
        return 1;
    const glm::vec3 direction = (to - from) / length;
    const glm::vec3 weight = direction * direction;
    float clear = 1, distance = kStart;
    if (shadows == ConeShadows::Published) {
        for (int i = 0; i < kPublishedSteps && distance < length; ++i) {
            const float radius = distance * sine;
            const LevelPair level(radius, volume.levels());
            const glm::vec3 p = from + distance * direction;
            if (!isEmpty(volume, level, p))
                clear *= 1 - opacityOf(volume, level, p, glm::vec3(0));
            distance += std::max(1.f, 2 * radius / (1 - sine));
        }
        return clear;
    }
    for (float radius = distance * sine; distance + radius <= length - kStart && clear > kDark;
         radius = distance * sine) {
        const LevelPair level(radius, volume.levels());
        const glm::vec3 p = from + distance * direction;
        if (!isEmpty(volume, level, p))
            clear *= 1 - opacityOf(volume, level, p, weight);
        distance += std::max(1.f, radius);
    }
    return clear > kDark ? clear : 0;
}

} // namespace limn
