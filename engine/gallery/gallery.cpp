// SPDX-License-Identifier: MIT
#include "engine/gallery/gallery.h"

#include "engine/gallery/scene_maker.h"

namespace limn {

GeneratedScene generateScene(std::uint64_t seed) {
    return generateScene(SceneKind(seed % kSceneKindNames.size()), seed);
}

GeneratedScene generateScene(SceneKind kind, std::uint64_t seed) {
    SceneMaker maker(seed);
    switch (kind) {
    case SceneKind::Room:
        makeRoom(maker);
        break;
    case SceneKind::TwoRooms:
        makeTwoRooms(maker);
        break;
    case SceneKind::Court:
        makeCourt(maker);
        break;
    case SceneKind::Colonnade:
        makeColonnade(maker);
        break;
    case SceneKind::Street:
        makeStreet(maker);
        break;
    case SceneKind::Cave:
        makeCave(maker);
        break;
    case SceneKind::FurnishedBox:
        makeFurnishedBox(maker);
        break;
    case SceneKind::Blinds:
        makeBlinds(maker);
        break;
    case SceneKind::DoorAjar:
        makeDoorAjar(maker);
        break;
    case SceneKind::Lamps:
        makeLamps(maker);
        break;
    case SceneKind::HouseOnPlane:
        makeHouseOnPlane(maker);
        break;
    }
    GeneratedScene scene = maker.finish();
    scene.kind = kind;
    return scene;
}

} // namespace limn
