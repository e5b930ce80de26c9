// SPDX-License-Identifier: MIT
// Gizmos and handles as a user drags them, without a window.
#include "editor_ui/view/gizmo.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/drop_to_surface.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/view/light_handles.h"
#include "tests/editor_ui/cornell_view.h"
#include "tests/editor_ui/headless.h"

#include <imgui.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace limn::gizmo_test {
namespace {

struct GizmoTest : testing::Test {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const Document before = state.document;

    void select(const char* name) {
        state.selection = {idNamed(state, name)};
        settle();
    }
    void settle() {
        for (int i = 0; i < 4; ++i)
            ui.frames(state);
    }
    void moveTo(glm::vec2 to) {
        ui.mouse(to.x, to.y);
        ui.frames(state);
    }
    void press(glm::vec2 at) {
        moveTo(at);
        ui.button(true);
        ui.frames(state);
    }
    void release() {
        ui.button(false);
        settle();
    }
    void drag(glm::vec2 from, glm::vec2 to) {
        press(from);
        moveTo(to);
        release();
    }
    void key(int code, std::uint8_t mods = kNoMods) {
        ui.tap(code, mods);
        ui.frames(state);
    }
    void hold(int code, std::uint8_t mods, bool down) {
        ui.input.events.push_back({.kind = InputEvent::Kind::Key,
                                   .code = code,
                                   .down = down,
                                   .mods = down ? mods : std::uint8_t(kNoMods)});
        ui.frames(state);
    }
    void type(const std::string& text) {
        for (char c : text) {
            ui.input.events.push_back({.kind = InputEvent::Kind::Character, .code = c});
            ui.frames(state);
        }
    }
    glm::vec2 pixel(glm::vec3 p) const { return *toPixel(state.view.picture(), p); }
    glm::vec3 origin() const { return *selectionOrigin(state); }
    float length() const { return arrowLength(state.view.picture(), origin()); }
    /// A point of the ring about Z.
    glm::vec3 onRing(float angle) const {
        return origin() + glm::vec3(std::cos(angle), std::sin(angle), 0) * length();
    }
    /// Width of a pixel at the gizmo; ImGui rounds the mouse to whole ones [m].
    float pixelWidth() const { return length() / 90; }
    glm::vec2 middle() const { return state.view.origin + state.view.size * 0.5f; }

