// SPDX-License-Identifier: MIT
#include "engine/lightmap/atlas_stage.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/lightmap/charts.h"
#include "engine/lightmap/density.h"
#include "engine/lightmap/density_fields.h"
#include "engine/lightmap/fine_texels.h"
#include "engine/lightmap/lamp_texels.h"
#include "engine/lightmap/layout/layout_rules.h"
#include "engine/lightmap/texel_sides.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/stages/stage_archive.h"
#include "engine/stages/stage_keys.h"

#include <algorithm>
#include <cmath>

namespace limn {

namespace {

/// Charts of every mesh that a static instance uses. Returns false when cancelled.
bool chartMeshes(const Scene& scene, const std::vector<std::uint64_t>& meshes,
                 const Progress& progress, StageStore* store, std::vector<MeshCharts>& charts) {
    charts.assign(meshes.size(), {});
    std::vector<bool> used(charts.size());
    for (const Instance& i : scene.instances)
        used[i.mesh] = used[i.mesh] || !i.dynamic;
    return parallelRanges(
        charts.size(), 1, progress, "charts", [&](std::size_t begin, std::size_t end) {
            for (std::size_t m = begin; m < end; ++m)
                if (used[m])
                    charts[m] = keptOrMade<MeshCharts>(
                        store, stageKey(Stage::Charts, meshes[m]), progress,
                        [&mesh = scene.assets->meshes[m]](auto& a, auto& c) {
                            chartFields(a, c, &mesh);
                        },
                        [&] { return buildCharts(scene.assets->meshes[m], progress); });
        });
}

/// Hash of everything that buildAtlas() reads.
std::uint64_t atlasKey(const Scene& scene, const std::vector<std::uint64_t>& meshes,
                       const BakeSettings& settings, const BakeDensity& density) {
    std::uint64_t h = hashValue(settings.texelsPerMetre, settings.lightmapCaches);
    for (const Instance& i : scene.instances) {
        h = hashValue(atlasScale(i), hashValue(meshes[i.mesh], h));
        h = hashValue(std::uint32_t(i.dynamic), hashValue(std::uint32_t(isTwoSided(scene, i)), h));
    }
    for (const std::vector<float>& factors : density.texels)
        h = hashVector(factors, h);
    return h;
}

/// Hash of all surfaces that rays can hit, and `seed`.
std::uint64_t surfacesKey(const TraceScene& trace, const std::vector<std::uint64_t>& meshes,
                          std::uint64_t seed) {
    const Scene& scene = trace.scene();
    std::uint64_t h = hashValue(trace.epsilonAt(glm::vec3(0)), seed);
    for (const Instance& i : scene.instances) {
        h = hashValue(std::uint32_t(i.dynamic), hashValue(i.node, hashValue(meshes[i.mesh], h)));
        h = hashSurface(scene, scene.materialOf(i), hashBytes(&i.toWorld, sizeof i.toWorld, h));
        h = hashValue(std::uint32_t(i.darkBacks), h);
    }
    return h;
}

/// Gives lamps a uniform density: caches sample their surfels by area, which is exact only then.
/// (The set of emissive materials may change without tracing anything again.)
void evenLamps(const Scene& scene, std::vector<MeshDensity>& surfels) {
    for (const Instance& i : scene.instances)
        if (!surfels.empty() && emits(scene.materialOf(i)))
            surfels[i.mesh] = {};
}

/// Multiplies the factors of the instances with a texel density of their own.
void applyTexelDensity(const Scene& scene, const std::vector<MeshCharts>& charts,
                       std::vector<std::vector<float>>& factors) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (instance.texelDensity == 1 || instance.dynamic)
            continue;
        factors.resize(scene.instances.size());
        if (factors[i].empty())
            factors[i].assign(charts[instance.mesh].chartSize.size(), 1);
        for (float& factor : factors[i])
            factor *= instance.texelDensity;
    }
}

/// Whether an instance has a place in the atlas.
bool hasCharts(const Scene& scene, const std::vector<MeshCharts>& charts, std::size_t instance) {
    return instance < scene.instances.size() && !scene.instances[instance].dynamic &&
           !charts[scene.instances[instance].mesh].chartSize.empty();
}

template <class A, class V>
void variedFields(A& a, V& v, const Scene& scene, const std::vector<MeshCharts>& charts) {
    a("instance", v.instance,
      rule::holds("without charts", [&](std::uint32_t i) { return hasCharts(scene, charts, i); }));
    a("chart", v.chart, rule::holds("out of range", [&](std::uint32_t chart) {
          return chart < charts[scene.instances[v.instance].mesh].chartSize.size();
      }));
    a("at", v.points, rule::each("not on the mesh", [&](std::size_t, const MeshPoint& p) {
          return isPointOf(scene.meshOf(scene.instances[v.instance]), p);
      }));
    a("back", v.back, rule::count(v.points.size()), rule::below(2));
    a("fours", v.fours, rule::count(v.points.size()),
      rule::within(kMinDensityClass, kMaxDensityClass));
}

