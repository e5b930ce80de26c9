// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/dependencies.h"

#include "engine/math/luminance.h"
#include "engine/math/sh.h"
#include "engine/overlay/palette.h"
#include "engine/techniques/illuminance/format/link_storage.h"
#include "engine/techniques/illuminance/overlay/texel_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <string>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr double kSmallestShare = 1e-3; // of the colours
constexpr std::size_t kNamed = 8;       // objects that are listed

const glm::vec3 kNothing(0.25f, 0.25f, 0.27f);

/// First chart of each instance as TexelUse counts them, and their sum.
std::vector<std::uint32_t> firstCharts(const LightmapLayout& layout, const Scene& scene) {
    std::vector<std::uint32_t> first = {0};
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const bool lightmapped = i < layout.instances.size() && !layout.instances[i].uv.empty();
        const std::size_t charts =
            lightmapped ? layout.meshes[scene.instances[i].mesh].chartSize.size() : 0;
        first.push_back(first.back() + std::uint32_t(charts));
    }
    return first;
}

/// Caches of an object, with weights that sum to 1.
struct ObjectCaches {
    std::uint32_t instance = ~0u;
    std::vector<std::pair<std::uint32_t, double>> caches;
};

ObjectCaches cachesOfObject(const Bake& bake, const Scene& scene, std::uint32_t cache) {
    const Caches& caches = bake.caches;
    ObjectCaches out{.instance = ~0u, .caches = {{cache, 1.}}};
    if (caches.kind[cache] == CacheKind::Grid)
        return out;
    const TexelUse use = texelUse(bake.lightmap, scene);
    const std::uint32_t chart = use.chart[caches.texel[cache]];
    if (chart == ~0u)
        return out; // a surfel cache, which only surfels read
    const std::vector<std::uint32_t> first = firstCharts(bake.lightmap, scene);
    const auto after = std::ranges::upper_bound(first, chart);
    out.instance = std::uint32_t(after - first.begin()) - 1;
    out.caches.clear();
    double sum = 0;
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c) {
        const std::uint32_t texel = caches.texel[c];
        if (use.chart[texel] == ~0u || use.chart[texel] < *(after - 1) ||
            use.chart[texel] >= *after || !(use.density[texel] > 0))
            continue;
        const double area = 1 / (double(use.density[texel]) * double(use.density[texel]));
        out.caches.emplace_back(c, area);
        sum += area;
    }
    for (auto& [c, weight] : out.caches)
        weight /= sum;
    return out;
}

/// Irradiance of the caches' links at unit radiosity.
class LinkIrradiance {
public:
    explicit LinkIrradiance(const Bake& bake)
        : m_caches(bake.caches), m_bands(std::min(int(bake.settings.bands), kIrradianceBands)) {}

    /// Adds the irradiance that every link of `cache` brings to a surface that faces `normal`, or,
    /// without a normal, to one that faces everywhere.
    void add(std::uint32_t cache, glm::vec3 normal, double weight, std::vector<double>& sum) const {
        std::array<float, kIrradianceBands * kIrradianceBands> basis{}, link{};
        const std::array<float, kMaxBands> factors = irradianceFactors();
        const bool sided = normal != glm::vec3(0);
        if (sided)
            shBasis(m_bands, normal, basis.data());
        for (std::uint32_t k = m_caches.linkBegin[cache]; k < m_caches.linkBegin[cache + 1]; ++k) {
            const LinkWeight sender = linkWeight(m_caches, cache, k);
            double irradiance = double(sender.transport) / 4; // the mean over all normals
            if (sided) {
                expandLink(m_caches, cache, k, m_bands, link.data());
                irradiance = 0;
                for (int l = 0, i = 0; l < m_bands; ++l)
                    for (; i < (l + 1) * (l + 1); ++i)
                        irradiance += double(factors[std::size_t(l)] * basis[std::size_t(i)] *
                                             link[std::size_t(i)]);
            }
            sum[sender.node] += weight * irradiance;
        }
    }

private:
    const Caches& m_caches;
    int m_bands;
};

/// Irradiance of the object at unit radiosity of each node of the tree, spread down to the leaves.
std::vector<double> transportTo(const Bake& bake, const ObjectCaches& object) {
    const Caches& caches = bake.caches;
    const ClusterTree& tree = bake.tree;
    const LinkIrradiance links(bake);
    std::vector<double> transport(tree.size());
    for (const auto& [cache, weight] : object.caches) {
        const glm::vec3 normal = caches.normal[cache];
        links.add(cache, normal, weight, transport);
        if (isValid(caches, cache) || caches.fillBegin.empty())
            continue;
        for (std::uint32_t k = caches.fillBegin[cache]; k < caches.fillBegin[cache + 1]; ++k)
            links.add(caches.fillSource[k], normal, weight * double(caches.fillWeight[k]),
                      transport);
    }
    for (std::uint32_t n = tree.size(); n-- > tree.leaves();) { // parents come after children
        const std::uint32_t inner = n - tree.leaves();
        const auto left = double(tree.leftWeight[inner]);
        transport[tree.left[inner]] += transport[n] * left;
        transport[tree.right[inner]] += transport[n] * (1 - left);
    }
    return transport;
}

