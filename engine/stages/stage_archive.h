// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/archive.h"
#include "engine/core/field_rule.h"
#include "engine/core/progress.h"
#include "engine/stages/stage_store.h"

#include <optional>
#include <utility>

namespace limn {

/// Reads the content kept under `key`. Returns std::nullopt if there is none or it breaks a rule,
/// so that nobody with write access to the folder can corrupt a bake. `fields(archive, T)` lists
/// T's fields and their rules.
template <class T, class Fields>
std::optional<T> kept(StageStore& store, std::uint64_t key, Fields fields) {
    if (const auto bytes = store.find(key)) {
        T value{};
        if (readFields(*bytes, [&](auto& archive) { fields(archive, value); }))
            return value;
    }
    return {};
}

/// Returns the content kept under `key`, or else the result of make(), which is then stored unless
/// the bake was cancelled meanwhile. `store` may be null.
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

/// Lists durations of stages by name [s].
template <class A, class Seconds>
void secondsFields(A& a, Seconds& seconds) {
    a.each("stages", seconds, rule::any, [&](auto& stage) {
        a("name", stage.first, rule::any), a("seconds", stage.second, rule::within(0, 1e9));
    });
}

} // namespace limn