template <class A, class D>
void bakeDensityFields(A& a, D& d, const Scene& scene, const std::vector<MeshCharts>& charts) {
    a.each("texels", d.texels, rule::noneOr(scene.instances.size()), [&](auto& factors) {
        const auto i = std::size_t(&factors - d.texels.data());
        a("factors", factors, rule::noneOr(charts[scene.instances[i].mesh].chartSize.size()),
          rule::within(std::exp2(2 * kMinDensityClass), std::exp2(2 * kMaxDensityClass)));
    });
    a.each("surfels", d.surfels, rule::noneOr(scene.assets->meshes.size()), [&](auto& s) {
        densityFields(a, s, scene.assets->meshes[std::size_t(&s - d.surfels.data())]);
    });
    a.each("varied", d.varied, rule::any, [&](auto& v) { variedFields(a, v, scene, charts); });
    a("baseShare", d.baseShare, rule::within(0, 1));
    a("centre", d.centre, rule::within(1e-300, 1e300));
    a("size", d.size, rule::within(0, 1e30));
    a("nearest", d.nearest, rule::within(0, 1e30));
}

BakeDensity densityStage(const TraceScene& trace, const std::vector<std::uint64_t>& meshes,
                         const std::vector<MeshCharts>& charts, std::uint32_t texels,
                         const Progress& progress, StageStore* store, std::uint64_t& rays) {
    return keptOrMade<BakeDensity>(
        store, stageKey(Stage::Density, surfacesKey(trace, meshes, texels)), progress,
        [&](auto& a, auto& d) { bakeDensityFields(a, d, trace.scene(), charts); },
        [&] {
            BakeDensity made = findDensity(trace, charts, texels, progress);
            rays += made.rays;
            return made;
        });
}

/// Lists all fields but the charts, which are stored per mesh.
template <class A, class T>
void atlasFields(A& a, T& t, const Scene& scene, const std::vector<MeshCharts>& charts) {
    auto& l = t.layout;
    a("width", l.width, rule::any);
    a("height", l.height, rule::holds("too large for its texels", [&](std::uint32_t height) {
          return isAtlasSize(l.width, height, t.texels.size());
      }));
    a("texels", t.texels, rule::each("out of range", [&](std::size_t i, const AtlasTexel& texel) {
          return texel.texel < std::uint64_t(l.width) * l.height && texel.back <= 1 &&
                 (i == 0 || t.texels[i - 1].texel < texel.texel) && texel.width >= 0 &&
                 texel.width < kMaxCoordinate && hasCharts(scene, charts, texel.instance) &&
                 arePointsOf(scene.meshOf(scene.instances[texel.instance]), texel);
      }));
    a("texelsPerMetre", t.texelsPerMetre, rule::within(1e-30, 1e30));
    a.each("instances", l.instances, rule::count(scene.instances.size()), [&](auto& i) {
        const auto instance = std::size_t(&i - l.instances.data());
        a("uv", i.uv, rule::within(0, 1),
          rule::count(hasCharts(scene, charts, instance)
                          ? charts[scene.instances[instance].mesh].sourceVertex.size()
                          : 0));
        a("backRows", i.backRows, rule::below(l.height));
    });
}

/// Lists the fields of an atlas' texels.
template <class A, class S>
void sideFields(A& a, S& s, const Scene& scene, const Atlas& atlas) {
    a("texels", s.texels, rule::count(atlas.texels.size()),
      rule::each("not the atlas'", [&](std::size_t i, const AtlasTexel& texel) {
          const AtlasTexel& whole = atlas.texels[i];
          return texel.texel == whole.texel && texel.instance == whole.instance &&
                 texel.back == whole.back && texel.width == whole.width &&
                 arePointsOf(scene.meshOf(scene.instances[texel.instance]), texel);
      }));
    a("open", s.open, rule::count(atlas.texels.size()), rule::below(2));
    a("snaps", s.snaps, [&atlas](const auto& snaps) {
        return snapDefect(snaps, atlas.layout.width, atlas.layout.height);
    });
}

