// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/minimise.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

Material plainMaterial(const Material& m) {
    return {.name = m.name, .baseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1)};
}

class Minimiser {
public:
    Minimiser(const StressCase& failing, const Oracle& oracle, const std::string& folder,
              const MinimiseLimits& limits)
        : m_best(failing), m_oracles{oracle}, m_limits(limits), m_case{limits.caseSeconds, folder} {
    }

    StressCase run() {
        if (!fails(m_best))
            return m_best;
        bool smaller = true;
        while (smaller && timeLeft()) {
            smaller = dropObjects<Node>();
            smaller |= dropObjects<Light>();
            smaller |= dropTriangles();
            smaller |= makePlain();
        }
        m_best.description = fmt::format("minimised from: {}", m_best.description);
        return m_best;
    }

private:
    using Clock = std::chrono::steady_clock;

    bool timeLeft() const {
        const std::chrono::duration<double> gone = Clock::now() - m_start;
        return m_tries < m_limits.tries && gone.count() < m_limits.seconds;
    }
    bool fails(const StressCase& c) {
        ++m_tries;
        return runCase(c, m_oracles, m_case).judgements[0].failed();
    }
    bool keep(StressCase c) {
        if (!timeLeft() || !fails(c))
            return false;
        m_best = std::move(c);
        return true;
    }

    /// Drops objects in halves first, then in quarters, down to single ones.
    template <class T>
    bool dropObjects() {
        bool dropped = false;
        std::vector<ObjectId> ids;
        for (const auto& [id, object] : m_best.document.objects)
            if (std::holds_alternative<T>(object))
                ids.push_back(id);
        for (std::size_t chunk = ids.size(); chunk > 0; chunk /= 2)
            for (std::size_t first = 0; first < ids.size();) {
                StressCase c = m_best;
                const std::size_t end = std::min(first + chunk, ids.size());
                for (std::size_t k = first; k < end; ++k)
                    c.document.objects.erase(ids[k]);
                if (keep(std::move(c))) {
                    ids.erase(ids.begin() + std::ptrdiff_t(first),
                              ids.begin() + std::ptrdiff_t(end));
                    dropped = true;
                } else {
                    first = end;
                }
            }
        return dropped;
    }

    bool dropTriangles() {
        bool dropped = false;
        for (std::size_t m = 0; m < m_best.assets->meshes.size(); ++m)
            for (std::size_t chunk = m_best.assets->meshes[m].triangleCount(); chunk > 0;
                 chunk /= 2)
                for (std::size_t first = 0;
                     first < m_best.assets->meshes[m].triangleCount() && timeLeft();) {
                    StressCase c = m_best;
                    auto assets = std::make_shared<Assets>(*c.assets);
                    auto& indices = assets->meshes[m].indices;
                    const std::size_t end = std::min(first + chunk, indices.size() / 3);
                    indices.erase(indices.begin() + std::ptrdiff_t(3 * first),
                                  indices.begin() + std::ptrdiff_t(3 * end));
                    c.assets = std::move(assets);
                    if (keep(std::move(c)))
                        dropped = true;
                    else
                        first = end;
                }
        return dropped;
    }

