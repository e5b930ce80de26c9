// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/scene_changes.h"

#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace limn {

namespace {

bool sameSurface(const Material& a, const Material& b) {
    return a.alphaMode == b.alphaMode && a.alphaCutoff == b.alphaCutoff &&
           a.doubleSided == b.doubleSided && a.baseColor.w == b.baseColor.w &&
           a.baseColorTexture == b.baseColorTexture && isGlassSheet(a) == isGlassSheet(b);
}

bool sameBakedMaterial(const Material& a, const Material& b) {
    return sameSurface(a, b) && emits(a) == emits(b);
}

bool sameObject(const Instance& a, const Instance& b) {
    return a.mesh == b.mesh && a.material == b.material && a.node == b.node &&
           a.dynamic == b.dynamic;
}

bool sameInstance(const Instance& a, const Instance& b) {
    return sameObject(a, b) && a.toWorld == b.toWorld;
}

bool sameBakedInstance(const Instance& a, const Instance& b) {
    return sameObject(a, b) &&
           (a.dynamic || (a.toWorld == b.toWorld && a.texelDensity == b.texelDensity));
}

/// What changed, each once, in the order found. Only the first few are kept as text.
struct ChangeList {
    std::vector<std::string> named;
    std::size_t count = 0;

    void add(const std::string& name, std::string_view what) {
        if (++count <= 3)
            named.push_back(fmt::format("{} {}", name.empty() ? "(no name)" : name, what));
    }
    std::string text() const {
        std::string all = fmt::format("{}", fmt::join(named, ", "));
        if (count > named.size())
            all += fmt::format(", and {} more", count - named.size());
        return all;
    }
};

std::string nameIn(const Document& document, ObjectId id) {
    const auto it = document.objects.find(id);
    return it == document.objects.end() ? std::string() : objectName(it->second);
}

/// How an instance that is in both scenes differs; empty: not at all.
std::string_view difference(const Instance& baked, const Instance& now) {
    if (baked.dynamic != now.dynamic)
        return now.dynamic ? "became dynamic" : "became static";
    if (baked.material != now.material)
        return "has another material";
    if (!now.dynamic && baked.texelDensity != now.texelDensity)
        return "has another texel density";
    return sameBakedInstance(baked, now) ? "" : "moved";
}

void addObjects(const Scene& baked, const Scene& now, const Document& document, ChangeList& list) {
    std::map<std::pair<ObjectId, std::uint32_t>, const Instance*> before;
    for (const Instance& instance : baked.instances)
        before.emplace(std::pair(instance.node, instance.mesh), &instance);
    ObjectId named = 0; // a node of many meshes is one object
    for (const Instance& instance : now.instances) {
        const auto found = before.find({instance.node, instance.mesh});
        const std::string_view what =
            found == before.end() ? "was added or shown" : difference(*found->second, instance);
        if (found != before.end())
            before.erase(found);
        if (!what.empty() && instance.node != named)
            list.add(nameIn(document, named = instance.node), what);
    }
    named = 0;
    for (const auto& [key, instance] : before)
        if (key.first != named) {
            named = key.first;
            if (document.objects.contains(named))
                list.add(nameIn(document, named), "was hidden");
            else
                list.add("An object", "was deleted");
        }
}

void addSettings(const BakeSettings& baked, const BakeSettings& now, ChangeList& list) {
    visitBakeSettings(now, [&](const Setting& setting, const auto& value, const auto&...) {
        visitBakeSettings(baked, [&](const Setting& other, const auto& before, const auto&...) {
            if constexpr (std::is_same_v<decltype(value), decltype(before)>)
                if (setting.invalidates == Invalidates::Bake &&
                    std::string_view(setting.key) == other.key && !(value == before))
                    list.add(setting.label, "changed");
        });
    });
}

/// Calls visit(setting, before, now) for each setting of what `now` precomputes with.
template <class Visit>
void visitPrecomputed(const TechniqueChoice& before, const TechniqueChoice& now, Visit visit) {
    for (const TechniqueSetting& setting : precomputingTechnique(now).settings)
        if (setting.setting.invalidates == Invalidates::Bake)
            visit(setting.setting, settingOf(before, setting), settingOf(now, setting));
}

/// Whether both choices precompute the same, with the same settings.
bool samePrecomputation(const TechniqueChoice& a, const TechniqueChoice& b) {
    bool same = &precomputingTechnique(a) == &precomputingTechnique(b);
    visitPrecomputed(
        a, b, [&](const Setting&, double before, double now) { same = same && before == now; });
    return same;
}

} // namespace

bool sameGeometry(const Scene& a, const Scene& b) {
    return a.assets == b.assets && std::ranges::equal(a.instances, b.instances, sameInstance) &&
           std::ranges::equal(a.materials, b.materials, sameSurface);
}

bool sameStaticGeometry(const Scene& a, const Scene& b) {
    return a.assets == b.assets &&
           std::ranges::equal(a.instances, b.instances, sameBakedInstance) &&
           std::ranges::equal(a.materials, b.materials, sameSurface);
}

bool sameInstanceList(const Scene& a, const Scene& b) {
    return std::ranges::equal(a.instances, b.instances, [](const Instance& x, const Instance& y) {
        return x.mesh == y.mesh && x.node == y.node;
    });
}

bool sameLight(const Scene& a, const Scene& b) {
    return a.lights == b.lights && a.materials == b.materials && a.sky == b.sky;
}

bool sameBakeInputs(const Scene& a, const Scene& b) {
    return sameStaticGeometry(a, b) && a.bake == b.bake &&
           std::ranges::equal(a.materials, b.materials, sameBakedMaterial) &&
           samePrecomputation(a.technique, b.technique);
}

std::string bakeInputChanges(const Scene& baked, const Scene& now, const Document& document) {
    ChangeList list;
    if (baked.assets != now.assets)
        list.add("The scene's file", "changed");
    addObjects(baked, now, document, list);
    for (std::size_t m = 0; m < std::min(baked.materials.size(), now.materials.size()); ++m)
        if (!sameBakedMaterial(baked.materials[m], now.materials[m]))
            list.add(now.materials[m].name,
                     emits(baked.materials[m]) != emits(now.materials[m])
                         ? (emits(now.materials[m]) ? "emits light now" : "emits no light now")
                         : "has other holes or sides");
    addSettings(baked.bake, now.bake, list);
    if (&precomputingTechnique(baked.technique) != &precomputingTechnique(now.technique))
        list.add("The technique", "changed");
    else
        visitPrecomputed(baked.technique, now.technique,
                         [&](const Setting& setting, double before, double after) {
                             if (before != after)
                                 list.add(setting.label, "changed");
                         });
    return list.text();
}

} // namespace limn
