// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_accessor.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

namespace limn {

static std::uint32_t componentSize(int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        return 0;
    }
}

static std::uint32_t componentCount(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    case TINYGLTF_TYPE_MAT4:
        return 16;
    default: // 2x2 and 3x3 matrices have padded columns, and nothing here uses them
        return 0;
    }
}

template <class T>
static T load(const std::uint8_t* p) {
    T value;
    std::memcpy(&value, p, sizeof value);
    return value;
}

static float loadNumber(const std::uint8_t* p, int type, bool normalized) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return normalized ? std::max(float(load<std::int8_t>(p)) / 127.f, -1.f)
                          : float(load<std::int8_t>(p));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return normalized ? float(*p) / 255.f : float(*p);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return normalized ? std::max(float(load<std::int16_t>(p)) / 32767.f, -1.f)
                          : float(load<std::int16_t>(p));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return normalized ? float(load<std::uint16_t>(p)) / 65535.f : float(load<std::uint16_t>(p));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return normalized ? float(double(load<std::uint32_t>(p)) / 4294967295.0)
                          : float(load<std::uint32_t>(p));
    default:
        return load<float>(p);
    }
}

static std::uint32_t loadIndex(const std::uint8_t* p, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return *p;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(p);
    default:
        return load<std::uint32_t>(p);
    }
}

static bool isIndexType(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

Result<std::span<const std::uint8_t>> viewBytes(const tinygltf::Model& model, int index) {
    if (index < 0 || std::size_t(index) >= model.bufferViews.size())
        return fail(fmt::format("bufferViews[{}]: there are {}", index, model.bufferViews.size()));
    const tinygltf::BufferView& view = model.bufferViews[std::size_t(index)];
    if (view.buffer < 0 || std::size_t(view.buffer) >= model.buffers.size())
        return fail(fmt::format("bufferViews[{}].buffer: out of range", index));
    const std::vector<unsigned char>& data = model.buffers[std::size_t(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        return fail(fmt::format("bufferViews[{}]: {} bytes at {} exceed the buffer's {}", index,
                                view.byteLength, view.byteOffset, data.size()));
    return std::span<const std::uint8_t>(data.data() + view.byteOffset, view.byteLength);
}

namespace {

/// Elements that are known to lie inside a buffer.
struct Elements {
    const std::uint8_t* first = nullptr; ///< null: all zeros
    std::size_t stride = 0;
    std::size_t count = 0;

    const std::uint8_t* operator[](std::size_t i) const { return first + i * stride; }
};

} // namespace

static Result<Elements> elementsAt(const tinygltf::Model& model, int view, std::size_t offset,
                                   std::size_t count, std::size_t size) {
    const Result<std::span<const std::uint8_t>> bytes = viewBytes(model, view);
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    const std::size_t stated = model.bufferViews[std::size_t(view)].byteStride;
    const std::size_t stride = stated ? stated : size;
    if (stride < size)
        return fail(fmt::format("bufferViews[{}].byteStride: {} is less than an element's {} bytes",
                                view, stride, size));
    const std::size_t room = bytes->size();
    if (count > 0 &&
        (offset > room || size > room - offset || (room - offset - size) / stride < count - 1))
        return fail(fmt::format("{} elements of {} bytes at {} exceed bufferViews[{}] of {} bytes",
                                count, size, offset, view, room));
    return Elements{bytes->data() + std::min(offset, room), stride, count};
}

static Result<Elements> baseElements(const tinygltf::Model& model,
                                     const tinygltf::Accessor& accessor, std::size_t size) {
    if (accessor.bufferView >= 0)
        return elementsAt(model, accessor.bufferView, accessor.byteOffset, accessor.count, size);
    if (accessor.count > kMaxZeros)
        return fail(fmt::format("count: {} zeros are too many", accessor.count));
    return Elements{nullptr, 0, accessor.count};
}

/// Calls put(row, bytes) for every sparse element.
template <class Put>
static Result<void> forEachSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                                  std::size_t size, const Put& put) {
    if (!accessor.sparse.isSparse)
        return {};
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || std::size_t(sparse.count) > accessor.count)
        return fail("sparse.count: exceeds the accessor's count");
    if (!isIndexType(sparse.indices.componentType))
        return fail("sparse.indices.componentType: not an unsigned integer type");
    if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        return fail("sparse: negative byteOffset");
    const auto count = std::size_t(sparse.count);
    const Result<Elements> indices =
        elementsAt(model, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), count,
                   componentSize(sparse.indices.componentType));
    if (!indices)
        return fail("sparse.indices: " + indices.error().message);
    const Result<Elements> values = elementsAt(model, sparse.values.bufferView,
                                               std::size_t(sparse.values.byteOffset), count, size);
    if (!values)
        return fail("sparse.values: " + values.error().message);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t row = loadIndex((*indices)[i], sparse.indices.componentType);
        if (row >= accessor.count)
            return fail(
                fmt::format("sparse.indices[{}]: {} exceeds the count {}", i, row, accessor.count));
        put(row, (*values)[i]);
    }
    return {};
}

