// SPDX-License-Identifier: MIT
#include "editor_ui/panels/icon.h"

#include <cmath>
#include <initializer_list>

namespace limn {

namespace {

/// A unit square around the icon's centre, y down.
struct Pen {
    ImDrawList& list;
    ImVec2 centre;
    float half;
    ImU32 color;
    float width;

    ImVec2 at(float x, float y) const { return {centre.x + x * half, centre.y + y * half}; }
    void line(float x0, float y0, float x1, float y1) const {
        list.AddLine(at(x0, y0), at(x1, y1), color, width);
    }
    void circle(float x, float y, float r) const {
        list.AddCircle(at(x, y), r * half, color, 0, width);
    }
    void rect(float x0, float y0, float x1, float y1) const {
        list.AddRect(at(x0, y0), at(x1, y1), color, 0, 0, width);
    }
};

} // namespace

static void rays(const Pen& pen, int count, float from, float to) {
    for (int i = 0; i < count; ++i) {
        const float a = 6.2831853f * float(i) / float(count);
        const float c = std::cos(a), s = std::sin(a);
        pen.line(c * from, s * from, c * to, s * to);
    }
}

static void eye(const Pen& pen) {
    pen.list.AddBezierQuadratic(pen.at(-1, 0), pen.at(0, -1.1f), pen.at(1, 0), pen.color,
                                pen.width);
    pen.list.AddBezierQuadratic(pen.at(-1, 0), pen.at(0, 1.1f), pen.at(1, 0), pen.color, pen.width);
}

/// Two strokes from a point back along both axes; dx, dy: +-1, where the corner points.
static void corner(const Pen& pen, float x, float y, float dx, float dy) {
    pen.line(x, y, x - 0.35f * dx, y);
    pen.line(x, y, x, y - 0.35f * dy);
}

void drawIcon(ImDrawList& list, Icon icon, ImVec2 centre, float size, ImU32 color) {
    const Pen pen{list, centre, size / 2, color, size >= 18 ? 1.8f : 1.3f};
    switch (icon) {
    case Icon::Group:
        pen.line(-0.7f, -0.6f, -0.7f, 0.6f);
        pen.line(-0.7f, -0.1f, 0.1f, -0.1f);
        pen.line(-0.7f, 0.6f, 0.1f, 0.6f);
        pen.circle(0.4f, -0.1f, 0.25f);
        pen.circle(0.4f, 0.6f, 0.25f);
        break;
    case Icon::Mesh:
        pen.rect(-0.75f, -0.35f, 0.35f, 0.75f);
        pen.line(-0.75f, -0.35f, -0.35f, -0.75f);
        pen.line(0.35f, -0.35f, 0.75f, -0.75f);
        pen.line(0.35f, 0.75f, 0.75f, 0.35f);
        pen.line(-0.35f, -0.75f, 0.75f, -0.75f);
        pen.line(0.75f, -0.75f, 0.75f, 0.35f);
        break;
    case Icon::Sun:
        pen.circle(0, 0, 0.38f);
        rays(pen, 8, 0.58f, 0.95f);
        break;
    case Icon::Point:
        pen.circle(0, -0.2f, 0.55f);
        pen.line(-0.25f, 0.5f, 0.25f, 0.5f);
        pen.line(-0.18f, 0.8f, 0.18f, 0.8f);
        break;
    case Icon::Spot:
        pen.line(0, -0.8f, -0.7f, 0.5f);
        pen.line(0, -0.8f, 0.7f, 0.5f);
        pen.list.AddBezierQuadratic(pen.at(-0.7f, 0.5f), pen.at(0, 1), pen.at(0.7f, 0.5f), color,
                                    pen.width);
        break;
    case Icon::Rectangle:
        pen.rect(-0.8f, -0.75f, 0.8f, -0.15f);
        for (float x : {-0.55f, 0.f, 0.55f})
            pen.line(x, 0.15f, x, 0.8f);
        break;
    case Icon::Material:
        pen.circle(0, 0, 0.75f);
        pen.list.AddBezierQuadratic(pen.at(-0.4f, -0.1f), pen.at(-0.35f, -0.45f), pen.at(0, -0.45f),
                                    color, pen.width);
        break;
    case Icon::Camera:
        pen.rect(-0.85f, -0.4f, 0.3f, 0.55f);
        pen.line(0.3f, 0, 0.85f, -0.35f);
        pen.line(0.3f, 0.15f, 0.85f, 0.5f);
        pen.line(0.85f, -0.35f, 0.85f, 0.5f);
        break;
    case Icon::Sky:
        pen.line(-0.9f, 0.5f, 0.9f, 0.5f);
        list.PathArcTo(pen.at(0, 0.5f), 0.75f * pen.half, 3.1415927f, 6.2831853f);
        list.PathStroke(color, 0, pen.width);
        break;
    case Icon::Settings:
        for (float y : {-0.55f, 0.f, 0.55f})
            pen.line(-0.8f, y, 0.8f, y);
        pen.circle(-0.3f, -0.55f, 0.2f);
        pen.circle(0.4f, 0, 0.2f);
        pen.circle(-0.1f, 0.55f, 0.2f);
        break;
    case Icon::Shown:
        eye(pen);
        list.AddCircleFilled(centre, 0.25f * pen.half, color);
        break;
    case Icon::Hidden:
        eye(pen);
        pen.line(-0.8f, 0.8f, 0.8f, -0.8f);
        break;
    case Icon::Pointer:
        pen.line(-0.5f, -0.8f, -0.5f, 0.5f);
        pen.line(-0.5f, -0.8f, 0.45f, 0.15f);
        pen.line(-0.5f, 0.5f, -0.15f, 0.2f);
        pen.line(0.45f, 0.15f, 0, 0.15f);
        pen.line(-0.15f, 0.2f, 0.1f, 0.75f);
        break;
    case Icon::Move:
        pen.line(-0.85f, 0, 0.85f, 0);
        pen.line(0, -0.85f, 0, 0.85f);
        for (const float way : {-1.f, 1.f}) {
            pen.line(0.85f * way, 0, 0.55f * way, -0.3f);
            pen.line(0.85f * way, 0, 0.55f * way, 0.3f);
            pen.line(0, 0.85f * way, -0.3f, 0.55f * way);
            pen.line(0, 0.85f * way, 0.3f, 0.55f * way);
        }
        break;
    case Icon::Rotate:
        list.PathArcTo(centre, 0.7f * pen.half, -0.6f, 4.4f);
        list.PathStroke(color, 0, pen.width);
        pen.line(0.58f, -0.4f, 0.72f, -0.85f);
        pen.line(0.58f, -0.4f, 0.15f, -0.5f);
        break;
    case Icon::Scale:
        pen.rect(-0.75f, 0.1f, -0.1f, 0.75f);
        pen.line(-0.1f, 0.1f, 0.75f, -0.75f);
        corner(pen, 0.75f, -0.75f, 1, -1);
        break;
    }
}

void iconItem(Icon icon, ImU32 color) {
    const float h = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy({h, h});
    drawIcon(*ImGui::GetWindowDrawList(), icon, {corner.x + h / 2, corner.y + h / 2}, h, color);
}

} // namespace limn