/// Lists the fields of fine lookups of an atlas, limited to what can be needed, so that the atlas'
/// size fits in 31 bits.
template <class A, class F>
void fineFields(A& a, F& f, const LightmapLayout& layout) {
    constexpr std::size_t kMaxPlaces = 1 << 24;
    a.each("levels", f.places,
           rule::holds("too many",
                       [&](const auto& levels) {
                           std::size_t places = 0;
                           for (const auto& level : levels)
                               places += level.size();
                           return levels.size() <= std::size_t(kFineLevels) && places <= kMaxPlaces;
                       }),
           [&](auto& places) {
               const auto level = std::size_t(&places - f.places.data());
               std::uint64_t height = layout.height;
               for (std::size_t k = 0; k < level; ++k)
                   height += fineRows(layout, f.places[k].size());
               a("places", places, rule::below(layout.width * height),
                 rule::holds("out of order",
                             [](const auto& all) { return std::ranges::is_sorted(all); }));
           });
}

/// An atlas of coarse texels and the lookups at which finer ones are to be added.
struct LaidTexels {
    Atlas atlas;
    FineLookups fine;
    std::uint64_t key = 0; ///< of both
};

/// Inputs from which the texels of a bake are computed, and the store of the results.
struct TexelInput {
    const TraceScene& trace;
    const Scene& scene;
    const std::vector<std::uint64_t>& meshes;
    const std::vector<MeshCharts>& charts;
    const BakeDensity& density;
    const Progress& progress;
    StageStore* store;
    std::uint64_t& rays;

    LaidTexels lay(std::uint32_t base, std::uint64_t maxTexels) const;
};

/// Lays about `base` coarse texels, and finer ones up to `maxTexels` in total. Incomplete when
/// cancelled.
LaidTexels TexelInput::lay(std::uint32_t base, std::uint64_t maxTexels) const {
    BakeSettings settings = scene.bake;
    settings.lightmapCaches = std::max(base, 1U);
    LaidTexels result;
    result.key = atlasKey(scene, meshes, settings, density);
    result.atlas = keptOrMade<Atlas>(
        store, stageKey(Stage::Atlas, result.key), progress,
        [&](auto& a, auto& t) { atlasFields(a, t, scene, charts); },
        [&] { return buildAtlas(scene, charts, settings, density.texels, progress); });
    result.atlas.layout.meshes = charts;
    if (density.varied.empty() || progress.cancelled())
        return result;
    const std::uint64_t laid = result.atlas.texels.size();
    result.fine = keptOrMade<FineLookups>(
        store,
        stageKey(Stage::FineTexels, surfacesKey(trace, meshes, hashValue(result.key, maxTexels))),
        progress, [&](auto& a, auto& f) { fineFields(a, f, result.atlas.layout); },
        [&] {
            FineLookups made =
                findFineLookups(trace, result.atlas, density,
                                std::uint32_t(maxTexels - std::min(maxTexels, laid)), progress);
            rays += made.rays;
            return made;
        });
    for (const std::vector<std::uint32_t>& places : result.fine.places)
        result.key = hashVector(places, result.key);
    return result;
}

/// Lays as many texels as the settings ask for. The number of finer ones that a scene needs is
/// known only after a first trial; then both kinds are reduced by the same factor.
LaidTexels layTexels(const TexelInput& in) {
    const std::uint64_t wanted = in.scene.bake.lightmapCaches;
    if (in.density.varied.empty())
        return in.lay(std::uint32_t(wanted), 0);
    const auto share = [&](double part) {
        return std::uint32_t(std::lround(double(wanted) * part));
    };
    constexpr std::uint64_t kTrial = 4; // times those wanted
    const LaidTexels trial = in.lay(share(in.density.baseShare), kTrial * wanted);
    const double base = double(trial.atlas.texels.size()), all = base + double(trial.fine.texels());
    constexpr double kMinBase = 0.25;
    return in.lay(share(std::max(base / std::max(all, 1.), kMinBase)), wanted);
}

/// All triangles of static instances in an atlas without finer texels.
std::vector<PlacedTriangle> allTriangles(const Scene& scene, const LightmapLayout& layout) {
    std::vector<PlacedTriangle> result;
    for (std::uint32_t i = 0; i < layout.instances.size(); ++i) {
        if (layout.instances[i].uv.empty())
            continue;
        const std::uint32_t mesh = scene.instances[i].mesh;
        const auto count = std::uint32_t(layout.meshes[mesh].chartOfTriangle.size());
        for (std::uint32_t back = 0; back < (layout.instances[i].backRows > 0 ? 2U : 1U); ++back)
            for (std::uint32_t t = 0; t < count; ++t)
                result.push_back(placeTriangle(layout, mesh, i, back, t));
    }
    return result;
}

