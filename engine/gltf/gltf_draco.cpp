// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_draco.h"

#include "engine/core/parallel.h"
#include "engine/gltf/gltf_accessor.h"
#include "engine/gltf/gltf_value.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

namespace limn {

namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Numbers of triangles and points that a Draco stream claims to have.
struct DracoSize {
    std::uint64_t faces = 0, points = 0;
};

/// Reads numbers of variable length, 7 bits a byte. Stays at the end.
struct VarintReader {
    std::span<const std::uint8_t> rest;
    bool ok = true;

    std::uint8_t byte() {
        ok = ok && !rest.empty();
        if (!ok)
            return 0;
        const std::uint8_t value = rest.front();
        rest = rest.subspan(1);
        return value;
    }
    std::uint64_t number() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 63; shift += 7) {
            const std::uint8_t next = byte();
            value |= std::uint64_t(next & 127U) << shift;
            if (next < 128)
                return value;
        }
        ok = false;
        return 0;
    }
};

/// What a stream's first bytes say, before the library allocates it. Streams of versions before
/// 2.2, and those with metadata, of which glTF has none, are refused.
/// Galligan, Hemmer, Stava, Zhang, Brettle. Google/Draco. Bitstream specification, version 2.2.
Result<DracoSize> claimedSize(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kHeader = 11;
    constexpr std::uint8_t kMesh = 1, kSequential = 0, kEdgebreaker = 1;
    constexpr std::uint16_t kMetadata = 0x8000;
    if (bytes.size() < kHeader || std::memcmp(bytes.data(), "DRACO", 5) != 0)
        return fail("is no Draco stream");
    const unsigned version = 256U * bytes[5] + bytes[6];
    const std::uint8_t type = bytes[7], method = bytes[8];
    const unsigned flags = bytes[9] | 256U * bytes[10];
    if (version != 0x202)
        return fail(fmt::format("Draco version {}.{} is not supported", bytes[5], bytes[6]));
    if (type != kMesh || (method != kSequential && method != kEdgebreaker))
        return fail("holds no mesh");
    if ((flags & kMetadata) != 0)
        return fail("Draco metadata is not supported");
    VarintReader reader{bytes.subspan(kHeader)};
    DracoSize size;
    if (method == kSequential) {
        size.faces = reader.number();
        size.points = reader.number();
    } else {
        reader.byte(); // how it is traversed
        size.points = reader.number();
        size.faces = reader.number();
    }
    return reader.ok ? Result<DracoSize>(size) : fail("is damaged");
}

/// An attribute of a decoded primitive.
struct Numbers {
    std::string name;
    std::uint32_t components = 0;
    std::vector<float> values;
};

/// A primitive that is packed, and the result of decoding it.
struct PackedPrimitive {
    std::size_t mesh = 0, primitive = 0;
    std::span<const std::uint8_t> bytes;
    std::map<std::string, std::uint32_t> ids; ///< of attributes in the stream
    std::vector<Numbers> attributes;
    std::vector<std::uint32_t> indices;
    std::string problem;
};

/// Largest value of a normalised integer, by its component type in glTF; 0: it is not one.
float normalizer(const tinygltf::Accessor& accessor) {
    if (!accessor.normalized)
        return 0;
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return 127;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 255;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return 32767;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 65535;
    default:
        return 0;
    }
}

/// Values of an attribute at all points.
template <class T>
bool readValues(const draco::Mesh& mesh, const draco::PointAttribute& attribute, float divisor,
                std::vector<float>& out) {
    const auto components = std::size_t(attribute.num_components());
    std::array<T, 16> value{};
    if (components == 0 || components > value.size())
        return false;
    out.resize(std::size_t(mesh.num_points()) * components);
    for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
        const auto index = attribute.mapped_index(draco::PointIndex(p));
        if (index.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(index, std::int8_t(components), value.data()))
            return false;
        for (std::size_t c = 0; c < components; ++c) {
            const auto number = float(value[c]);
            out[p * components + c] = divisor > 0 ? std::max(number / divisor, -1.f) : number;
        }
    }
    return true;
}

Result<void> decodeInto(const tinygltf::Model& model, PackedPrimitive& packed) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.bytes.data()), packed.bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        return fail(fmt::format("is damaged ({})", decoded.status().error_msg_string()));
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    for (std::uint32_t f = 0; f < mesh->num_faces(); ++f)
        for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f))) {
            if (corner.value() >= mesh->num_points())
                return fail("is damaged");
            packed.indices.push_back(corner.value());
        }
    const tinygltf::Primitive& primitive = model.meshes[packed.mesh].primitives[packed.primitive];
    for (const auto& [name, id] : packed.ids) {
        const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id);
        const auto accessor = primitive.attributes.find(name);
        if (!attribute || accessor == primitive.attributes.end())
            return fail(fmt::format("attributes.{}: missing", name));
        const float divisor = normalizer(model.accessors[std::size_t(accessor->second)]);
        Numbers numbers{name, std::uint32_t(attribute->num_components()), {}};
        const bool isFloat = attribute->data_type() == draco::DT_FLOAT32;
        if (isFloat ? !readValues<float>(*mesh, *attribute, 0, numbers.values)
                    : !readValues<std::int32_t>(*mesh, *attribute, divisor, numbers.values))
            return fail(fmt::format("attributes.{}: is damaged", name));
        packed.attributes.push_back(std::move(numbers));
    }
    return {};
}

