// SPDX-License-Identifier: MIT
#include "editor_ui/document/material_edit.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/card.h"
#include "editor_ui/panels/color_field.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/file_browser.h"
#include "editor_ui/panels/inspector_panel.h"
#include "engine/scene/sky_sun.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

static void colorAndStrength(FieldEdit& edit, glm::vec3& radiance, const char* what,
                             const char* colorLabel, const char* strengthLabel,
                             const char* tooltip) {
    ImGui::PushID(colorLabel);
    float strength = std::max({radiance.x, radiance.y, radiance.z});
    glm::vec3 color = strength > 0 ? radiance / strength : glm::vec3(1);
    fieldLabel(colorLabel, "Linear Rec. 709, brightest component 1");
    if (colorField("##radianceColor", color))
        radiance = color * strength;
    fieldEdited(edit, what);
    fieldLabel(strengthLabel, tooltip);
    if (ImGui::SliderFloat("##radiance", &strength, 0, 1e5f, "%.3f nits",
                           ImGuiSliderFlags_Logarithmic))
        radiance = color * strength;
    fieldEdited(edit, what);
    ImGui::PopID();
}

static const char* textureTooltip(TextureSlot slot) {
    switch (slot) {
    case TextureSlot::BaseColor:
        return "Multiplies the base colour; sRGB, alpha cuts holes. PNG or JPEG";
    case TextureSlot::MetallicRoughness:
        return "Multiplies roughness by its green and metallic by its blue; linear. PNG or JPEG";
    case TextureSlot::Normal:
        return "Bends the normal in tangent space; linear. Needs tangents, which a glTF with a "
               "normal map has. PNG or JPEG";
    case TextureSlot::Emissive:
        return "Multiplies the emission; sRGB. PNG or JPEG";
    }
    return "";
}

/// The image of a texture, and buttons that replace and remove it.
static void textureRow(FieldEdit& edit, Material& material, TextureSlot slot) {
    EditorState& state = edit.state;
    const std::int32_t index = textureIn(material, slot).image;
    const bool there = index >= 0 && std::size_t(index) < state.assets->images.size();
    ImGui::PushID(int(slot));
    fieldLabel<Material>(edit, textureSlotName(slot), textureTooltip(slot),
                         [slot](Material m) { return textureIn(m, slot).image; });
    std::string text = "none";
    if (there) {
        const Image& image = state.assets->images[std::size_t(index)];
        text = image.name + ", " + std::to_string(image.width) + " \u00d7 " +
               std::to_string(image.height);
    }
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float cross = there ? ImGui::GetFrameHeight() + gap : 0;
    const float room = std::max(ImGui::GetContentRegionAvail().x - cross, 20.f);
    if (ImGui::Button((elided(text, room - 12) + "###choose").c_str(), {room, 0}))
        openTextureBrowser(state, edit.id, slot);
    wrappedTooltip(there ? (text + ". Click to choose another file").c_str()
                         : "Click to choose a file");
    if (there) {
        ImGui::SameLine(0, gap);
        if (ImGui::Button("x", {ImGui::GetFrameHeight(), 0})) {
            setTexture(state, edit.id, slot, -1);
            edit.seen = state.document.objects.at(edit.id);
        }
        wrappedTooltip("Removes the texture");
    }
    ImGui::PopID();
}

static void flipbookRows(FieldEdit& edit, Flipbook& flipbook) {
    int grid[2] = {int(flipbook.columns), int(flipbook.rows)};
    fieldLabel("Animation frames",
               "Columns and rows of frames in an animated emissive image, which "
               "plays row after row from the upper left [1, 256]");
    if (ImGui::DragInt2("##frames", grid, 0.05f, 1, 256, "%d", ImGuiSliderFlags_AlwaysClamp)) {
        flipbook.columns = std::uint32_t(grid[0]);
        flipbook.rows = std::uint32_t(grid[1]);
    }
    fieldEdited(edit, "Animation frames");
    fieldLabel("Speed (frames/s)", "0: the first frame stands still [0, 1000]");
    ImGui::SliderFloat("##speed", &flipbook.framesPerSecond, 0, 60, "%.1f");
    fieldEdited(edit, "Animation speed");
}