std::string nameOf(const Scene& scene, std::uint32_t instance) {
    const std::string& name = scene.meshOf(scene.instances[instance]).name;
    return name.empty() ? fmt::format("instance {}", instance) : name;
}

/// The strongest senders by name.
std::vector<std::string> strongest(const Dependencies& dependencies, const Scene& scene) {
    std::vector<std::uint32_t> order(dependencies.sent.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, std::greater<>(),
                             [&](std::uint32_t i) { return dependencies.sent[i]; });
    std::erase_if(order, [&](std::uint32_t i) { return !(dependencies.sent[i] > 0); });
    std::vector<std::string> lines;
    const auto share = [&](double sent) { return 100 * sent / dependencies.total; };
    if (dependencies.sky > 0)
        lines.push_back(fmt::format("{:.1f} %  the sky", share(dependencies.sky)));
    for (std::size_t k = 0; k < std::min(order.size(), kNamed); ++k)
        lines.push_back(fmt::format("{:.1f} %  {}{}", share(dependencies.sent[order[k]]),
                                    nameOf(scene, order[k]),
                                    order[k] == dependencies.instance ? " (itself)" : ""));
    if (order.size() > kNamed)
        lines.push_back(fmt::format("and {} more", order.size() - kNamed));
    return lines;
}

OverlayLegend legendOf(const Dependencies& dependencies, const Scene& scene) {
    OverlayLegend legend;
    legend.title = dependencies.instance == ~0u
                       ? std::string("What lights this place")
                       : fmt::format("What lights {}", nameOf(scene, dependencies.instance));
    if (!(dependencies.total > 0)) {
        legend.notes = {"No bounced light reaches it"};
        return legend;
    }
    for (const double share : {1., 0.1, 0.01, kSmallestShare}) {
        const double t = 1 - std::log(share) / std::log(kSmallestShare);
        legend.entries.push_back({packColor(viridis(float(t))),
                                  fmt::format("object that sends {:g} % of it", 100 * share)});
    }
    legend.entries.push_back({packColor(kNothing), "object that sends it nothing"});
    legend.notes = {fmt::format("{:.3g} lux of bounced light on average:", dependencies.total)};
    std::ranges::move(strongest(dependencies, scene), std::back_inserter(legend.notes));
    return legend;
}

} // namespace

Dependencies dependenciesOf(const Bake& bake, const Scene& scene,
                            const std::vector<glm::vec4>& radiosity, std::uint32_t cache) {
    const ObjectCaches object = cachesOfObject(bake, scene, cache);
    const std::vector<double> transport = transportTo(bake, object);
    Dependencies out{.instance = object.instance,
                     .sent = std::vector<double>(scene.instances.size())};
    for (std::uint32_t leaf = 0; leaf < bake.tree.leaves(); ++leaf) {
        const double light = transport[leaf] * double(luminance(glm::vec3(radiosity[leaf])));
        (leaf < bake.tree.surfels ? out.sent[bake.surfels.instance[leaf]] : out.sky) += light;
        out.total += light;
    }
    return out;
}

OverlayData dependencyOverlay(const Bake& bake, const Scene& scene, const OverlayOptions& options,
                              const LitBake& lit) {
    OverlayData out;
    if (options.cache >= bake.caches.size()) {
        out.legend = {"Dependencies", {}, {"No object picked: click one"}};
        return out;
    }
    const Dependencies dependencies = dependenciesOf(bake, scene, lit.radiosity, options.cache);
    std::vector<glm::vec3> ofInstance;
    for (const double sent : dependencies.sent) {
        const double t =
            sent > 0 ? 1 - std::log(sent / dependencies.total) / std::log(kSmallestShare) : -1;
        ofInstance.push_back(sent > 0 ? viridis(float(std::clamp(t, 0., 1.))) : kNothing);
    }
    std::vector<glm::vec3> colors;
    for (const std::uint32_t instance : bake.surfels.instance)
        colors.push_back(ofInstance[instance]);
    out.marks = surfelMarks(bake.surfels, colors);
    out.legend = legendOf(dependencies, scene);
    return out;
}

} // namespace limn
