// SPDX-License-Identifier: MIT
#include "engine/lint/wall_rules.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/scene/dark_backs.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/origin.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

const LintRule kThinWallRule = {"thin-wall", Severity::Warning,
                                "A wall is thinner than the lightmap's texels that it stands on"};

namespace {

/// A texel on a surface and the wall beside it.
struct TexelWall {
    std::uint32_t wall = 0, floor = 0; ///< instances
    float thickness = 0, texel = 0;    ///< [m]
    glm::vec3 foot{0};                 ///< world
};

class WallSearch {
public:
    explicit WallSearch(const TraceScene& trace) : m_trace(trace) {}

    /// The thin wall beside a texel, if there is one.
    std::optional<TexelWall> beside(const AtlasTexel& texel) const {
        const Scene& scene = m_trace.scene();
        const Instance& instance = scene.instances[texel.instance];
        const Mesh& mesh = scene.meshOf(instance);
        const MeshPoint& point = texel.points[0];
        glm::vec3 n = instance.normalToWorld * triangleNormal(mesh, point.triangle);
        if (!(glm::length(n) > 0) || !(texel.width > 0))
            return std::nullopt;
        n = glm::normalize(n) * (texel.back != 0 ? -1.f : 1.f);
        const glm::vec3 p(instance.toWorld *
                          glm::vec4(trianglePoint(mesh, point.triangle, point.barycentric), 1));
        const Foot foot{texel.instance, p, n, texel.width};
        for (int k = 0; k < 8; ++k) {
            const float angle = float(k) * 0.78539816f;
            const glm::vec3 a = glm::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
            const glm::vec3 e = glm::normalize(glm::cross(n, a)), f = glm::cross(n, e);
            if (const auto wall = along(foot, std::cos(angle) * e + std::sin(angle) * f))
                return wall;
        }
        return std::nullopt;
    }

private:
    struct Foot {
        std::uint32_t instance;
        glm::vec3 p, n;
        float w; ///< of the texel
    };

    std::optional<TexelWall> along(const Foot& foot, glm::vec3 d) const {
        const glm::vec3 low = foot.p + foot.n * (foot.w / 2);
        const Hit front = m_trace.closestHit({low, d, 0, foot.w}, TraceMask::Static);
        // From within a solid it is the back that is met.
        if (!front || !front.frontFace || front.instance == foot.instance || isSlanted(front, d))
            return std::nullopt;
        const float reach = front.t + foot.w;
        const glm::vec3 beyond = low + d * reach;
        const Hit ahead = m_trace.closestHit({beyond, d}, TraceMask::Static);
        if (ahead && !ahead.frontFace) // within the wall, which is thick
            return std::nullopt;
        const Hit back = m_trace.closestHit({beyond, -d, 0, foot.w * 1.001f}, TraceMask::Static);
        if (!back || isSlanted(back, d))
            return std::nullopt;
        if (!isWall(foot, d, reach) || !runsOn(foot, beyond) ||
            !isOpen(m_trace, low, glm::vec3(0)) || !isOpen(m_trace, beyond, glm::vec3(0)))
            return std::nullopt;
        return TexelWall{front.instance, foot.instance, std::max(foot.w - back.t, 0.f), foot.w,
                         low + d * front.t};
    }

    /// Whether a ray meets the surface at more than 26 degrees from its normal.
    static bool isSlanted(const Hit& hit, glm::vec3 d) {
        return glm::abs(glm::dot(hit.geometricNormal, d)) < 0.9f;
    }

    /// Whether what was met is four texels high and wide.
    bool isWall(const Foot& foot, glm::vec3 d, float reach) const {
        const glm::vec3 e = glm::cross(foot.n, d);
        for (const float height : {0.5f, 2.f, 4.f})
            for (const float aside : {-2.f, 0.f, 2.f}) {
                const glm::vec3 p = foot.p + (foot.n * height + e * aside) * foot.w;
                if (!m_trace.occluded({p, d, 0, reach}, TraceMask::Static))
                    return false;
            }
        return true;
    }

    /// Whether the surface goes on behind the wall at the same height.
    bool runsOn(const Foot& foot, glm::vec3 beyond) const {
        const Hit floor = m_trace.closestHit({beyond, -foot.n, 0, foot.w}, TraceMask::Static);
        return floor && floor.instance == foot.instance &&
               std::abs(floor.t - foot.w / 2) < foot.w / 16;
    }

    const TraceScene& m_trace;
};

std::string lengthText(float metres) {
    return metres < 0.01f ? fmt::format("{:.2g} mm", 1000 * metres)
           : metres < 1.f ? fmt::format("{:.2g} cm", 100 * metres)
                          : fmt::format("{:.2g} m", metres);
}

std::vector<TexelWall> wallsBeside(const TraceScene& trace, const Atlas& atlas,
                                   const Progress& progress) {
    const WallSearch search(trace);
    std::vector<std::optional<TexelWall>> found(atlas.texels.size());
    parallelRanges(atlas.texels.size(), 256, progress, "walls",
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t k = begin; k < end; ++k)
                           if (atlas.texels[k].count > 0)
                               found[k] = search.beside(atlas.texels[k]);
                   });
    std::vector<TexelWall> walls;
    for (const auto& wall : found)
        if (wall && wall->thickness < wall->texel)
            walls.push_back(*wall);
    return walls;
}

} // namespace

std::vector<Finding> wallFindings(const LintScene& in, const Progress& progress) {
    Scene scene = in.scene;
    if (std::ranges::all_of(scene.instances, &Instance::dynamic))
        return {};
    leaveOutDarkBacks(scene);
    const TraceScene trace(scene, in.trace);
    std::uint64_t rays = 0;
    const auto placed = atlasStage(trace, scene, hashMeshes(scene), progress, nullptr, rays);
    if (!placed)
        return {};
    struct Worst {
        TexelWall wall;
        std::size_t texels = 0;
    };
    std::map<std::uint32_t, Worst> worst; // by the wall's instance
    for (const TexelWall& wall : wallsBeside(trace, placed->atlas, progress)) {
        const auto [entry, isNew] = worst.try_emplace(wall.wall, Worst{wall});
        Worst& w = entry->second;
        ++w.texels;
        if (wall.thickness * w.wall.texel < w.wall.thickness * wall.texel)
            w.wall = wall;
    }
    std::vector<Finding> findings;
    for (const auto& [instance, w] : worst) {
        constexpr std::size_t kEnough = 3; // texels beside each other
        if (w.texels < kEnough)
            continue;
        Finding finding = findingAbout(
            in, kThinWallRule, scene.instances[instance].node,
            fmt::format("{} is {} thick and stands on texels {} wide of \"{}\".",
                        partText(scene, scene.instances[instance]), lengthText(w.wall.thickness),
                        lengthText(w.wall.texel),
                        objectPath(in.document, scene.instances[w.wall.floor].node)),
            "Make the wall thicker, raise the density of that object's texels, or split it at the "
            "wall: light of one side may show on the other.");
        if (w.wall.thickness > w.wall.texel / 8)
            finding.severity = Severity::Note;
        finding.place = toFile(scene.origin, w.wall.foot);
        findings.push_back(std::move(finding));
    }
    return findings;
}

} // namespace limn
