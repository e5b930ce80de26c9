// SPDX-License-Identifier: MIT
#include "engine/runtime/limn_runtime.h"

#include "engine/runtime/direct_light.h"
#include "engine/runtime/scene.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace limn::runtime;

namespace {

/// Shares out a block in two passes: the first, without a block, only adds up the sizes.
struct Arena {
    char* block = nullptr;
    std::uint64_t used = 0;

    template <class T>
    void take(T*& array, std::uint64_t count) {
        used = (used + 63) & ~std::uint64_t(63);
        if (block)
            array = reinterpret_cast<T*>(block + used);
        used += count * sizeof(T);
    }
};

void takeKept(limnrt_scene& s, Arena& arena) {
    const std::uint64_t slots = s.options.max_kept, caches = s.view.dims.caches,
                        values = 3 * caches * s.coefficients();
    float* scales = nullptr;
    std::int16_t* numbers = nullptr;
    arena.take(s.kept, slots);
    arena.take(scales, slots * caches);
    arena.take(numbers, slots * values);
    for (std::size_t k = 0; arena.block && k < slots; ++k)
        s.kept[k] = {false, scales + k * caches, numbers + k * values};
}

void takeArrays(limnrt_scene& s, Arena& arena) {
    const Dims& d = s.view.dims;
    const std::uint64_t surfels = d.surfels, maxLights = s.options.max_lights;
    limnrt_scene* self = nullptr;
    arena.take(self, 1);
    arena.take(s.albedo, surfels);
    arena.take(s.emitted, surfels);
    arena.take(s.direct, surfels);
    arena.take(s.indirect, surfels);
    arena.take(s.radiosity, d.nodes());
    arena.take(s.sh, d.caches * std::uint64_t(s.coefficients()));
    arena.take(s.cacheIrradiance, d.lightmapCaches);
    for (std::uint32_t k = 0; k < Extrapolation::kKept; ++k) {
        arena.take(s.ahead.change[k], surfels);
        arena.take(s.ahead.after[k], surfels);
    }
    arena.take(s.seenShare, surfels);
    arena.take(s.surfelBasis, surfels * s.inner.luma * s.inner.luma);
    arena.take(s.endBeforeSky, d.caches);
    arena.take(s.linkEnd, d.caches);
    arena.take(s.read, d.caches);
    arena.take(s.lights, maxLights);
    arena.take(s.slots, maxLights);
    arena.take(s.slotOf, maxLights);
    takeKept(s, arena);
    float* shares = nullptr;
    arena.take(shares, surfels * maxLights);
    for (std::size_t k = 0; arena.block && k < maxLights; ++k)
        s.slots[k].share = shares + k * surfels;
}

limnrt_scene* refuse(const char* what, char* error, std::size_t size) {
    if (error && size > 0)
        std::snprintf(error, size, "%s", what);
    return nullptr;
}

/// Fills in the defaults. Returns what is wrong with them.
const char* takeOptions(const limnrt_options* given, limnrt_scene& s) {
    constexpr std::uint32_t kMaxLights = 4096, kMaxKept = 4096;
    s.options = given ? *given : limnrt_options{};
    const Dims& d = s.view.dims;
    if (!s.options.allocate != !s.options.release)
        return "options: allocate and release go together";
    if (s.options.bands == 0)
        s.options.bands = d.bands;
    if (s.options.bands < 2 || s.options.bands > d.bands)
        return "options: bands out of range";
    if (s.options.max_lights == 0)
        s.options.max_lights = std::max(16U, d.lights);
    if (s.options.max_lights > kMaxLights || s.options.max_lights < d.lights)
        return "options: max_lights out of range";
    if (s.options.max_kept > kMaxKept)
        return "options: max_kept out of range";
    s.results = {s.options.bands, std::min(d.chromaBands, s.options.bands)};
    s.inner.luma = std::min(s.options.bands, kIrradianceBands);
    // Without colour in the second band every bounce would make the light greyer.
    s.inner.chroma = std::min(std::max(d.chromaBands, 2U), s.inner.luma);
    return nullptr;
}

void changed(limnrt_scene& s, bool sky = false) {
    s.convergence.lightChanged(sky);
    s.ahead.clear();
}

} // namespace