    template <class T>
    const T& get(const char* name) {
        return std::get<T>(state.document.objects.at(idNamed(state, name)));
    }
    void expectOneEdit(const char* label) {
        ASSERT_EQ(state.history.edits.size(), 1u);
        EXPECT_EQ(state.history.edits[0].label, label);
        const Document after = state.document;
        undoEdit(state);
        EXPECT_EQ(state.document, before);
        redoEdit(state);
        EXPECT_EQ(state.document, after);
    }
};

TEST_F(GizmoTest, KeysChooseTheTool) {
    settle();
    const std::pair<char, Tool> tools[] = {
        {'E', Tool::Rotate}, {'R', Tool::Scale}, {'W', Tool::Move}, {'Q', Tool::Select}};
    for (const auto& [letter, tool] : tools) {
        key(key::of(letter));
        EXPECT_EQ(state.view.tool, tool);
    }
}

TEST_F(GizmoTest, DraggingARingTurnsTheNodeInOneStep) {
    select("Left");
    state.view.tool = Tool::Rotate;
    const glm::quat start = get<Node>("Left").transform.rotation;
    // The ring about Z faces the eye. A pixel is a 90th of a radian there.
    drag(pixel(onRing(0.6f)), pixel(onRing(1.1f)));
    const glm::quat turned = get<Node>("Left").transform.rotation;
    const glm::quat expected = glm::angleAxis(0.5f, glm::vec3(0, 0, 1)) * start;
    EXPECT_NEAR(glm::angle(turned * glm::inverse(expected)), 0, 0.03f);
    expectOneEdit("Rotate");
}

TEST_F(GizmoTest, DraggingTheEndOfAnAxisScalesAlongIt) {
    select("Left");
    state.view.tool = Tool::Scale;
    const glm::vec3 at = origin();
    drag(pixel(at + glm::vec3(length(), 0, 0)), pixel(at + glm::vec3(1.5f * length(), 0, 0)));
    const glm::vec3 s = get<Node>("Left").transform.scale;
    EXPECT_NEAR(s.x, 1.5f, 2.f / 90);
    EXPECT_EQ(s.y, 1);
    EXPECT_EQ(s.z, 1);
    expectOneEdit("Scale");
}

TEST_F(GizmoTest, ScaleNeverBecomesZero) {
    select("Left");
    state.view.tool = Tool::Scale;
    const glm::vec3 at = origin();
    press(pixel(at + glm::vec3(length(), 0, 0)));
    for (float t : {0.2f, 0.f, -0.3f, 0.f}) {
        moveTo(pixel(at + glm::vec3(t * length(), 0, 0)));
        EXPECT_GT(std::abs(get<Node>("Left").transform.scale.x), 1e-3f) << t;
    }
    type("0");
    EXPECT_GT(std::abs(get<Node>("Left").transform.scale.x), 1e-3f);
    release();
}

TEST_F(GizmoTest, CtrlSnapsToTheStep) {
    select("Left");
    state.view.tool = Tool::Rotate;
    state.view.gizmo.rotateStep = 30;
    press(pixel(onRing(0.6f)));
    hold(key::kLeftControl, kCtrl, true);
    moveTo(pixel(onRing(1.2f))); // 34 degrees on
    const glm::quat turned = get<Node>("Left").transform.rotation;
    EXPECT_NEAR(glm::degrees(2 * std::atan2(turned.z, turned.w)), 30, 0.01f);
    hold(key::kLeftControl, kCtrl, false);
    release();
    expectOneEdit("Rotate");
}

TEST_F(GizmoTest, TheStepOfMoveIsInMetres) {
    select("Lamp");
    state.view.gizmo.moveStep = 0.25f;
    state.view.gizmo.snap = true;
    const glm::vec3 at = origin();
    drag(pixel(at + glm::vec3(0.8f * length(), 0, 0)),
         pixel(at + glm::vec3(0.8f * length() + 0.6f, 0, 0)));
    EXPECT_NEAR(get<Light>("Lamp").position.x - at.x, 0.5f, 1e-4f);
}

TEST_F(GizmoTest, GThenAnAxisAndANumberMovesExactly) {
    select("Lamp");
    moveTo(middle());
    const glm::vec3 from = get<Light>("Lamp").position;
    key(key::of('G'));
    ASSERT_TRUE(state.view.drag);
    moveTo(middle() + glm::vec2(40, 25)); // follows the mouse until something is typed
    EXPECT_GT(get<Light>("Lamp").position.x, from.x);
    type("y1.5");
    EXPECT_NEAR(glm::length(get<Light>("Lamp").position - from - glm::vec3(0, 1.5f, 0)), 0, 1e-5f);
    type("-"); // anywhere in the number
    EXPECT_NEAR(get<Light>("Lamp").position.y - from.y, -1.5f, 1e-5f);
    key(key::kBackspace);
    EXPECT_NEAR(get<Light>("Lamp").position.y - from.y, -1, 1e-5f);
    key(key::kEnter);
    settle();
    EXPECT_FALSE(state.view.drag);
    expectOneEdit("Move");
}

TEST_F(GizmoTest, BlendersRTurnsByTypedDegrees) {
    select("Left");
    moveTo(middle());
    runAction(state, actionById("gizmo.blender_keys"));
    key(key::of('R'));
    type("z90");
    key(key::kEnter);
    settle();
    const glm::quat q = get<Node>("Left").transform.rotation;
    EXPECT_NEAR(glm::degrees(2 * std::atan2(q.z, q.w)), 90, 1e-3f);
    expectOneEdit("Rotate");
    EXPECT_EQ(shortcutText(shortcutOf(state, actionById("grab.rotate"))), "R");
    EXPECT_EQ(shortcutText(shortcutOf(state, actionById("tool.scale"))), "");
}

TEST_F(GizmoTest, SScalesEvenlyByATypedFactorAboutTheMiddleOfAll) {
    state.selection = {idNamed(state, "Lamp"), idNamed(state, "Torch")}; // at x = 0 and 1
    settle();
    moveTo(middle());
    key(key::of('S'));
    type("3");
    key(key::kEnter);
    settle();
    EXPECT_NEAR(get<Light>("Lamp").position.x, -1, 1e-5f);
    EXPECT_NEAR(get<Light>("Torch").position.x, 2, 1e-5f);
    expectOneEdit("Scale");
}

TEST_F(GizmoTest, EscAndTheRightButtonTakeAGrabBack) {
    select("Lamp");
    for (const bool byKey : {true, false}) {
        moveTo(middle());
        key(key::of('G'));
        moveTo(middle() + glm::vec2(60, 10));
        EXPECT_NE(state.document, before);
        if (byKey) {
            key(key::kEscape);
        } else {
            ui.button(true, 1);
            ui.frames(state);
            ui.button(false, 1);
        }
        settle();
        EXPECT_EQ(state.document, before) << byKey;
        EXPECT_FALSE(state.view.drag);
        EXPECT_TRUE(state.history.edits.empty());
        EXPECT_EQ(state.selection.size(), 1u);
    }
}

TEST_F(GizmoTest, AClickEndsAGrabAndSelectsNothing) {
    select("Lamp");
    moveTo(middle());
    key(key::of('G'));
    press(middle() + glm::vec2(60, 10));
    release();
    EXPECT_FALSE(state.view.drag);
    EXPECT_EQ(state.selection, std::vector{idNamed(state, "Lamp")});
    expectOneEdit("Move");
}

TEST_F(GizmoTest, LettersDuringADragRunNoAction) {
    select("Lamp");
    moveTo(middle());
    key(key::of('G'));
    key(key::of('H'));
    key(key::kDelete);
    EXPECT_TRUE(state.view.drag);
    EXPECT_TRUE(get<Light>("Lamp").enabled);
    key(key::kEscape);
    EXPECT_EQ(state.document, before);
}

TEST_F(GizmoTest, AltOnAHandleDragsACopyInOneStep) {
    select("Group");
    const glm::vec3 at = origin();
    const glm::vec3 grip(0.8f * length(), 0, 0);
    hold(key::kLeftAlt, kAlt, true);
    press(pixel(at + grip));
    EXPECT_EQ(state.document, before);
    moveTo(pixel(at + grip + glm::vec3(1, 0, 0)));
    release();
    hold(key::kLeftAlt, kNoMods, false);
    EXPECT_EQ(state.view.camera.eye, (glm::vec3{0, 1, 6})) << "Alt orbits elsewhere only";
    EXPECT_EQ(state.document.objects.size(), before.objects.size() + 3);
    EXPECT_EQ(get<Node>("Group"), std::get<Node>(before.objects.at(idNamed(state, "Group"))));
    const Node& copy = get<Node>("Group 2");
    EXPECT_NEAR(copy.transform.translation.x, 1, 2 * pixelWidth());
    EXPECT_EQ(state.selection, std::vector{idNamed(state, "Group 2")});
    expectOneEdit("Move");
}

TEST_F(GizmoTest, EscTakesADraggedCopyBack) {
    select("Group");
    const glm::vec3 at = origin();
    const glm::vec3 grip(0.8f * length(), 0, 0);
    hold(key::kLeftAlt, kAlt, true);
    press(pixel(at + grip));
    moveTo(pixel(at + grip + glm::vec3(1, 0, 0)));
    EXPECT_NE(state.document, before);
    key(key::kEscape);
    EXPECT_EQ(state.document, before);
    release();
    EXPECT_TRUE(state.history.edits.empty());
    EXPECT_EQ(state.selection, std::vector{idNamed(state, "Group")});
}

TEST_F(GizmoTest, LocalAxesAreThoseOfTheActiveObject) {
    auto& torch = std::get<Light>(state.document.objects.at(idNamed(state, "Torch")));
    torch.direction = glm::normalize(glm::vec3(1, 0, -1));
    select("Torch");
    runAction(state, actionById("gizmo.local"));
    moveTo(middle());
    const glm::vec3 from = torch.position;
    key(key::of('G'));
    type("z-2"); // Z points backwards
    key(key::kEnter);
    settle();
    EXPECT_NEAR(glm::length(torch.position - from - 2.f * torch.direction), 0, 1e-5f);
}

/// Drags the grip of a part of a light by `by` pixels.
void dragGrip(GizmoTest& t, const char* name, LightPart part, glm::vec2 by) {
    t.select(name);
    for (const LightGrip& grip : lightGrips(t.state.view.picture(), t.get<Light>(name)))
        if (grip.part == part) {
            t.drag(t.pixel(grip.position), t.pixel(grip.position) + by);
            return;
        }
    FAIL() << name;
}

TEST_F(GizmoTest, TheConesGripsSetTheAngles) {
    state.view.tool = Tool::Select;
    const float outer = get<Light>("Torch").outerAngle;
    select("Torch");
    // The torch shines down: its cone widens to the side of the grip.
    const auto picture = state.view.picture();
    const auto grips = lightGrips(picture, get<Light>("Torch"));
    const glm::vec3 tip = grips[0].position, rim = grips[1].position;
    const float reach = glm::length(tip - get<Light>("Torch").position);
    const glm::vec3 side = glm::normalize(rim - get<Light>("Torch").position -
                                          glm::vec3(0, -1, 0) * reach * std::cos(outer));
    const auto onCone = [&](float angle) {
        return get<Light>("Torch").position +
               reach * (glm::vec3(0, -1, 0) * std::cos(angle) + side * std::sin(angle));
    };
    drag(pixel(onCone(outer)), pixel(onCone(0.4f)));
    EXPECT_NEAR(get<Light>("Torch").outerAngle, 0.4f, 2 * pixelWidth() / reach);
    EXPECT_LE(get<Light>("Torch").innerAngle, 0.4f);
    expectOneEdit("Light cone");
}

TEST_F(GizmoTest, TheInnerConeStaysWithinTheOuterOne) {
    state.view.tool = Tool::Select;
    dragGrip(*this, "Torch", LightPart::InnerCone, {-300, -200});
    const Light& torch = get<Light>("Torch");
    EXPECT_GT(torch.innerAngle, 0.5f);
    EXPECT_LT(torch.innerAngle, torch.outerAngle);
}

TEST_F(GizmoTest, TheWidthsGripMovesTheEdgeWithTheMouse) {
    state.view.tool = Tool::Select;
    auto& panel = std::get<Light>(state.document.objects.at(idNamed(state, "Panel")));
    panel.direction = {0, 0, 1}; // towards the eye
    panel.position = {0, 1, 0};
    select("Panel");
    const glm::vec3 edge = panel.position + glm::vec3(0.5f, 0, 0);
    const bool right = lightGrips(state.view.picture(), panel)[1].position.x > 0;
    const float sign = right ? 1.f : -1.f;
    drag(pixel({sign * edge.x, edge.y, 0}), pixel({sign * 0.9f, edge.y, 0}));
    EXPECT_NEAR(panel.size.x, 1.8f, 4 * pixelWidth());
    EXPECT_EQ(panel.size.y, 1);
    ASSERT_EQ(state.history.edits.size(), 1u);
    EXPECT_EQ(state.history.edits[0].label, "Light size");
}

TEST_F(GizmoTest, TheRangesGripSetsTheRangeAndNeverMakesItUnlimited) {
    state.view.tool = Tool::Select;
    auto& lamp = std::get<Light>(state.document.objects.at(idNamed(state, "Lamp")));
    lamp.range = 1;
    select("Lamp");
    const glm::vec3 at = lamp.position;
    drag(pixel(at + glm::vec3(1, 0, 0)), pixel(at + glm::vec3(1.5f, 0, 0)));
    EXPECT_NEAR(lamp.range, 1.5f, 2 * pixelWidth());
    drag(pixel(at + glm::vec3(1.5f, 0, 0)), pixel(at));
    EXPECT_GT(lamp.range, 0);
    EXPECT_LT(lamp.range, 0.05f);
}

TEST_F(GizmoTest, EscTakesALightsHandleBack) {
    state.view.tool = Tool::Select;
    select("Torch");
    const glm::vec2 tip = pixel(lightGrips(state.view.picture(), get<Light>("Torch"))[0].position);
    press(tip);
    moveTo(tip + glm::vec2(70, -20));
    EXPECT_NE(state.document, before);
    key(key::kEscape);
    EXPECT_EQ(state.document, before);
    release();
    EXPECT_TRUE(state.history.edits.empty());
}

struct CornellGizmoTest : testing::Test {
    CornellView view;
    EditorState& state = view.state;

