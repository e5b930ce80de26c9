// SPDX-License-Identifier: MIT
#include "engine/trace/trace_scene.h"

#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/math/unit_vector.h"
#include "engine/trace/alpha_mask.h"
#include "engine/trace/embree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tbb/task_arena.h>

namespace limn {

namespace {

/// Key of triangles with identical holes: a mesh and, if it has holes, its material.
struct MeshKey {
    std::uint32_t mesh = 0;
    std::uint32_t cutout = ~0u; ///< material with holes; ~0: none

    auto operator<=>(const MeshKey&) const = default;
};

/// Data shared by instances with equal keys.
struct SharedMesh {
    AlphaMask mask;
    RTCScene scene = nullptr; ///< in object space; null while no instance needs it
};

/// Data per instance that a hit needs.
struct HitFrame {
    glm::mat4 toWorld{1};
    float winding = 1;                  ///< -1: the matrix mirrors, glTF flips the front
    bool present = true;                ///< has triangles at finite places
    bool inWorld = true;                ///< its triangles lie in the top structure, in world space
    TraceMask kind = TraceMask::Static; ///< the tree that it belongs to
};

/// Static scenes of up to this many triangles are copied entirely to world space.
constexpr std::size_t kMaxCopiedTriangles = 2'000'000;

void passThroughMask(const RTCFilterFunctionNArguments* args) {
    const AlphaMask& mask = *static_cast<const AlphaMask*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i)
        if (args->valid[i] != 0 &&
            !opaqueAt(mask, RTCHitN_primID(args->hit, args->N, i), RTCHitN_u(args->hit, args->N, i),
                      RTCHitN_v(args->hit, args->N, i)))
            args->valid[i] = 0;
}

bool isFinite(const glm::mat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r]))
                return false;
    return true;
}

double determinant3(const glm::mat4& m) {
    return glm::determinant(glm::dmat3(glm::mat3(m)));
}

// Embree inverts instance matrices in floats. The matrix of a flattened object has no inverse and
// that of a nearly flat one no accurate inverse: their vertices are transformed to world space
// instead.
bool invertsWell(const glm::mat4& m) {
    const glm::dmat3 a(glm::mat3{m});
    const double size = std::max({glm::length(a[0]), glm::length(a[1]), glm::length(a[2])});
    return size > 0 && std::abs(glm::determinant(a)) > 1e-4 * size * size * size;
}

} // namespace

Ray rayBetween(glm::vec3 from, glm::vec3 to) {
    const glm::vec3 way = to - from;
    const float distance = glm::length(way);
    if (!(distance > 0))
        return {from, glm::vec3(0, 0, 1), 0, -1};
    return {from, way / distance, 0, distance};
}

/// Acceleration structures over the static instances, or the dynamic ones.
struct TraceScene::Trees {
    std::shared_ptr<const Assets> assets; ///< Embree reads their vertices
    RTCDevice device = nullptr;
    std::map<MeshKey, SharedMesh> meshes; ///< nodes stay where they are: Embree points at the masks
    RTCScene top = nullptr;

    explicit Trees(RTCDevice shared);
    ~Trees();
    Trees(const Trees&) = delete;
    Trees& operator=(const Trees&) = delete;
};

TraceScene::Trees::Trees(RTCDevice shared) : device(shared ? shared : rtcNewDevice(nullptr)) {
    if (!device)
        throw std::runtime_error("Embree: no device");
    if (shared)
        rtcRetainDevice(device);
    else
        rtcSetDeviceErrorFunction(
            device,
            [](void*, RTCError, const char* text) { logError(std::string("Embree: ") + text); },
            nullptr);
}

TraceScene::Trees::~Trees() {
    if (top)
        rtcReleaseScene(top);
    for (auto& [key, shared] : meshes)
        if (shared.scene)
            rtcReleaseScene(shared.scene);
    rtcReleaseDevice(device);
}

struct TraceScene::Impl {
    Scene scene;
    std::vector<HitFrame> frames; ///< per instance
    float magnitude = 0; ///< the power of two above the static scene's largest coordinate [m]
    std::shared_ptr<const Trees> fixed, moving, sheets; ///< null where there is no such instance
    mutable std::atomic<std::uint64_t> badRays = 0;