limnrt_scene* limnrt_open(const void* bytes, size_t size, const limnrt_options* options,
                          char* error, size_t error_size) {
    limnrt_scene s{};
    const bool skip = options && (options->flags & LIMNRT_SKIP_HASHES) != 0;
    if (!viewTransport(bytes, size, skip, s.view, {error, error ? error_size : 0}))
        return nullptr;
    if (const char* defect = takeOptions(options, s))
        return refuse(defect, error, error_size);
    Arena sizes;
    takeArrays(s, sizes);
    constexpr std::size_t kAlign = 64;
    if (sizes.used > SIZE_MAX - kAlign - sizeof(void*))
        return refuse("too large for this machine's memory", error, error_size);
    const auto needed = std::size_t(sizes.used) + kAlign + sizeof(void*);
    void* const block =
        s.options.allocate ? s.options.allocate(needed, s.options.user) : std::malloc(needed);
    if (!block)
        return refuse("out of memory", error, error_size);
    std::memset(block, 0, needed);
    Arena arena;
    const auto start = reinterpret_cast<std::uintptr_t>(block) + sizeof(void*);
    arena.block = static_cast<char*>(block) + sizeof(void*) + (kAlign - start % kAlign) % kAlign;
    std::memcpy(arena.block - sizeof(void*), &block, sizeof block);
    takeArrays(s, arena);
    s.memory = needed;
    auto* scene = new (arena.block) limnrt_scene(s);
    prepare(*scene);
    takeSky(*scene, scene->view.skyRadiance);
    limnrt_set_lights(scene, scene->view.lights, scene->view.dims.lights);
    changed(*scene, true);
    return scene;
}

void limnrt_close(limnrt_scene* s) {
    if (!s)
        return;
    void* block = nullptr;
    std::memcpy(&block, reinterpret_cast<char*>(s) - sizeof(void*), sizeof block);
    if (s->options.release)
        s->options.release(block, s->options.user);
    else
        std::free(block);
}

int limnrt_set_lights(limnrt_scene* s, const limnrt_light* lights, uint32_t count) {
    if (count > s->options.max_lights || (count > 0 && !lights) ||
        !std::all_of(lights, lights + count, isLight))
        return 0;
    if (!s->ownDirect && count == s->lightCount &&
        (count == 0 || std::memcmp(lights, s->lights, count * sizeof *lights) == 0))
        return 1;
    std::copy(lights, lights + count, s->lights);
    s->lightCount = count;
    s->ownDirect = false;
    takeLights(*s);
    changed(*s);
    return 1;
}

int limnrt_set_direct(limnrt_scene* s, const float* rgb) {
    const std::size_t surfels = s->view.dims.surfels;
    if (!finiteWithin(rgb, 3 * surfels, 0, kMaxIrradiance))
        return 0;
    for (std::size_t k = 0; k < surfels; ++k)
        s->direct[k] = load3(rgb + 3 * k);
    s->ownDirect = true;
    changed(*s);
    return 1;
}

int limnrt_set_albedo(limnrt_scene* s, uint32_t first, uint32_t count, const float* rgb) {
    const std::uint32_t surfels = s->view.dims.surfels;
    if (first > surfels || count > surfels - first ||
        !finiteWithin(rgb, 3 * std::size_t(count), 0, kMaxAlbedo))
        return 0;
    for (std::size_t k = 0; k < count; ++k)
        s->albedo[first + k] = load3(rgb + 3 * k);
    changed(*s);
    return 1;
}