    ObjectId addedLight(glm::vec3 position) {
        Light light;
        light.position = position;
        return addLight(state, light);
    }
};

TEST_F(CornellGizmoTest, ADirectionIsDraggedToWhatTheLightShallHit) {
    const Light spot{.kind = LightKind::Spot, .position = state.sceneBounds.centre()};
    const glm::vec3 aim(0.5f, 0, -0.5f);
    const auto after = draggedLight(state.view.picture(), spot, LightPart::Direction, {}, {}, aim);
    ASSERT_TRUE(after);
    EXPECT_NEAR(glm::length(after->direction - glm::normalize(aim - spot.position)), 0, 1e-6f);
}

TEST_F(CornellGizmoTest, AnObjectDropsOntoWhatIsBelowIt) {
    for (const Mesh& mesh : state.assets->meshes)
        state.meshBounds.push_back(boundsOf(mesh.positions));
    const ObjectId box = idNamed(state, "Short block");
    const float stood = boundsOf(state, box)->lower.y;
    Object& object = state.document.objects.at(box);
    object = manipulated(state.document, object, {.move = {0, 0.3f, 0}});
    state.trace = std::make_shared<const TraceScene>(flatten(state.document, state.assets));
    state.selection = {box};
    const Document lifted = state.document;
    dropSelection(state);
    EXPECT_NEAR(boundsOf(state, box)->lower.y, stood, 0.02f);
    ASSERT_EQ(state.history.edits.size(), 1u);
    undoEdit(state);
    EXPECT_EQ(state.document, lifted);
}

TEST_F(CornellGizmoTest, ALampDropsToJustAboveTheFloor) {
    const glm::vec3 centre = state.sceneBounds.centre();
    const ObjectId lamp = addedLight({centre.x, centre.y, state.sceneBounds.upper.z - 0.1f});
    dropSelection(state);
    const float height = std::get<Light>(state.document.objects.at(lamp)).position.y;
    EXPECT_GT(height, state.sceneBounds.lower.y);
    EXPECT_LT(height, state.sceneBounds.lower.y + 0.05f * state.sceneBounds.size().y);
}

TEST_F(CornellGizmoTest, NothingBelowMeansThatItStays) {
    addedLight(state.sceneBounds.lower - glm::vec3(5));
    const Document before = state.document;
    dropSelection(state);
    EXPECT_EQ(state.document, before);
    EXPECT_EQ(state.history.edits.size(), 1u);
}

} // namespace
} // namespace limn::gizmo_test
