// SPDX-License-Identifier: MIT
#include "editor_ui/document/light_angles.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/card.h"
#include "editor_ui/panels/color_field.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/file_browser.h"
#include "editor_ui/panels/inspector_panel.h"
#include "editor_ui/panels/profile_plot.h"
#include "editor_ui/panels/theme.h"
#include "engine/scene/light/photometry.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

static void colorRows(FieldEdit& edit, Light& light) {
    fieldLabel<Light>(edit, "Colour", "Linear Rec. 709; multiplies the strength", &Light::color);
    colorField("##color", light.color);
    fieldEdited(edit, "Light colour");
    float kelvin = nearestKelvin(light.color);
    fieldLabel("Temperature (K)",
               "Sets the colour of a black body. Shows the nearest temperature of a colour that "
               "was chosen otherwise [K]");
    if (ImGui::SliderFloat("##kelvin", &kelvin, 1700, 15000, "%.0f K",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        light.color = blackbodyColor(kelvin);
    fieldEdited(edit, "Light temperature");
}

/// A text field for the light's strength and colour, in any of the units that applyTyped() knows.
static void typedRow(FieldEdit& edit, Light& light) {
    TypedLight& typed = edit.state.typedLight;
    if (typed.light != edit.id)
        typed = {.light = edit.id};
    fieldLabel(
        "Type a value",
        "Strength and colour with their units, as in 800 lm, 12 cd, 5000 nits, 13 EV, 2700 K "
        "or 800 lm 2700 K. EV: at ISO 100, by a meter that faces the light. Enter applies");
    const bool entered = ImGui::InputTextWithHint(
        "##typed", light.kind == LightKind::Directional ? "13 EV 5500 K" : "800 lm 2700 K",
        &typed.text, ImGuiInputTextFlags_EnterReturnsTrue);
    if (entered) {
        const Result<void> applied = applyTyped(typed.text, light);
        typed.problem = applied ? std::string() : applied.error().message;
        if (applied)
            typed.text.clear();
    }
    fieldEdited(edit, "Light strength");
    if (!typed.problem.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, color::warning());
        ImGui::TextWrapped("%s", typed.problem.c_str());
        ImGui::PopStyleColor();
    }
}

static void strengthRows(FieldEdit& edit, Light& light) {
    const bool sun = light.kind == LightKind::Directional,
               rectangle = light.kind == LightKind::Rectangle;
    fieldLabel<Light>(edit,
                      sun         ? "Strength (lux)"
                      : rectangle ? "Radiance (nits)"
                                  : "Strength (cd)",
                      sun ? "Illuminance of a surface that faces the sun [lux]. Ctrl-click to type"
                      : rectangle
                          ? "Luminance of the rectangle; a larger one shines more light [nits]. "
                            "Ctrl-click to type"
                          : "Luminous intensity, with a profile that of its brightest "
                            "direction [cd]. Ctrl-click to type",
                      &Light::strength);
    ImGui::SliderFloat("##strength", &light.strength, 0, 1e5f,
                       sun         ? "%.2f lux"
                       : rectangle ? "%.2f nits"
                                   : "%.2f cd",
                       ImGuiSliderFlags_Logarithmic);
    fieldEdited(edit, "Light strength");
    if (sun) {
        typedRow(edit, light);
        return;
    }
    float flux = lumen(light);
    fieldLabel("Flux (lm)", "The same strength as luminous flux over all directions [lm]");
    if (ImGui::SliderFloat("##flux", &flux, 0, 1e6f, "%.1f lm", ImGuiSliderFlags_Logarithmic))
        light.strength = strengthForLumen(light, flux);
    fieldEdited(edit, "Light flux");
    typedRow(edit, light);
}

static void rollRow(FieldEdit& edit, Light& light, const char* tooltip) {
    float degrees = glm::degrees(light.roll);
    fieldLabel<Light>(edit, "Roll (\u00b0)", tooltip, &Light::roll);
    if (ImGui::SliderFloat("##roll", &degrees, -180, 180, "%.1f\u00b0"))
        light.roll = glm::radians(degrees);
    fieldEdited(edit, "Light roll");
}

/// The photometric file of a point or a spot, and its plot.
static void profileRows(FieldEdit& edit, Light& light) {
    fieldLabel<Light>(edit, "Profile",
                      "How the intensity varies with direction, from a photometric file of the "
                      "standard IES LM-63 (.ies)",
                      &Light::profile);
    if (ImGui::Button("Choose\u2026"))
        openProfileBrowser(edit.state, edit.id);
    wrappedTooltip("Opens a file; the light gets its intensity as well");
    if (light.profile) {
        ImGui::SameLine();
        if (ImGui::Button("Remove"))
            light.profile = {};
        wrappedTooltip("The light shines the same to all sides again");
    }
    fieldEdited(edit, "IES profile");
    if (!light.profile)
        return;
    fieldLabel("Luminaire", "The name that the file gives");
    elidedText(light.profile->name.empty() ? "unnamed" : light.profile->name,
               ImGui::GetContentRegionAvail().x);
    rollRow(edit, light, "Turns the profile about its axis [degrees]");
    profilePlot(light);
}

/// Where the light comes from: height above the horizon and compass direction.
static void directionRows(FieldEdit& edit, Light& light) {
    LightAngles angles = lightAngles(light.direction);
    fieldLabel<Light>(edit, "Elevation (\u00b0)",
                      "Height above the horizon of where the light comes from [degrees]",
                      [](const Light& l) { return lightAngles(l.direction).elevation; });
    if (ImGui::SliderFloat("##elevation", &angles.elevation, -kMaxElevation, kMaxElevation,
                           "%.1f\u00b0", ImGuiSliderFlags_AlwaysClamp))
        light.direction = lightDirection(angles);
    fieldEdited(edit, "Light elevation");
    fieldLabel<Light>(edit, "Azimuth (\u00b0)",
                      "Direction the light comes from, from +Z towards +X [degrees]",
                      [](const Light& l) { return lightAngles(l.direction).azimuth; });
    if (ImGui::SliderFloat("##azimuth", &angles.azimuth, -180, 180, "%.1f\u00b0",
                           ImGuiSliderFlags_AlwaysClamp))
        light.direction = lightDirection(angles);
    fieldEdited(edit, "Light azimuth");
}

static void spotRows(FieldEdit& edit, Light& light) {
    float outer = glm::degrees(light.outerAngle), inner = glm::degrees(light.innerAngle);
    fieldLabel<Light>(edit, "Cone (\u00b0)", "Half-angle where the light ends [degrees]",
                      &Light::outerAngle);
    if (ImGui::SliderFloat("##outer", &outer, 0.5f, 90, "%.1f\u00b0",
                           ImGuiSliderFlags_AlwaysClamp)) {
        light.outerAngle = std::min(glm::radians(outer), glm::half_pi<float>());
        light.innerAngle = std::min(light.innerAngle, 0.99f * light.outerAngle);
    }
    fieldEdited(edit, "Light cone");
    fieldLabel<Light>(edit, "Full inside (\u00b0)",
                      "Half-angle of full strength; softens towards the cone's edge [degrees]",
                      &Light::innerAngle);
    if (ImGui::SliderFloat("##inner", &inner, 0, 90, "%.1f\u00b0", ImGuiSliderFlags_AlwaysClamp))
        light.innerAngle = std::min(glm::radians(inner), 0.99f * light.outerAngle);
    fieldEdited(edit, "Light inner cone");
}

static void rectangleRows(FieldEdit& edit, Light& light) {
    fieldLabel<Light>(edit, "Size (m)",
                      "Width and height of the rectangle; its shadows soften with it [m]",
                      &Light::size);
    ImGui::DragFloat2("##size", &light.size.x, 0.01f, kMinLightSize, kMaxLightSize, "%.3f",
                      ImGuiSliderFlags_AlwaysClamp);
    fieldEdited(edit, "Light size");
    rollRow(edit, light, "Turns the rectangle about its direction [degrees]");
}

static void rangeRow(FieldEdit& edit, Light& light) {
    fieldLabel<Light>(edit, "Range (m)",
                      "Where the light fades to nothing; 0: reaches any distance [m]",
                      &Light::range);
    ImGui::SliderFloat("##range", &light.range, 0, 1000, light.range > 0 ? "%.2f m" : "unlimited",
                       ImGuiSliderFlags_Logarithmic);
    fieldEdited(edit, "Light range");
}

static void kindRows(FieldEdit& edit, Light& light) {
    fieldLabel<Light>(edit, "On", "Light that is off costs nothing (H)", &Light::enabled);
    ImGui::Checkbox("##on", &light.enabled);
    fieldEdited(edit, "Light on or off");
    int kind = int(light.kind);
    fieldLabel<Light>(
        edit, "Kind",
        "Sun: parallel rays. Point: all directions. Spot: a cone. Rectangle: one side "
        "of a surface, with soft shadows",
        &Light::kind);
    if (ImGui::Combo("##kind", &kind, "Sun\0Point\0Spot\0Rectangle\0"))
        light.kind = LightKind(kind);
    fieldEdited(edit, "Light kind");
}

static void placeRows(FieldEdit& edit, Light& light) {
    fieldLabel("Position (m)", light.kind == LightKind::Directional
                                   ? "Only where the icon stands: a sun shines everywhere [m]"
                                   : "In the coordinates of the scene file [m]");
    positionField("##position", light.position, edit.state.document.origin);
    fieldEdited(edit, "Move");
    if (hasDirection(light))
        directionRows(edit, light);
}

static void shapeRows(FieldEdit& edit, Light& light) {
    if (light.kind == LightKind::Spot)
        spotRows(edit, light);
    if (light.kind == LightKind::Rectangle)
        rectangleRows(edit, light);
    if (light.kind == LightKind::Point || light.kind == LightKind::Spot)
        rangeRow(edit, light);
}

void lightSection(FieldEdit& edit, Light& light) {
    if (card(edit.state, "Light"))
        kindRows(edit, light);
    if (card(edit.state, "Colour and strength")) {
        colorRows(edit, light);
        strengthRows(edit, light);
    }
    if (card(edit.state, "Place"))
        placeRows(edit, light);
    if (light.kind != LightKind::Directional && card(edit.state, "Shape and range"))
        shapeRows(edit, light);
    if ((light.kind == LightKind::Point || light.kind == LightKind::Spot) &&
        card(edit.state, "IES profile"))
        profileRows(edit, light);
}

} // namespace limn