    /// Resets each value that is not plain, one at a time.
    bool makePlain() {
        bool changed = false;
        for (const auto& [id, object] : Document(m_best.document).objects)
            changed |=
                std::visit([&, key = id](const auto& o) { return makePlain(key, o); }, object);
        return changed;
    }
    template <class T>
    bool tryWith(ObjectId id, const std::function<void(T&)>& change) {
        T now = std::get<T>(m_best.document.objects.at(id));
        const T before = now;
        change(now);
        if (now == before)
            return false;
        StressCase c = m_best;
        c.document.objects[id] = now;
        return keep(std::move(c));
    }
    template <class T>
    bool tryAll(ObjectId id, std::initializer_list<std::function<void(T&)>> changes) {
        bool changed = false;
        for (const auto& change : changes)
            changed |= tryWith<T>(id, change);
        return changed;
    }
    bool makePlain(ObjectId id, const Node&) {
        return tryAll<Node>(id, {[](Node& n) { n.dynamic = false; },
                                 [](Node& n) {
                                     n.transform.rotation = {1, 0, 0, 0};
                                 },
                                 [](Node& n) { n.transform.scale = glm::vec3(1); },
                                 [](Node& n) { n.transform.translation = glm::vec3(0); }});
    }
    bool makePlain(ObjectId id, const Material&) {
        return tryAll<Material>(
            id,
            {[](Material& m) { m = plainMaterial(m); }, [](Material& m) { m.metallic = 0; },
             [](Material& m) { m.roughness = 1; }, [](Material& m) { m.emission = glm::vec3(0); },
             [](Material& m) { m.doubleSided = false; },
             [](Material& m) { m.transmission = 0, m.ior = Material{}.ior, m.thickness = 0; },
             [](Material& m) { m.alphaMode = AlphaMode::Opaque; },
             [](Material& m) { m.baseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1); }});
    }
    bool makePlain(ObjectId id, const Light&) {
        return tryAll<Light>(id, {[](Light& l) { l.color = glm::vec3(1); },
                                  [](Light& l) { l.strength = 1; }, [](Light& l) { l.range = 0; },
                                  [](Light& l) { l.roll = 0; }});
    }
    bool makePlain(ObjectId, const Camera&) { return false; }
    bool makePlain(ObjectId, const TechniqueChoice&) { return false; }
    bool makePlain(ObjectId, const ExportSettings&) { return false; }
    bool makePlain(ObjectId id, const Sky&) {
        return tryAll<Sky>(id, {[](Sky& s) { s = {}; },
                                [](Sky& s) {
                                    s = s.radiance == glm::vec3(0) ? Sky{}
                                                                   : Sky{.radiance = glm::vec3(1)};
                                }});
    }
    bool makePlain(ObjectId id, const RelightSettings&) {
        return tryAll<RelightSettings>(id, {[](RelightSettings& s) { s.maxBounces = 1; },
                                            [](RelightSettings& s) { s.dynamicOcclusion = true; }});
    }
    bool makePlain(ObjectId id, const BakeSettings&) {
        static const BakeSettings plain;
        return tryAll<BakeSettings>(
            id,
            {[](BakeSettings& s) { s.bands = plain.bands; },
             [](BakeSettings& s) { s.chromaBands = plain.chromaBands; },
             [](BakeSettings& s) { s.texelsPerMetre = 0; },
             [](BakeSettings& s) { s.grid = plain.grid; },
             [](BakeSettings& s) { s.placement = plain.placement; },
             [](BakeSettings& s) { s.linker = plain.linker; },
             [](BakeSettings& s) { s.cut = plain.cut; },
             [](BakeSettings& s) { s.storage = plain.storage; },
             [](BakeSettings& s) { s.clustering = plain.clustering; },
             [](BakeSettings& s) { s.clusterNormalWeight = plain.clusterNormalWeight; },
             [](BakeSettings& s) { s.clusterBalanceWeight = plain.clusterBalanceWeight; },
             [](BakeSettings& s) { s.links = 4096; }, [](BakeSettings& s) { s.surfels = 64; },
             [](BakeSettings& s) { s.rays = 64; }, [](BakeSettings& s) { s.lightmapCaches = 64; }});
    }

    StressCase m_best;
    std::vector<Oracle> m_oracles;
    MinimiseLimits m_limits;
    CaseLimits m_case;
    int m_tries = 0;
    Clock::time_point m_start = Clock::now();
};

} // namespace

StressCase minimised(const StressCase& failing, const Oracle& oracle, const std::string& folder,
                     const MinimiseLimits& limits) {
    return Minimiser(failing, oracle, folder, limits).run();
}

} // namespace limn