    bool traceable(const Ray& ray) const;
    RTCRayHit intersect(const Ray& ray, TraceMask mask) const;
    /// First corner of the triangle that was hit, and its edges to the others, in the mesh's space.
    struct Corner {
        glm::vec3 position, toSecond, toThird;
    };
    Corner cornerOf(const RTCRayHit& rh) const;
    /// Normal of that triangle in the world, not of unit length.
    glm::vec3 normalOf(const RTCRayHit& rh, const Corner& corner) const;
    glm::vec3 roughNormalOf(const RTCRayHit& rh) const;

    Impl(const Scene& s, const std::vector<bool>* only, const Impl* before);
    MeshKey keyOf(const Instance& instance) const;
    void placeInstances(const std::vector<bool>* only);
    std::shared_ptr<const Trees> makeTrees(TraceMask kind, RTCDevice shared) const;
    void buildMeshes(Trees& trees, TraceMask kind) const;
    void buildTop(Trees& trees, TraceMask kind) const;
    bool belongs(std::size_t i, TraceMask kind) const {
        return frames[i].present && frames[i].kind == kind;
    }
    RTCGeometry triangles(RTCDevice device, const Instance& instance, const SharedMesh& shared,
                          bool inWorld) const;
    void setPositions(RTCGeometry geometry, const Instance& instance, bool inWorld) const;
};

static float magnitudeOf(const Scene& scene) {
    const bool anyStatic = std::any_of(scene.instances.begin(), scene.instances.end(),
                                       [](const Instance& i) { return !i.dynamic; });
    const Bounds b = anyStatic ? staticBounds(scene) : scene.bounds;
    const glm::vec3 magnitudes = glm::max(glm::abs(b.lower), glm::abs(b.upper));
    const float largest = std::max({magnitudes.x, magnitudes.y, magnitudes.z});
    // In powers of two, so that an object that moves rarely affects the rays of the rest of the
    // scene; of the static scene only, so that a bake never depends on a dynamic object.
    return std::isfinite(largest) && largest > 0 ? std::exp2(std::ceil(std::log2(largest))) : 0;
}

TraceScene::Impl::Impl(const Scene& s, const std::vector<bool>* only, const Impl* before)
    : scene(s) {
    if (!scene.assets)
        scene.assets = std::make_shared<Assets>();
    placeInstances(only);
    fixed = before ? before->fixed : makeTrees(TraceMask::Static, nullptr);
    moving = makeTrees(TraceMask::Dynamic, fixed ? fixed->device : nullptr);
    sheets = makeTrees(TraceMask::Sheets, fixed    ? fixed->device
                                          : moving ? moving->device
                                                   : nullptr);
    magnitude = before ? before->magnitude : magnitudeOf(scene);
}

MeshKey TraceScene::Impl::keyOf(const Instance& instance) const {
    return {instance.mesh, isCutout(scene.materialOf(instance)) ? instance.material : ~0u};
}

// One tree over all triangles in world space is far faster than one per instance where instances
// overlap: a ray through Sponza's 103 meshes enters most of them. It costs a copy of the vertices,
// so meshes with many repetitions remain instances, as do moving objects.
void TraceScene::Impl::placeInstances(const std::vector<bool>* only) {
    std::vector<std::uint32_t> uses(scene.assets->meshes.size(), 0);
    std::size_t staticTriangles = 0;
    for (const Instance& instance : scene.instances) {
        ++uses[instance.mesh];
        staticTriangles += instance.dynamic ? 0 : scene.meshOf(instance).triangleCount();
    }
    for (const Instance& instance : scene.instances) {
        const glm::mat4& toWorld = instance.toWorld;
        HitFrame frame{toWorld, determinant3(toWorld) < 0 ? -1.f : 1.f};
        frame.present = !scene.meshOf(instance).indices.empty() && isFinite(toWorld) &&
                        (!only || (*only)[frames.size()]);
        const bool copied = !instance.dynamic &&
                            (uses[instance.mesh] == 1 || staticTriangles <= kMaxCopiedTriangles);
        frame.inWorld = copied || !invertsWell(toWorld);
        frame.kind = isGlassSheet(scene.materialOf(instance)) ? TraceMask::Sheets
                     : instance.dynamic                       ? TraceMask::Dynamic
                                                              : TraceMask::Static;
        frames.push_back(frame);
    }
}

