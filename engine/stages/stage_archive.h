// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/archive.h"
#include "engine/core/field_rule.h"
#include "engine/core/progress.h"
#include "engine/stages/stage_store.h"

#include <optional>
#include <utility>

namespace limn {

/// What is kept under `key`, or nothing where it breaks a rule: whoever can write to the folder
/// must not be able to lead a bake astray. `fields(archive, T)` lists T's fields and their rules.
template <class T, class Fields>
std::optional<T> kept(StageStore& store, std::uint64_t key, Fields fields) {
    if (const auto bytes = store.find(key)) {
        T value{};
        if (readFields(*bytes, [&](auto& archive) { fields(archive, value); }))
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