bool isLamp(const Scene& scene, const Instance& instance) {
    return !instance.dynamic && emits(scene.materialOf(instance));
}

/// Adds finer texels where light from lamps varies within a texel, at most as many as were asked
/// for. `placed` says how triangles lie in the finer texels that the atlas has, and gets those that
/// are added.
void addLampTexels(const TexelInput& in, LaidTexels& laid, std::vector<PlacedTriangle>& placed) {
    std::uint64_t key = surfacesKey(in.trace, in.meshes, laid.key);
    for (const Instance& i : in.scene.instances)
        key = hashValue(std::uint32_t(isLamp(in.scene, i)), key);
    std::vector<PlacedTriangle> triangles = allTriangles(in.scene, laid.atlas.layout);
    triangles.insert(triangles.end(), placed.begin(), placed.end());
    const FineLookups lookups = keptOrMade<FineLookups>(
        in.store, stageKey(Stage::LampTexels, key), in.progress,
        [&](auto& a, auto& f) { fineFields(a, f, laid.atlas.layout); },
        [&] {
            const std::uint32_t wanted = in.scene.bake.lightmapCaches;
            FineLookups made =
                findLampLookups(in.trace, laid.atlas, triangles, wanted, wanted,
                                kFineLevels - int(laid.fine.places.size()), in.progress);
            in.rays += made.rays;
            return made;
        });
    std::uint64_t row = laid.atlas.layout.height;
    for (const std::vector<std::uint32_t>& places : lookups.places) {
        laid.atlas.lampRows.push_back(std::uint32_t(row));
        row += fineRows(laid.atlas.layout, places.size());
    }
    const std::vector<PlacedTriangle> more =
        addFineTexels(in.scene, std::move(triangles), lookups, laid.atlas);
    placed.insert(placed.end(), more.begin(), more.end());
    for (const std::vector<std::uint32_t>& places : lookups.places)
        laid.key = hashVector(places, laid.key);
}

/// Adds `snaps` to those elements that lead to finer texels.
void addSnaps(std::vector<std::uint32_t> snaps, LightmapLayout& layout) {
    if (snaps.empty())
        return;
    for (std::size_t i = 0; i < layout.snaps.size(); ++i)
        if (layout.snaps[i] & kFineLookup)
            snaps[i] = layout.snaps[i];
    layout.snaps = std::move(snaps);
}

} // namespace

bool refinesNearLamps(const Scene& scene) {
    constexpr std::uint32_t kFewRays = 128;
    return scene.bake.rays >= kFewRays && !(scene.bake.texelsPerMetre > 0) &&
           std::ranges::any_of(scene.instances,
                               [&](const Instance& i) { return isLamp(scene, i); });
}

std::optional<PlacedAtlas> atlasStage(const TraceScene& trace, const Scene& scene,
                                      const std::vector<std::uint64_t>& meshes,
                                      const Progress& progress, StageStore* store,
                                      std::uint64_t& rays) {
    std::vector<MeshCharts> charts;
    if (!chartMeshes(scene, meshes, progress, store, charts))
        return {};
    const auto texels = std::uint32_t(std::clamp(wantedTexels(scene), 1., double(1U << 24)));
    BakeDensity density = densityStage(trace, meshes, charts, texels, progress, store, rays);
    if (progress.cancelled())
        return {};
    if (scene.bake.texelsPerMetre > 0)
        density.texels.clear(), density.varied.clear();
    applyTexelDensity(scene, charts, density.texels);
    evenLamps(scene, density.surfels);
    const TexelInput in{trace, scene, meshes, charts, density, progress, store, rays};
    LaidTexels laid = layTexels(in);
    if (progress.cancelled())
        return {};
    Atlas& atlas = laid.atlas;
    std::vector<PlacedTriangle> placed =
        addFineTexels(scene, variedTriangles(scene, density, atlas.layout), laid.fine, atlas);
    if (refinesNearLamps(scene))
        addLampTexels(in, laid, placed);
    if (progress.cancelled())
        return {};
    TexelSides sides = keptOrMade<TexelSides>(
        store, stageKey(Stage::TexelSides, surfacesKey(trace, meshes, laid.key)), progress,
        [&](auto& a, auto& s) { sideFields(a, s, scene, atlas); },
        [&] {
            TexelSides made = findTexelSides(trace, atlas, placed, progress);
            rays += made.rays;
            return made;
        });
    if (progress.cancelled())
        return {};
    atlas.texels = std::move(sides.texels);
    atlas.open = std::move(sides.open);
    addSnaps(std::move(sides.snaps), atlas.layout);
    return PlacedAtlas{std::move(atlas), std::move(density.surfels)};
}

} // namespace limn