template <class T>
static Result<T> failAt(int accessor, const Error& error) {
    return fail(fmt::format("accessors[{}]: {}", accessor, error.message));
}

static Result<const tinygltf::Accessor*> checkedAccessor(const tinygltf::Model& model, int index) {
    if (index < 0 || std::size_t(index) >= model.accessors.size())
        return fail(fmt::format("accessors[{}]: there are {}", index, model.accessors.size()));
    const tinygltf::Accessor& accessor = model.accessors[std::size_t(index)];
    if (componentSize(accessor.componentType) == 0)
        return fail(fmt::format("accessors[{}].componentType: {} is unknown", index,
                                accessor.componentType));
    if (componentCount(accessor.type) == 0)
        return fail(fmt::format("accessors[{}].type: not usable here", index));
    return &accessor;
}

Result<std::size_t> countOfAccessor(const tinygltf::Model& model, int index) {
    const Result<const tinygltf::Accessor*> checked = checkedAccessor(model, index);
    if (!checked)
        return tl::make_unexpected(checked.error());
    const tinygltf::Accessor& accessor = **checked;
    const Result<Elements> elements = baseElements(
        model, accessor, componentSize(accessor.componentType) * componentCount(accessor.type));
    if (!elements)
        return failAt<std::size_t>(index, elements.error());
    return elements->count;
}

/// Reads `rows`, or all where that is null.
static Result<AccessorValues> readRows(const tinygltf::Model& model, int index,
                                       const std::span<const std::uint32_t>* rows) {
    const Result<const tinygltf::Accessor*> checked = checkedAccessor(model, index);
    if (!checked)
        return tl::make_unexpected(checked.error());
    const tinygltf::Accessor& accessor = **checked;
    const std::uint32_t step = componentSize(accessor.componentType);
    AccessorValues out;
    out.components = componentCount(accessor.type);
    const Result<Elements> elements = baseElements(model, accessor, step * out.components);
    if (!elements)
        return failAt<AccessorValues>(index, elements.error());
    if (rows && !rows->empty() && rows->back() >= elements->count)
        return failAt<AccessorValues>(
            index, {fmt::format("has {} elements, not {}", elements->count, rows->back() + 1)});
    const std::size_t count = rows ? rows->size() : elements->count;
    out.values.resize(count * out.components);
    const auto put = [&](std::size_t row, const std::uint8_t* bytes) {
        float* to = &out.values[row * out.components];
        for (std::uint32_t c = 0; c < out.components; ++c)
            to[c] = loadNumber(bytes + c * step, accessor.componentType, accessor.normalized);
    };
    if (elements->first)
        for (std::size_t i = 0; i < count; ++i)
            put(i, (*elements)[rows ? (*rows)[i] : i]);
    const auto putSparse = [&](std::uint32_t row, const std::uint8_t* bytes) {
        if (!rows)
            return put(row, bytes);
        if (const auto found = std::ranges::lower_bound(*rows, row);
            found != rows->end() && *found == row)
            put(std::size_t(found - rows->begin()), bytes);
    };
    if (const Result<void> sparse =
            forEachSparse(model, accessor, step * out.components, putSparse);
        !sparse)
        return failAt<AccessorValues>(index, sparse.error());
    return out;
}

Result<AccessorValues> readNumbers(const tinygltf::Model& model, int index) {
    return readRows(model, index, nullptr);
}

Result<AccessorValues> readNumbers(const tinygltf::Model& model, int index,
                                   std::span<const std::uint32_t> rows) {
    return readRows(model, index, &rows);
}

Result<std::vector<std::uint32_t>> readIndices(const tinygltf::Model& model, int index) {
    using Indices = std::vector<std::uint32_t>;
    const Result<const tinygltf::Accessor*> checked = checkedAccessor(model, index);
    if (!checked)
        return tl::make_unexpected(checked.error());
    const tinygltf::Accessor& accessor = **checked;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !isIndexType(accessor.componentType))
        return failAt<Indices>(index, {"indices must be unsigned integer scalars"});
    const std::uint32_t size = componentSize(accessor.componentType);
    const Result<Elements> elements = baseElements(model, accessor, size);
    if (!elements)
        return failAt<Indices>(index, elements.error());
    Indices out(elements->count);
    if (elements->first)
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = loadIndex((*elements)[i], accessor.componentType);
    const auto put = [&](std::size_t row, const std::uint8_t* bytes) {
        out[row] = loadIndex(bytes, accessor.componentType);
    };
    if (const Result<void> sparse = forEachSparse(model, accessor, size, put); !sparse)
        return failAt<Indices>(index, sparse.error());
    return out;
}

} // namespace limn
