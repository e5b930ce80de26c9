// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

namespace limn {

/// A room of 4 x 3 x 4 m with a window of `width` x 1 m in the middle of its wall at x = 0; without
/// width the wall is closed.
inline Scene roomWithWindow(float width) {
    using namespace simple;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    const float low = 2 - width / 2, high = 2 + width / 2;
    b.add(quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}));
    b.add(quad({0, 3, 0}, {4, 0, 0}, {0, 0, 4}));
    b.add(quad({4, 0, 0}, {0, 0, 4}, {0, 3, 0}));
    b.add(quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}));
    b.add(quad({0, 0, 4}, {0, 3, 0}, {4, 0, 0}));
    b.add(quad({0, 0, 0}, {0, 1, 0}, {0, 0, 4}));
    b.add(quad({0, 2, 0}, {0, 1, 0}, {0, 0, 4}));
    b.add(quad({0, 1, 0}, {0, 1, 0}, {0, 0, low}));
    if (width > 0)
        b.add(quad({0, 1, high}, {0, 1, 0}, {0, 0, 4 - high}));
    else
        b.add(quad({0, 1, low}, {0, 1, 0}, {0, 0, 4 - low}));
    return b.build();
}

} // namespace limn