static void surfaceRows(FieldEdit& edit, Material& material) {
    fieldLabel<Material>(edit, "Base colour",
                         "Linear; multiplies the texture. Bounced light takes its colour",
                         &Material::baseColor);
    glm::vec3 base(material.baseColor);
    if (colorField("##base", base))
        material.baseColor = glm::vec4(base, material.baseColor.w);
    fieldEdited(edit, "Base colour");
    fieldLabel<Material>(edit, "Metallic",
                         "0: dielectric, 1: metal; metal sends no diffuse light [0, 1]",
                         &Material::metallic);
    ImGui::SliderFloat("##metallic", &material.metallic, 0, 1, "%.2f",
                       ImGuiSliderFlags_AlwaysClamp);
    fieldEdited(edit, "Metallic");
    fieldLabel<Material>(edit, "Roughness", "0: mirror, 1: matte [0, 1]", &Material::roughness);
    ImGui::SliderFloat("##roughness", &material.roughness, 0, 1, "%.2f",
                       ImGuiSliderFlags_AlwaysClamp);
    fieldEdited(edit, "Roughness");
    fieldLabel<Material>(edit, "Double sided",
                         "Seen and lit from both sides; changing it needs a new bake",
                         &Material::doubleSided);
    ImGui::Checkbox("##double", &material.doubleSided);
    fieldEdited(edit, "Double sided");
}

static void glassRows(FieldEdit& edit, Material& material) {
    fieldLabel<Material>(edit, "Transmission",
                         "Share of light that passes through and is tinted by the base colour; it "
                         "is taken from the diffuse share. Pictures on the CPU show what is "
                         "behind; the view here does not [0, 1]",
                         &Material::transmission);
    ImGui::SliderFloat("##transmission", &material.transmission, 0, 1, "%.2f",
                       ImGuiSliderFlags_AlwaysClamp);
    fieldEdited(edit, "Transmission");
    fieldLabel<Material>(edit, "Index of refraction",
                         "1: air, 1.33: water, 1.5: glass, 2.42: diamond. More reflects more, also "
                         "where nothing is transmitted [1, ...)",
                         &Material::ior);
    ImGui::DragFloat("##ior", &material.ior, 0.005f, 1, 100, "%.3f", ImGuiSliderFlags_AlwaysClamp);
    fieldEdited(edit, "Index of refraction");
    if (material.transmission == 0)
        return;
    bool isBody = material.thickness > 0;
    fieldLabel<Material>(edit, "Solid body",
                         "On: the mesh is closed and filled, and bends light. Off: a thin sheet, "
                         "which does not",
                         [](const Material& m) { return m.thickness > 0; });
    if (ImGui::Checkbox("##body", &isBody))
        material.thickness = isBody ? 1.f : 0.f;
    fieldEdited(edit, "Solid body");
}

static void emissionRows(FieldEdit& edit, Material& material) {
    if (isMixed<Material>(edit, &Material::emission))
        markMixed();
    colorAndStrength(edit, material.emission, "Emission", "Colour", "Emission (nits)",
                     "Radiance the surface sends out [nits]; lights the scene without a new bake");
    if (material.emissiveTexture.image >= 0)
        flipbookRows(edit, material.emissiveFlipbook);
}

void materialSection(FieldEdit& edit, Material& material) {
    if (card(edit.state, "Surface"))
        surfaceRows(edit, material);
    if (card(edit.state, "Glass"))
        glassRows(edit, material);
    if (card(edit.state, "Emission"))
        emissionRows(edit, material);
    if (!card(edit.state, "Textures"))
        return;
    for (const TextureSlot slot : kTextureSlots)
        textureRow(edit, material, slot);
}

