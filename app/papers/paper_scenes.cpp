// SPDX-License-Identifier: MIT
#include "app/papers/paper_experiments.h"

namespace limn {

const PaperScene kPaperSponza = {.name = "Sponza",
                                 .file = "sponza-crytek/Sponza.gltf",
                                 .light = "sun dir=0.2,-1,-0.1 lux=20",
                                 .view = PaperScene::View{{7, 2, -0.3}, {-5, 4, -0.3}}};

} // namespace limn