Result<PackedPrimitive> readPackedPrimitive(const tinygltf::Model& model,
                                            const tinygltf::Value& value) {
    PackedPrimitive packed;
    const std::optional<std::size_t> view = wholeNumber(member(value, "bufferView"));
    const tinygltf::Value* attributes = member(value, "attributes");
    if (!view || !attributes || !attributes->IsObject())
        return fail("bufferView or attributes: missing");
    const Result<std::span<const std::uint8_t>> bytes = viewBytes(model, int(*view));
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    packed.bytes = *bytes;
    for (const std::string& name : attributes->Keys()) {
        const std::optional<std::size_t> id = wholeNumber(&attributes->Get(name));
        if (!id)
            return fail(fmt::format("attributes.{}: not an index", name));
        if (!name.starts_with("JOINTS") && !name.starts_with("WEIGHTS"))
            packed.ids[name] = std::uint32_t(*id);
    }
    return packed;
}

int typeOf(std::uint32_t components) {
    static constexpr std::array<int, 4> kTypes = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2,
                                                  TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
    return components - 1 < kTypes.size() ? kTypes[components - 1] : -1;
}

/// Adds an accessor with a view and a buffer of its own; returns its index.
template <class T>
int addAccessor(tinygltf::Model& model, const std::vector<T>& values, std::uint32_t components,
                int componentType) {
    tinygltf::Buffer buffer;
    buffer.data.resize(values.size() * sizeof(T));
    if (!values.empty())
        std::memcpy(buffer.data.data(), values.data(), buffer.data.size());
    tinygltf::BufferView view;
    view.buffer = int(model.buffers.size());
    view.byteLength = buffer.data.size();
    tinygltf::Accessor accessor;
    accessor.bufferView = int(model.bufferViews.size());
    accessor.componentType = componentType;
    accessor.type = typeOf(components);
    accessor.count = values.size() / components;
    model.buffers.push_back(std::move(buffer));
    model.bufferViews.push_back(std::move(view));
    model.accessors.push_back(std::move(accessor));
    return int(model.accessors.size() - 1);
}

void give(tinygltf::Model& model, const PackedPrimitive& packed) {
    std::map<std::string, int> accessors;
    for (const Numbers& numbers : packed.attributes)
        accessors[numbers.name] =
            addAccessor(model, numbers.values, numbers.components, TINYGLTF_COMPONENT_TYPE_FLOAT);
    const int indices = addAccessor(model, packed.indices, 1, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
    tinygltf::Primitive& primitive = model.meshes[packed.mesh].primitives[packed.primitive];
    for (const auto& [name, accessor] : accessors)
        primitive.attributes[name] = accessor;
    primitive.indices = indices;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

} // namespace

Result<void> unpackDraco(tinygltf::Model& model, const MemoryBudget& memory) {
    std::vector<PackedPrimitive> all;
    std::uint64_t bytes = 0;
    const auto failIn = [](const PackedPrimitive& packed, const std::string& message) {
        return fail(fmt::format("meshes[{}].primitives[{}].extensions.{}.{}", packed.mesh,
                                packed.primitive, kDraco, message));
    };
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
            const auto& extensions = model.meshes[m].primitives[p].extensions;
            const auto found = extensions.find(kDraco);
            if (found == extensions.end())
                continue;
            Result<PackedPrimitive> packed = readPackedPrimitive(model, found->second);
            const PackedPrimitive place{m, p, {}, {}, {}, {}, {}};
            if (!packed)
                return failIn(place, packed.error().message);
            packed->mesh = m;
            packed->primitive = p;
            const Result<DracoSize> size = claimedSize(packed->bytes);
            if (!size)
                return failIn(place, "bufferView: " + size.error().message);
            // Faces and points as they are decoded, with connectivity, and as they are kept.
            constexpr std::uint64_t kFaceBytes = 100, kPointBytes = 200, kMaxCount = 1U << 31;
            if (size->faces > kMaxCount || size->points > kMaxCount)
                return failIn(place, "bufferView: is damaged");
            bytes += size->faces * kFaceBytes + size->points * kPointBytes;
            if (const Result<void> fits = memory.allow("unpacking its geometry", bytes); !fits)
                return tl::make_unexpected(fits.error());
            all.push_back(std::move(*packed));
        }
    parallelRanges(all.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (const Result<void> decoded = decodeInto(model, all[i]); !decoded)
                all[i].problem = decoded.error().message;
    });
    for (const PackedPrimitive& packed : all) {
        if (!packed.problem.empty())
            return failIn(packed, "bufferView: " + packed.problem);
        give(model, packed);
    }
    return {};
}

} // namespace limn