static void skyImageRows(FieldEdit& edit, Sky& sky) {
    fieldLabel("Image", "A panorama in latitude and longitude, .hdr or .exr");
    const std::string file = sky.image.substr(sky.image.rfind('/') + 1);
    const std::string shown = !sky.panorama && !file.empty() ? file + " (not found)" : file;
    if (ImGui::Button("Choose\u2026"))
        openFileBrowser(edit.state, FileBrowser::Purpose::SkyImage);
    wrappedTooltip(sky.image.empty() ? "Opens a panorama" : sky.image.c_str());
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    elidedText(shown.empty() ? "none" : shown, ImGui::GetContentRegionAvail().x);
    const bool hasSun = sky.panorama && !sky.image.ends_with(kWithoutSun);
    fieldLabel("Sun",
               "The sky's light is summed over cells of ten degrees, which blurs the shadows "
               "of a sun. As a light of its own it casts sharp ones");
    ImGui::BeginDisabled(!hasSun);
    if (ImGui::Button("Make it a light"))
        edit.state.requests.push_back({Request::Kind::ExtractSun, {}});
    ImGui::EndDisabled();
    wrappedTooltip(hasSun
                       ? "Cuts the sun out of the image and adds a sun of its direction, colour "
                         "and illuminance [lux]"
                       : "The image has no sun any more; undo or choose it again to put it back");
    fieldLabel("Strength", "Factor of the image's radiance");
    ImGui::SliderFloat("##strength", &sky.strength, 0, 100, "%.3f", ImGuiSliderFlags_Logarithmic);
    fieldEdited(edit, "Sky strength");
    float degrees = glm::degrees(sky.rotation);
    fieldLabel("Rotation (\u00b0)",
               "Turns the image about the vertical; lights the scene without a new bake [degrees]");
    if (ImGui::SliderFloat("##rotation", &degrees, -180, 180, "%.1f\u00b0"))
        sky.rotation = glm::radians(degrees);
    fieldEdited(edit, "Sky rotation");
}

void skySection(FieldEdit& edit, Sky& sky) {
    int kind = int(sky.kind);
    fieldLabel("Kind", "How the sky's light is given. Changing it needs no new bake");
    if (ImGui::Combo("##kind", &kind, "Colour\0Gradient\0Image\0"))
        sky.kind = SkyKind(kind);
    fieldEdited(edit, "Sky kind");
    switch (sky.kind) {
    case SkyKind::Color:
        colorAndStrength(
            edit, sky.radiance, "Sky", "Colour", "Radiance (nits)",
            "The same from every direction [nits]; lights the scene without a new bake");
        break;
    case SkyKind::Gradient:
        colorAndStrength(edit, sky.radiance, "Sky", "Up", "Up (nits)", "Straight up [nits]");
        colorAndStrength(edit, sky.horizon, "Sky", "Horizon", "Horizon (nits)",
                         "From the horizon [nits]");
        colorAndStrength(edit, sky.ground, "Sky", "Down", "Down (nits)", "Straight down [nits]");
        break;
    case SkyKind::Image:
        skyImageRows(edit, sky);
        break;
    }
}

void cameraSection(FieldEdit& edit, Camera& camera) {
    fieldLabel("Eye (m)", "In the coordinates of the scene file [m]");
    positionField("##eye", camera.eye, edit.state.document.origin);
    fieldEdited(edit, "Camera position");
    fieldLabel("Target (m)", "The point looked at, in the coordinates of the scene file [m]");
    positionField("##target", camera.target, edit.state.document.origin);
    fieldEdited(edit, "Camera target");
    float degrees = glm::degrees(camera.fovY);
    fieldLabel("Field of view (\u00b0)", "Vertical, from edge to edge [degrees]");
    if (ImGui::SliderFloat("##fov", &degrees, 1, 150, "%.1f\u00b0", ImGuiSliderFlags_AlwaysClamp))
        camera.fovY = glm::radians(degrees);
    fieldEdited(edit, "Field of view");
    ImGui::Spacing();
    if (ImGui::Button("Look through it", {-FLT_MIN, 0}))
        edit.state.view.camera = camera;
    wrappedTooltip("Shows the picture of this camera (Numpad 0)");
    if (ImGui::Button("Move to the view", {-FLT_MIN, 0})) {
        const std::string name = camera.name;
        camera = edit.state.view.camera;
        camera.name = name;
    }
    wrappedTooltip("Moves this camera to where the picture is seen from");
    fieldEdited(edit, "Camera from view");
}

} // namespace limn
