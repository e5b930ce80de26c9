// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>

namespace limn {

/// Valid documents with numbers from all over float's range.
class RandomDocument {
public:
    explicit RandomDocument(unsigned seed) : m_random(seed) {}

    Document make() {
        Document document;
        document.scenePath = text();
        document.sceneHash = (std::uint64_t(m_random()) << 32) | m_random();
        std::vector<ObjectId> nodes = {0};
        for (unsigned i = below(20); i > 0; --i) {
            document.nextId += below(3); // gaps, as deleting leaves them
            if (below(2))
                nodes.push_back(addObject(document, node(nodes[below(unsigned(nodes.size()))])));
            else
                addObject(document, other());
        }
        return document;
    }

private:
    unsigned below(unsigned count) { return unsigned(m_random()) % count; }
    bool coin() { return below(2) == 1; }
    float number() {
        using Limits = std::numeric_limits<float>;
        static constexpr float kExtremes[] = {0.f,           -0.f,
                                              Limits::max(), Limits::lowest(),
                                              Limits::min(), Limits::denorm_min(),
                                              1 / 3.f,       16777217.f,
                                              1e-7f};
        if (below(3) == 0)
            return kExtremes[below(unsigned(std::size(kExtremes)))];
        const float sign = coin() ? 1.f : -1.f;
        return sign * std::ldexp(1 + unit(), int(below(250)) - 125);
    }
    float notNegative() { return std::abs(number()); }
    float unit() { return float(m_random() & 0xffffff) / float(0xffffff); }
    glm::vec3 vec3() { return {number(), number(), number()}; }
    float light() { return std::min(notNegative(), kMaxLight); }
    glm::vec3 color() { return {light(), light(), light()}; }
    glm::vec3 direction() {
        glm::vec3 d{unit() - 0.5f, unit() - 0.5f, unit() + 0.01f};
        return glm::normalize(d);
    }
    std::string text() {
        static const char* const kTexts[] = {"",
                                             "Sponza",
                                             "a \"quoted\" \\ name",
                                             "Ω ünïcode 木",
                                             "line\nbreak\ttab",
                                             "../up/and down.gltf",
                                             "null"};
        return kTexts[below(unsigned(std::size(kTexts)))];
    }
    Node node(ObjectId parent) {
        Node n;
        n.name = text();
        n.parent = parent;
        n.transform.translation = vec3();
        n.transform.rotation = glm::angleAxis(unit() * 6, direction());
        for (int c = 0; c < 3; ++c)
            n.transform.scale[c] = number() == 0 ? -1 : std::copysign(0.5f + unit(), number());
        for (unsigned i = below(4); i > 0; --i)
            n.meshes.push_back(std::uint32_t(m_random()));
        n.visible = coin();
        n.dynamic = coin();
        n.texelDensity = 0.5f + unit();
        return n;
    }
    TextureRef texture() {
        TextureRef t;
        t.image = int(below(10)) - 1;
        t.texCoord = below(2);
        t.offset = {number(), number()};
        t.scale = {number(), number()};
        t.rotation = number();
        t.wrapU = Wrap(below(3));
        t.wrapV = Wrap(below(3));
        t.nearest = coin();
        return t;
    }
    ProfileRef profile() {
        LightProfile p;
        p.name = text();
        p.peak = std::max(light(), 1e-30f);
        p.firstVertical = 90 * unit();
        p.lastVertical = 91 + 89 * unit();
        p.rows = 2 + below(4);
        p.columns = 1 + below(4);
        for (std::uint32_t i = 0; i < p.rows * p.columns; ++i)
            p.share.push_back(unit());
        return {std::make_shared<const LightProfile>(std::move(p))};
    }
    Object other() {
        switch (below(7)) {
        case 0: {
            Material m;
            m.name = text();
            m.baseColor = {unit(), unit(), unit(), unit()};
            m.metallic = unit();
            m.roughness = unit();
            m.emission = color();
            m.alphaMode = AlphaMode(below(3));
            m.alphaCutoff = notNegative();
            m.doubleSided = coin();
            m.normalScale = number();
            m.transmission = unit();
            m.ior = std::max(1.f, notNegative());
            m.thickness = notNegative();
            m.baseColorTexture = texture();
            m.metallicRoughnessTexture = texture();
            m.normalTexture = texture();
            m.emissiveTexture = texture();
            m.emissiveFlipbook = {1 + below(256), 1 + below(256), 1000 * unit()};
            return m;
        }
        case 1: {
            Light l;
            l.name = text();
            l.kind = LightKind(below(4));
            l.enabled = coin();
            l.position = vec3();
            l.direction = direction();
            l.color = color();
            l.strength = light();
            l.range = notNegative();
            l.innerAngle = unit() * 0.7f;
            l.outerAngle = 0.71f + unit() * 0.8f;
            l.size = {0.001f + unit(), 1e6f * (0.001f + 0.99f * unit())};
            l.roll = number();
            if (below(4) == 0)
                l.profile = profile();
            return l;
        }
        case 2: {
            Camera c;
            c.name = text();
            c.eye = vec3();
            c.target = c.eye == glm::vec3(1) ? glm::vec3(2) : glm::vec3(1);
            c.up = direction();
            c.fovY = 0.01f + unit() * 3;
            return c;
        }
        case 3:
            return Sky{SkyKind(below(3)), color(), color(), color(), text(), light(), number()};
        case 4:
            return TechniqueChoice{text(), {{text(), number()}, {"radiance", unit()}}};
        case 5:
            return RelightSettings{.maxBounces = 1 + below(10000), .dynamicOcclusion = coin()};
        default: {
            BakeSettings b;
            b.surfels = 64 + below(1000000);
            b.links = 1 + below(4096);
            b.bands = 2 + below(7);
            b.rays = 16 + below(65000);
            b.lightmapCaches = 1 + below(1 << 24);
            b.texelsPerMetre = 1e6f * unit();
            b.grid = {below(100), below(100), below(100)};
            b.placement = SurfelPlacement(below(3));
            b.linker = Linker(below(2));
            b.cut = CutCriterion(below(2));
            b.storage = LinkStorage(below(2));
            b.chromaBands = below(9);
            b.clustering = Clustering(below(2));
            b.clusterNormalWeight = unit();
            b.clusterBalanceWeight = unit();
            return b;
        }
        }
    }

    std::mt19937 m_random;
};

} // namespace limn
