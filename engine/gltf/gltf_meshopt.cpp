// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_meshopt.h"

#include "engine/gltf/gltf_value.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace limn {

static constexpr const char* kMeshopt = "EXT_meshopt_compression";

namespace {

/// What the extension says of a buffer view.
struct PackedView {
    std::span<const std::uint8_t> bytes;
    std::size_t stride = 0, count = 0;
    std::string mode, filter;
};

Result<PackedView> readPackedView(const tinygltf::Model& model, const tinygltf::Value& value) {
    const auto size = [&](const char* key) { return wholeNumber(member(value, key)); };
    const auto text = [&](const char* key) {
        const tinygltf::Value* found = member(value, key);
        return found && found->IsString() ? found->Get<std::string>() : std::string();
    };
    const std::optional<std::size_t> buffer = size("buffer"), length = size("byteLength"),
                                     stride = size("byteStride"), count = size("count");
    const std::size_t offset = size("byteOffset").value_or(0);
    if (!buffer || *buffer >= model.buffers.size())
        return fail("buffer: missing or out of range");
    if (!length || !stride || !count)
        return fail("byteLength, byteStride or count: missing");
    const std::vector<unsigned char>& data = model.buffers[*buffer].data;
    if (offset > data.size() || *length > data.size() - offset)
        return fail(
            fmt::format("{} bytes at {} exceed the buffer's {}", *length, offset, data.size()));
    return PackedView{std::span(data).subspan(offset, *length), *stride, *count, text("mode"),
                      text("filter")};
}

/// Fails on what meshoptimizer takes for granted.
Result<void> checkPacked(const PackedView& view) {
    constexpr std::size_t kMaxStride = 256, kMaxCount = std::size_t(1) << 32;
    const std::string& filter = view.filter;
    if (view.count >= kMaxCount)
        return fail(fmt::format("count: {} is too large", view.count));
    if (view.mode == "ATTRIBUTES") {
        if (view.stride == 0 || view.stride % 4 != 0 || view.stride > kMaxStride)
            return fail(
                fmt::format("byteStride: {} is not a multiple of 4 up to 256", view.stride));
        const bool fits = filter.empty() || filter == "NONE" || filter == "EXPONENTIAL" ||
                          (filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) ||
                          (filter == "QUATERNION" && view.stride == 8);
        return fits ? Result<void>() : fail(fmt::format("filter: {} does not fit", filter));
    }
    if (view.mode != "TRIANGLES" && view.mode != "INDICES")
        return fail(fmt::format("mode: {} is unknown", view.mode));
    if (view.stride != 2 && view.stride != 4)
        return fail(fmt::format("byteStride: {} is neither 2 nor 4", view.stride));
    if (view.mode == "TRIANGLES" && view.count % 3 != 0)
        return fail(fmt::format("count: {} is not a multiple of 3", view.count));
    return {};
}

bool unpack(const PackedView& view, std::vector<unsigned char>& out) {
    const std::uint8_t* const bytes = view.bytes.data();
    const std::size_t size = view.bytes.size();
    if (view.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, bytes, size) == 0;
    if (view.mode == "INDICES")
        return meshopt_decodeIndexSequence(out.data(), view.count, view.stride, bytes, size) == 0;
    if (meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, bytes, size) != 0)
        return false;
    if (view.filter == "OCTAHEDRAL")
        meshopt_decodeFilterOct(out.data(), view.count, view.stride);
    else if (view.filter == "QUATERNION")
        meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
    else if (view.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(out.data(), view.count, view.stride);
    return true;
}

Result<tinygltf::Buffer> unpackedView(const tinygltf::Model& model, const tinygltf::Value& value,
                                      const MemoryBudget& memory, std::uint64_t& total) {
    const Result<PackedView> view = readPackedView(model, value);
    if (!view)
        return tl::make_unexpected(view.error());
    if (const Result<void> valid = checkPacked(*view); !valid)
        return tl::make_unexpected(valid.error());
    total += std::uint64_t(view->count) * view->stride;
    if (const Result<void> fits = memory.allow("unpacking its geometry", total); !fits)
        return tl::make_unexpected(fits.error());
    tinygltf::Buffer buffer;
    buffer.data.resize(view->count * view->stride);
    if (view->count > 0 && !unpack(*view, buffer.data))
        return fail("is damaged");
    return buffer;
}

} // namespace

Result<void> unpackMeshopt(tinygltf::Model& model, const MemoryBudget& memory) {
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
        const auto found = model.bufferViews[i].extensions.find(kMeshopt);
        if (found == model.bufferViews[i].extensions.end())
            continue;
        Result<tinygltf::Buffer> buffer = unpackedView(model, found->second, memory, total);
        if (!buffer)
            return fail(fmt::format("bufferViews[{}].extensions.{}.{}", i, kMeshopt,
                                    buffer.error().message));
        tinygltf::BufferView& view = model.bufferViews[i];
        view.buffer = int(model.buffers.size());
        view.byteOffset = 0;
        view.byteLength = buffer->data.size();
        model.buffers.push_back(std::move(*buffer));
    }
    return {};
}

} // namespace limn
