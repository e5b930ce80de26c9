// SPDX-License-Identifier: MIT
#include "tests/editor_ui/headless.h"

#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <stdexcept>

namespace limn {

HeadlessUi::HeadlessUi(float width, float height, float scale) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {width, height};
    io.DeltaTime = 1.f / 60;
    io.IniFilename = nullptr;
    io.ConfigDragClickToInputText = true; // lets Tab move between fields
    mapKeys();
    applyTheme();
    ImGui::GetStyle().ScaleAllSizes(scale);
    addFont(kFontPixels * scale, "");
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &w, &h);
}

HeadlessUi::~HeadlessUi() {
    ImGui::DestroyContext();
}

void HeadlessUi::frames(EditorState& state) {
    do {
        const auto pressed = feedInput(input);
        ImGui::NewFrame();
        drawEditor(state, pressed);
        ImGui::Render();
    } while (!input.events.empty());
}

void HeadlessUi::mouse(float x, float y) {
    input.events.push_back({.kind = InputEvent::Kind::MouseMove, .position = {x, y}});
}

void HeadlessUi::button(bool down, int which) {
    input.events.push_back({.kind = InputEvent::Kind::MouseButton, .code = which, .down = down});
}

void HeadlessUi::tap(int key, std::uint8_t mods) {
    input.events.push_back(
        {.kind = InputEvent::Kind::Key, .code = key, .down = true, .mods = mods});
    input.events.push_back(
        {.kind = InputEvent::Kind::Key, .code = key, .down = false, .mods = mods});
}

EditorState emptyEditor() {
    EditorState state;
    state.assets = std::make_shared<const Assets>();
    return state;
}

EditorState fullEditor() {
    EditorState state;
    auto assets = std::make_shared<Assets>();
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    mesh.indices = {0, 1, 2};
    assets->meshes.push_back(mesh);
    state.assets = assets;
    state.meshBounds = {{{-1, -1, 0}, {1, 1, 0}}};
    Document& d = state.document;
    Node group;
    group.name = "Group";
    group.transform.translation = {0, 1, 0};
    group.transform.scale = {2, 2, 2};
    const ObjectId groupId = addObject(d, group);
    for (const char* name : {"Left", "Right"}) {
        Node node;
        node.name = name;
        node.parent = groupId;
        node.meshes = {0};
        addObject(d, node);
    }
    for (LightKind kind :
         {LightKind::Directional, LightKind::Point, LightKind::Spot, LightKind::Rectangle}) {
        Light light;
        light.kind = kind;
        light.name = kind == LightKind::Point       ? "Lamp"
                     : kind == LightKind::Spot      ? "Torch"
                     : kind == LightKind::Rectangle ? "Panel"
                                                    : "Sun";
        light.position = {float(kind) - 1, 0.5f, 0};
        addObject(d, light);
    }
    Material stone;
    stone.name = "Stone";
    addObject(d, stone);
    Material glow;
    glow.name = "Glow";
    glow.emission = {3, 2, 1};
    addObject(d, glow);
    addObject(d, Camera{.name = "Shot", .eye = {0, 1, 6}, .target = {0, 1, 0}});
    addObject(d, Sky{});
    addObject(d, BakeSettings{});
    addObject(d, RelightSettings{});
    state.saved = d.objects;
    state.view.camera = {.eye = {0, 1, 6}, .target = {0, 1, 0}};
    return state;
}

ObjectId idNamed(const EditorState& state, const char* name) {
    for (const auto& [id, object] : state.document.objects)
        if (objectName(object) == name)
            return id;
    throw std::runtime_error(std::string("no object named ") + name);
}

} // namespace limn