int limnrt_set_emission(limnrt_scene* s, uint32_t first, uint32_t count, const float* rgb) {
    const std::uint32_t surfels = s->view.dims.surfels;
    if (first > surfels || count > surfels - first ||
        !finiteWithin(rgb, 3 * std::size_t(count), 0, kMaxLight))
        return 0;
    for (std::size_t k = 0; k < count; ++k)
        s->emitted[first + k] = load3(rgb + 3 * k) * splat(kPi);
    changed(*s);
    return 1;
}

/// Sets `values` of a material's surfels to scale * min(rgb times `file`, maximum); `file` 0: to
/// rgb.
static int setMaterial(limnrt_scene* s, std::uint32_t material, const float* rgb, float limit,
                       const float* file, float maximum, float scale, F4* values) {
    if (material >= s->view.dims.materials || !finiteWithin(rgb, 3, 0, limit))
        return 0;
    const F4 value = load3(rgb), end = splat(maximum);
    for (std::size_t k = 0; k < s->view.dims.surfels; ++k)
        if (s->view.surfelMaterial[k] == material) {
            const F4 product = file ? value * load3(file + 3 * k) : value;
            values[k] = (product < end ? product : end) * splat(scale);
        }
    changed(*s);
    return 1;
}

int limnrt_set_material_albedo(limnrt_scene* s, uint32_t material, const float rgb[3]) {
    return setMaterial(s, material, rgb, kMaxAlbedo, nullptr, kMaxAlbedo, 1, s->albedo);
}
int limnrt_set_material_emission(limnrt_scene* s, uint32_t material, const float rgb[3]) {
    return setMaterial(s, material, rgb, kMaxLight, nullptr, kMaxLight, kPi, s->emitted);
}
int limnrt_scale_material_albedo(limnrt_scene* s, uint32_t material, const float rgb[3]) {
    return setMaterial(s, material, rgb, kMaxLight, s->view.surfelAlbedo, kMaxAlbedo, 1, s->albedo);
}
int limnrt_scale_material_emission(limnrt_scene* s, uint32_t material, const float rgb[3]) {
    return setMaterial(s, material, rgb, kMaxLight, s->view.surfelEmission, kMaxLight, kPi,
                       s->emitted);
}

int limnrt_set_sky(limnrt_scene* s, const float* rgb) {
    if (!finiteWithin(rgb, 3 * std::size_t(s->view.dims.skyCells), 0, kMaxLight))
        return 0;
    takeSky(*s, rgb);
    changed(*s, true);
    return 1;
}

int limnrt_set_tolerance(limnrt_scene* s, float tolerance) {
    if (!finiteWithin(&tolerance, 1, 1e-7f, 1))
        return 0;
    s->convergence.setTolerance(double(tolerance));
    return 1;
}

float limnrt_step(limnrt_scene* s) {
    const RoundChange round = bounce(*s);
    s->convergence.addRound(round);
    s->ahead.clear();
    return float(std::min(std::max(round.ofAll(), round.relative), 1.0));
}

uint32_t limnrt_converge(limnrt_scene* s, uint32_t max_bounces) {
    const BouncedLight light{s->indirect,        s->albedo,    s->radiosity,
                             s->view.surfelArea, s->seenShare, s->view.dims.surfels};
    std::uint32_t bounces = 0;
    for (; bounces < max_bounces && !s->convergence.reached(); ++bounces) {
        s->ahead.before(s->indirect, light.surfels);
        bounce(*s);
        const Residual residual = s->ahead.replace(light);
        s->convergence.addResidual({residual.change, residual.total, residual.relative},
                                   residual.passedOn);
    }
    return bounces;
}

int limnrt_converged(const limnrt_scene* s) {
    return s->convergence.reached();
}

float limnrt_missing(const limnrt_scene* s) {
    return float(s->convergence.missing());
}

void limnrt_reset(limnrt_scene* s) {
    std::fill(s->indirect, s->indirect + s->view.dims.surfels, F4{});
    changed(*s, true);
}