std::shared_ptr<const TraceScene::Trees> TraceScene::Impl::makeTrees(TraceMask kind,
                                                                     RTCDevice shared) const {
    std::shared_ptr<Trees> trees;
    AlphaImages images;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (!belongs(i, kind))
            continue;
        if (!trees)
            trees = std::make_shared<Trees>(shared);
        const Instance& instance = scene.instances[i];
        const MeshKey key = keyOf(instance);
        const auto [entry, isNew] = trees->meshes.try_emplace(key);
        if (isNew && key.cutout != ~0u)
            entry->second.mask = makeAlphaMask(*scene.assets, scene.meshOf(instance),
                                               scene.materials[key.cutout], images);
    }
    if (!trees)
        return nullptr;
    trees->assets = scene.assets;
    buildMeshes(*trees, kind);
    buildTop(*trees, kind);
    return trees;
}

void TraceScene::Impl::setPositions(RTCGeometry geometry, const Instance& instance,
                                    bool inWorld) const {
    const std::vector<glm::vec3>& positions = scene.meshOf(instance).positions;
    const bool asTheyAre = !inWorld || instance.toWorld == glm::mat4(1);
    // Embree loads 16 bytes per vertex: the last one may be shared only if memory follows it.
    if (asTheyAre && positions.capacity() > positions.size()) {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   positions.data(), 0, sizeof(glm::vec3), positions.size());
        return;
    }
    auto* copy = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), positions.size()));
    if (!copy)
        throw std::runtime_error("Embree: out of memory");
    for (std::size_t i = 0; i < positions.size(); ++i)
        copy[i] =
            asTheyAre ? positions[i] : glm::vec3(instance.toWorld * glm::vec4(positions[i], 1));
}

RTCGeometry TraceScene::Impl::triangles(RTCDevice device, const Instance& instance,
                                        const SharedMesh& shared, bool inWorld) const {
    const Mesh& mesh = scene.meshOf(instance);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    setPositions(geometry, instance, inWorld);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.indices.data(), 0, 3 * sizeof(std::uint32_t),
                               mesh.triangleCount());
    if (shared.mask.mesh) {
        rtcSetGeometryUserData(geometry, const_cast<AlphaMask*>(&shared.mask));
        rtcSetGeometryIntersectFilterFunction(geometry, passThroughMask);
        rtcSetGeometryOccludedFilterFunction(geometry, passThroughMask);
    }
    return geometry;
}

// One thread per structure, several structures at once: the tree, and thus which of two coplanar
// triangles is hit first, does not depend on the number of threads.
static void commitAlone(RTCScene scene) {
    tbb::task_arena(1).execute([&] { rtcCommitScene(scene); });
}

void TraceScene::Impl::buildMeshes(Trees& trees, TraceMask kind) const {
    std::map<MeshKey, const Instance*> needed;
    for (std::size_t i = 0; i < frames.size(); ++i)
        if (belongs(i, kind) && !frames[i].inWorld)
            needed.try_emplace(keyOf(scene.instances[i]), &scene.instances[i]);
    const std::vector<std::pair<MeshKey, const Instance*>> work(needed.begin(), needed.end());
    parallelRanges(work.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            SharedMesh& shared = trees.meshes.at(work[i].first);
            RTCGeometry geometry = triangles(trees.device, *work[i].second, shared, false);
            rtcSetGeometryMask(geometry, ~0u);
            rtcCommitGeometry(geometry);
            shared.scene = rtcNewScene(trees.device);
            setEmbreeFlags(shared.scene);
            rtcAttachGeometry(shared.scene, geometry);
            rtcReleaseGeometry(geometry);
            commitAlone(shared.scene);
        }
    });
}

void TraceScene::Impl::buildTop(Trees& trees, TraceMask kind) const {
    trees.top = rtcNewScene(trees.device);
    setEmbreeFlags(trees.top);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        if (!belongs(i, kind))
            continue;
        const Instance& instance = scene.instances[i];
        const SharedMesh& shared = trees.meshes.at(keyOf(instance));
        RTCGeometry geometry = nullptr;
        if (frames[i].inWorld) {
            geometry = triangles(trees.device, instance, shared, true);
        } else {
            geometry = rtcNewGeometry(trees.device, RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(geometry, shared.scene);
            rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                                    &instance.toWorld);
        }
        rtcSetGeometryMask(geometry, ~0u);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(trees.top, geometry, i);
        rtcReleaseGeometry(geometry);
    }
    commitAlone(trees.top);
}

