// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/atlas.h"
#include "engine/bake/stage_store.h"
#include "engine/core/archive.h"
#include "engine/core/progress.h"

#include <optional>
#include <utility>

namespace limn {

template <class A, class C>
void chartFields(A& a, C& c) {
    a(c.sourceVertex), a(c.indices), a(c.chartOfTriangle), a(c.chartUv), a(c.chartSize);
}

/// All but the charts, which are kept per mesh.
template <class A, class T>
void atlasFields(A& a, T& t) {
    a(t.layout.width), a(t.layout.height), a(t.texels), a(t.texelsPerMetre);
    a.each(t.layout.instances, [&](auto& i) { a(i.uv), a(i.backRows); });
}

/// What is kept under `key`, or nothing. `fields(archive, T)` lists T's fields.
template <class T, class Fields>
std::optional<T> kept(StageStore& store, std::uint64_t key, Fields fields) {
    if (const auto bytes = store.find(key)) {
        T value{};
        ByteReader reader(*bytes);
        fields(reader, value);
        if (reader.ok && reader.atEnd())
            return value;
    }
    return {};
}

/// What is kept under `key`; else what make() returns, kept from now on unless the bake was
/// cancelled meanwhile. `store` may be null.
template <class T, class Fields, class Make>
T keptOrMade(StageStore* store, std::uint64_t key, const Progress& progress, Fields fields,
             Make make) {
    if (store)
        if (std::optional<T> value = kept<T>(*store, key, fields))
            return std::move(*value);
    T value = make();
    if (store && !progress.cancelled()) {
        ByteWriter writer;
        fields(writer, std::as_const(value));
        store->put(key, writer.bytes);
    }
    return value;
}

} // namespace limn
