// SPDX-License-Identifier: MIT
// What fuzzers do with accepted scenes and bakes beyond checking them: nothing.
#include "tests/fuzz/exercise.h"

namespace limn {

void bakeAndLight(const Scene&) {}

void light(const Scene&, const Bake&) {}

} // namespace limn
