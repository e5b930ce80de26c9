// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/layout_rules.h"
#include "engine/stages/stage_archive.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/format/settings_fields.h"
#include "engine/techniques/illuminance/format/tree_rules.h"

namespace limn {

// The fields of a Bake and the rules they must satisfy, in chunks, for bake files and for checks of
// a bake. `scene`: the baked scene; null where it is not known.

/// Whether every cache's links bring finite light, at most some hundred times the possible maximum.
bool linksAreBounded(const Caches& caches, std::uint32_t bands);

/// Whether each lightmap cache has a texel to itself and the grid's caches follow its cells in
/// order.
bool placesAreCaches(const Caches& caches, std::uint64_t texels, std::uint64_t cells);

template <class A, class B>
void surfelFields(A& a, B& b, const Scene* scene) {
    auto& s = b.surfels;
    const std::uint64_t n = s.position.size();
    a("position", s.position, rule::inReach());
    a("normal", s.normal, rule::count(n), rule::unit());
    a("area", s.area, rule::count(n), rule::within(0, 1e30));
    a("instance", s.instance, rule::count(n), rule::below(b.lightmap.instances.size()));
    a("triangle", s.triangle, rule::count(n),
      rule::each("out of range", [&s, scene](std::size_t i, std::uint32_t t) {
          return !scene || t < scene->meshOf(scene->instances[s.instance[i]]).triangleCount();
      }));
    a("barycentric", s.barycentric, rule::count(n), rule::within(-1e-4, 1 + 1e-4));
    a("cache", s.cache, rule::count(n), rule::belowOr(b.caches.lightmapCount, ~0U));
    a("cacheWeight", s.cacheWeight, rule::count(n), rule::within(0, 1 + 1e-4));
    a("lightPoints", s.lightPoints, rule::noneOr(n * kLightPoints), rule::inReach());
    a("lightNormals", s.lightNormals, rule::count(s.lightPoints.size()), rule::unit());
}

template <class A, class B>
void treeFields(A& a, B& b) {
    auto& t = b.tree;
    const std::uint64_t inner = t.left.size();
    a("surfels", t.surfels, rule::holds("not the surfels that there are", [&b](std::uint32_t n) {
          return n == b.surfels.size() && n > 0;
      }));
    a("skyCells", t.skyCells, rule::holds("not the sky's directions", [&t](std::uint32_t n) {
          return n == t.skyDirection.size();
      }));
    a("left", t.left, rule::any);
    a("right", t.right,
      rule::holds("a child that comes after its parent, or has two",
                  [&t](const auto& right) { return isTree(t.left, right, t.leaves()); }));
    a("leftWeight", t.leftWeight, rule::count(inner), rule::within(0, 1));
    a("parent", t.parent, rule::count(t.size()),
      rule::holds("not the one of whom it is a child", [&t](const auto& parent) {
          for (std::size_t k = 0; k < t.left.size(); ++k)
              if (parent[t.left[k]] != t.leaves() + k || parent[t.right[k]] != t.leaves() + k)
                  return false;
          return parent.back() == ~0U;
      }));
    a("skyDirection", t.skyDirection, rule::unit());
}

template <class A, class B>
void cacheFields(A& a, B& b) {
    auto& c = b.caches;
    const std::uint64_t n = c.position.size(), coefficients = b.settings.bands * b.settings.bands;
    const bool rtp = b.settings.storage == LinkStorage::Rtp;
    a("lightmapCount", c.lightmapCount, rule::below(n + 1));
    a("kind", c.kind, rule::count(n), rule::each("out of range", [&c](std::size_t i, CacheKind k) {
          return k == (i < c.lightmapCount ? CacheKind::Hemisphere : CacheKind::Grid);
      }));
    a("position", c.position, rule::inReach());
    a("normal", c.normal, rule::count(n), rule::within(-1 - 1e-3, 1 + 1e-3));
    a("texel", c.texel, rule::count(n), rule::holds("out of range", [&b](const auto&) {
          const glm::u64vec3 grid(b.gridSize);
          return placesAreCaches(b.caches, std::uint64_t(b.lightmap.width) * b.lightmap.height,
                                 grid.x * grid.y * grid.z);
      }));
    a("linkBegin", c.linkBegin, rule::offsets(n, rtp ? c.links.size() : c.shNode.size()));
    a("linkExponent", c.linkExponent, rule::count(n));
    a("links", c.links, rtp ? rule::count(c.links.size()) : rule::count(0),
      rule::each("node out of range",
                 [&b](std::size_t, const Link& l) { return l.node < b.tree.size(); }));
    a("shNode", c.shNode, rtp ? rule::count(0) : rule::count(c.shNode.size()),
      rule::below(b.tree.size()));
    a("shCoefficients", c.shCoefficients, rule::count(c.shNode.size() * coefficients),
      rule::holds("more light than there is",
                  [&b](const auto&) { return linksAreBounded(b.caches, b.settings.bands); }));
    a("fillBegin", c.fillBegin, rule::offsets(n, c.fillSource.size()));
    a("fillSource", c.fillSource, rule::below(n));
    a("fillWeight", c.fillWeight, rule::count(c.fillSource.size()), rule::within(0, 1 + 1e-4));
}

template <class A, class B>
void gridDepthFields(A& a, B& b) {
    a("gridDepth", b.gridDepth,
      rule::count((b.caches.size() - b.caches.lightmapCount) * kDepthsPerCell));
}

/// Calls visit(name, fields) for every chunk; `fields(archive, bake)` lists its fields.
template <class F>
void forBakeChunks(const Scene* scene, F visit) {
    visit("SETTINGS", [](auto& a, auto& b) { settingsFields(a, b); });
    visit("TIMINGS ", [](auto& a, auto& b) { secondsFields(a, b.seconds); });
    visit("LIGHTMAP", [scene](auto& a, auto& b) {
        layoutFields(a, b.lightmap, b.caches.lightmapCount, scene);
    });
    visit("SURFELS ", [scene](auto& a, auto& b) { surfelFields(a, b, scene); });
    visit("CLUSTERS", [](auto& a, auto& b) { treeFields(a, b); });
    visit("CACHES  ", [](auto& a, auto& b) { cacheFields(a, b); });
    visit("GRIDDEEP", [](auto& a, auto& b) { gridDepthFields(a, b); });
}

} // namespace limn