TraceScene::TraceScene(const Scene& scene)
    : m_impl(std::make_unique<Impl>(scene, nullptr, nullptr)) {}

TraceScene::TraceScene(const Scene& scene, const std::vector<bool>& present)
    : m_impl(std::make_unique<Impl>(scene, &present, nullptr)) {}

TraceScene::TraceScene(const Scene& scene, const TraceScene& before)
    : m_impl(std::make_unique<Impl>(scene, nullptr, before.m_impl.get())) {}

TraceScene::~TraceScene() = default;

const Scene& TraceScene::scene() const {
    return m_impl->scene;
}

static bool asks(TraceMask mask, TraceMask which) {
    return (unsigned(mask) & unsigned(which)) != 0;
}

static RTCRay embreeRay(const Ray& ray) {
    RTCRay r{};
    r.org_x = ray.origin.x;
    r.org_y = ray.origin.y;
    r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x;
    r.dir_y = ray.direction.y;
    r.dir_z = ray.direction.z;
    r.tnear = ray.tNear;
    r.tfar = ray.tFar;
    r.mask = ~0u;
    return r;
}

static RTCRayHit unhit(const Ray& ray) {
    RTCRayHit rh{};
    rh.ray = embreeRay(ray);
    rh.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return rh;
}

static bool met(const RTCRayHit& rh) {
    return rh.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

static unsigned instanceOf(const RTCRayHit& rh) {
    return rh.hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? rh.hit.geomID : rh.hit.instID[0];
}

bool TraceScene::Impl::traceable(const Ray& ray) const {
    constexpr float kMaximum = 1e18f; // Embree's limit is 1.8e18
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(ray.origin[c]) < kMaximum) || !(std::abs(ray.direction[c]) < kMaximum)) {
            badRays.fetch_add(1, std::memory_order_relaxed);
            return false;
        }
    if (ray.tNear >= 0 && ray.tFar >= ray.tNear)
        return true;
    if (!(ray.tFar < ray.tNear)) // an empty stretch is none the worse for it
        badRays.fetch_add(1, std::memory_order_relaxed);
    return false;
}

std::uint64_t TraceScene::badRays() const {
    return m_impl->badRays;
}

/// Closest hit of Embree among the surfaces that `mask` selects.
RTCRayHit TraceScene::Impl::intersect(const Ray& ray, TraceMask mask) const {
    RTCRayHit rh = unhit(ray);
    if (!traceable(ray))
        return rh;
    if (fixed && asks(mask, TraceMask::Static))
        embreeIntersect(fixed->top, rh);
    const auto also = [&](const std::shared_ptr<const Trees>& trees, TraceMask which) {
        if (!trees || !asks(mask, which))
            return;
        RTCRayHit other = unhit(ray);
        other.ray.tfar = rh.ray.tfar * (1 + 0x1p-20f); // as far as that and a little
        embreeIntersect(trees->top, other);
        // Of equally distant hits, that of the lowest instance, as within a tree.
        if (met(other) && (!met(rh) || other.ray.tfar < rh.ray.tfar ||
                           (other.ray.tfar == rh.ray.tfar && instanceOf(other) < instanceOf(rh))))
            rh = other;
    };
    also(moving, TraceMask::Dynamic);
    also(sheets, TraceMask::Sheets);
    return rh;
}

TraceScene::Impl::Corner TraceScene::Impl::cornerOf(const RTCRayHit& rh) const {
    const Mesh& mesh = scene.meshOf(scene.instances[instanceOf(rh)]);
    const std::array<std::uint32_t, 3> k = mesh.triangle(rh.hit.primID);
    const glm::vec3 a = mesh.positions[k[0]];
    return {a, mesh.positions[k[1]] - a, mesh.positions[k[2]] - a};
}

glm::vec3 TraceScene::Impl::normalOf(const RTCRayHit& rh, const Corner& corner) const {
    const HitFrame& frame = frames[instanceOf(rh)];
    const glm::mat3 linear(frame.toWorld);
    return glm::cross(linear * corner.toSecond, linear * corner.toThird) * frame.winding;
}

