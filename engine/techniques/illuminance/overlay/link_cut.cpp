// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/link_cut.h"

#include "engine/lightmap/atlas.h"
#include "engine/techniques/illuminance/format/link_storage.h"

#include <algorithm>
#include <map>

#include <glm/common.hpp>

namespace limn {

// Spreads a node's weight over the leaves below it.
static std::uint32_t addLeaves(const ClusterTree& tree, std::uint32_t root, float weight,
                               LinkCut& cut) {
    std::uint32_t leaves = 0;
    std::vector<std::pair<std::uint32_t, float>> stack{{root, 1.f}};
    while (!stack.empty()) {
        const auto [node, share] = stack.back();
        stack.pop_back();
        if (node < tree.leaves()) {
            cut.leafWeight[node] += weight * share;
            cut.nodeWeight[node] = std::max(cut.nodeWeight[node], weight);
            ++leaves;
            continue;
        }
        const std::uint32_t inner = node - tree.leaves();
        stack.emplace_back(tree.left[inner], share * tree.leftWeight[inner]);
        stack.emplace_back(tree.right[inner], share * (1 - tree.leftWeight[inner]));
    }
    return leaves;
}

LinkCut linkCut(const Bake& bake, std::uint32_t cache) {
    const Caches& caches = bake.caches;
    LinkCut cut;
    cut.cache = cache;
    cut.leafWeight.assign(bake.tree.leaves(), 0);
    cut.nodeWeight.assign(bake.tree.leaves(), 0);
    std::map<std::uint32_t, float> weights;
    for (std::uint32_t k = caches.linkBegin[cache]; k < caches.linkBegin[cache + 1]; ++k) {
        const LinkWeight link = linkWeight(caches, cache, k);
        weights[link.node] += link.transport;
        cut.total += double(link.transport);
    }
    for (const auto& [node, weight] : weights)
        cut.nodes.push_back({node, weight, addLeaves(bake.tree, node, weight, cut)});
    std::ranges::stable_sort(cut.nodes, std::greater{}, &LinkedNode::weight);
    if (!caches.fillBegin.empty())
        for (std::uint32_t k = caches.fillBegin[cache]; k < caches.fillBegin[cache + 1]; ++k)
            cut.filledFrom.emplace_back(caches.fillSource[k], caches.fillWeight[k]);
    return cut;
}

static std::optional<std::uint32_t> gridCacheAt(const Bake& bake, glm::vec3 position) {
    if (bake.gridSize.x == 0)
        return {};
    const glm::vec3 cells(bake.gridSize);
    const glm::vec3 x = (position - bake.gridBounds.lower) / bake.gridBounds.size() * cells;
    const glm::uvec3 c(glm::clamp(x, glm::vec3(0), cells - 1.f));
    const std::uint32_t cell = (c.z * bake.gridSize.y + c.y) * bake.gridSize.x + c.x;
    const auto begin = bake.caches.texel.begin() + bake.caches.lightmapCount;
    const auto found = std::find(begin, bake.caches.texel.end(), cell);
    if (found == bake.caches.texel.end())
        return {};
    return std::uint32_t(found - bake.caches.texel.begin());
}

std::optional<std::uint32_t> cacheAt(const Bake& bake, const Scene& scene, const Hit& hit) {
    const LightmapLayout& layout = bake.lightmap;
    if (hit.instance >= layout.instances.size() || layout.instances[hit.instance].uv.empty())
        return gridCacheAt(bake, hit.position);
    const Bilinear b = bilinearAt(layout, scene, hit);
    const auto strongest = std::max_element(b.weight, b.weight + 4) - b.weight;
    const auto end = bake.caches.texel.begin() + bake.caches.lightmapCount;
    const auto found = std::find(bake.caches.texel.begin(), end, b.texel[strongest]);
    if (found == end)
        return {};
    return std::uint32_t(found - bake.caches.texel.begin());
}

} // namespace limn