/// The same up to rounding. Does not read the vertices where Embree has them in world space.
glm::vec3 TraceScene::Impl::roughNormalOf(const RTCRayHit& rh) const {
    const HitFrame& frame = frames[instanceOf(rh)];
    return frame.inWorld ? glm::vec3(rh.hit.Ng_x, rh.hit.Ng_y, rh.hit.Ng_z) * frame.winding
                         : normalOf(rh, cornerOf(rh));
}

SurfaceHit TraceScene::closestSurface(const Ray& ray, TraceMask mask) const {
    const RTCRayHit rh = m_impl->intersect(ray, mask);
    if (!met(rh))
        return {};
    return {.instance = instanceOf(rh),
            .triangle = rh.hit.primID,
            .u = rh.hit.u,
            .v = rh.hit.v,
            .t = rh.ray.tfar,
            .frontFace = glm::dot(m_impl->roughNormalOf(rh), ray.direction) < 0};
}

// Position and normal are computed from the triangle itself: the position is exact to a few
// roundings of the vertices, however long the ray.
Hit TraceScene::closestHit(const Ray& ray, TraceMask mask) const {
    const RTCRayHit rh = m_impl->intersect(ray, mask);
    Hit hit;
    if (!met(rh))
        return hit;
    hit.instance = instanceOf(rh);
    hit.triangle = rh.hit.primID;
    hit.u = rh.hit.u;
    hit.v = rh.hit.v;
    hit.t = rh.ray.tfar;
    const Impl::Corner corner = m_impl->cornerOf(rh);
    hit.position =
        glm::vec3(m_impl->frames[hit.instance].toWorld *
                  glm::vec4(corner.position + hit.u * corner.toSecond + hit.v * corner.toThird, 1));
    hit.geometricNormal = unitOr(m_impl->normalOf(rh, corner), -ray.direction);
    hit.frontFace = glm::dot(hit.geometricNormal, ray.direction) < 0;
    return hit;
}

bool TraceScene::occluded(const Ray& ray, TraceMask mask) const {
    const auto meets = [&](const std::shared_ptr<const Trees>& trees, TraceMask which) {
        if (!trees || !asks(mask, which))
            return false;
        RTCRay r = embreeRay(ray);
        embreeOccluded(trees->top, r);
        return r.tfar < 0;
    };
    if (!m_impl->traceable(ray)) // tFar < 0 would be taken for Embree's answer
        return false;
    return meets(m_impl->fixed, TraceMask::Static) || meets(m_impl->moving, TraceMask::Dynamic) ||
           meets(m_impl->sheets, TraceMask::Sheets);
}

std::uint32_t TraceScene::occludedTogether(RayPacket& rays, std::size_t count,
                                           TraceMask mask) const {
    assert(count <= RayPacket::kSize);
    alignas(32) RayPacket::Lanes<int> valid{}; // -1: to trace
    for (std::size_t k = 0; k < count; ++k)
        valid[k] = m_impl->traceable(rays.ray(k)) ? -1 : 0;
    std::uint32_t met = 0;
    const auto trace = [&](const std::shared_ptr<const Trees>& trees, TraceMask which) {
        if (!trees || !asks(mask, which))
            return;
        embreeOccluded(trees->top, valid.data(), rays);
        for (std::size_t k = 0; k < count; ++k)
            if (valid[k] != 0 && rays.tFar[k] < 0) {
                met |= 1U << k;
                valid[k] = 0;
            }
    };
    trace(m_impl->fixed, TraceMask::Static);
    trace(m_impl->moving, TraceMask::Dynamic);
    trace(m_impl->sheets, TraceMask::Sheets);
    return met;
}

bool TraceScene::blocked(glm::vec3 from, glm::vec3 to, TraceMask mask) const {
    return occluded(rayBetween(from, to), mask);
}

// The error of a hit's position is a few 2^-24 of its coordinates; the matrix of an instance and
// the test of a large triangle add a few 2^-24 of the scene's size.
float TraceScene::epsilonAt(glm::vec3 p) const {
    const float coordinate = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return 0x1p-19f * coordinate + 0x1p-20f * m_impl->magnitude;
}

} // namespace limn
