// SPDX-License-Identifier: MIT
#include "tests/journeys/screen_text.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace limn {

namespace {

/// Coverage of the pixels by the text's glyphs, without empty rows and columns around it.
struct TextMask {
    int left = 0, top = 0; ///< of the mask, from where the text is drawn [px]
    int width = 0, height = 0;
    std::vector<float> coverage; ///< width * height, mean 0
    float norm = 0;              ///< length of `coverage` as a vector
};

/// Bilinear lookup of the font atlas at (x, y) [texels].
float sampled(const unsigned char* alpha, int width, int height, float x, float y) {
    const auto texel = [&](int column, int row) {
        column = std::clamp(column, 0, width - 1);
        row = std::clamp(row, 0, height - 1);
        return float(alpha[row * width + column]) / 255;
    };
    const int column = int(std::floor(x - 0.5f)), row = int(std::floor(y - 0.5f));
    const float u = x - 0.5f - float(column), v = y - 0.5f - float(row);
    return (texel(column, row) * (1 - u) + texel(column + 1, row) * u) * (1 - v) +
           (texel(column, row + 1) * (1 - u) + texel(column + 1, row + 1) * u) * v;
}

/// Draws one glyph, a quad whose corners 0 and 2 lie opposite, into `pixels`.
void drawGlyph(const ImDrawVert* quad, std::vector<float>& pixels, int width, int height) {
    unsigned char* alpha = nullptr;
    int atlasWidth = 0, atlasHeight = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&alpha, &atlasWidth, &atlasHeight);
    const ImVec2 from = quad[0].pos, to = quad[2].pos, uvFrom = quad[0].uv, uvTo = quad[2].uv;
    for (int y = std::max(int(from.y), 0); y < std::min(int(std::ceil(to.y)), height); ++y)
        for (int x = std::max(int(from.x), 0); x < std::min(int(std::ceil(to.x)), width); ++x) {
            const float s = (float(x) + 0.5f - from.x) / (to.x - from.x),
                        t = (float(y) + 0.5f - from.y) / (to.y - from.y);
            if (s < 0 || s >= 1 || t < 0 || t >= 1)
                continue;
            float& pixel = pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)];
            pixel =
                std::max(pixel, sampled(alpha, atlasWidth, atlasHeight,
                                        (uvFrom.x + s * (uvTo.x - uvFrom.x)) * float(atlasWidth),
                                        (uvFrom.y + t * (uvTo.y - uvFrom.y)) * float(atlasHeight)));
        }
}

TextMask maskOf(const std::string& text) {
    const ImFont* font = ImGui::GetIO().Fonts->Fonts[0];
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text.c_str());
    const int width = int(size.x) + 2, height = int(size.y) + 2;
    std::vector<float> pixels(std::size_t(width) * std::size_t(height));
    ImDrawList list(ImGui::GetDrawListSharedData());
    list._ResetForNewFrame();
    list.PushClipRect({0, 0}, {float(width), float(height)});
    list.PushTextureID(ImGui::GetIO().Fonts->TexID);
    list.AddText(font, font->FontSize, {0, 0}, IM_COL32_WHITE, text.c_str());
    for (int i = 0; i + 3 < list.VtxBuffer.Size; i += 4)
        drawGlyph(&list.VtxBuffer[i], pixels, width, height);

    int left = width, right = -1, top = height, bottom = -1;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)] > 0.1f) {
                left = std::min(left, x), right = std::max(right, x);
                top = std::min(top, y), bottom = std::max(bottom, y);
            }
    TextMask mask{.left = left, .top = top, .width = right - left + 1, .height = bottom - top + 1};
    double sum = 0;
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            mask.coverage.push_back(pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]);
            sum += double(mask.coverage.back());
        }
    double squares = 0;
    for (float& c : mask.coverage) {
        c -= float(sum / double(mask.coverage.size()));
        squares += double(c) * double(c);
    }
    mask.norm = float(std::sqrt(squares));
    return mask;
}

/// Luminance of the screen, with sums over all pixels above and left of each, to find the mean and
/// the variance of any rectangle.
struct Luminance {
    int width, height;
    std::vector<float> pixels;
    std::vector<double> sums, squares; ///< (width + 1) * (height + 1)

    explicit Luminance(const Image& screen)
        : width(int(screen.width)), height(int(screen.height)),
          pixels(std::size_t(width) * std::size_t(height)),
          sums(std::size_t(width + 1) * std::size_t(height + 1)), squares(sums.size()) {
        const std::size_t stride = std::size_t(width) + 1;
        for (std::size_t y = 0; y < std::size_t(height); ++y)
            for (std::size_t x = 0; x < std::size_t(width); ++x) {
                const std::size_t at = y * std::size_t(width) + x;
                const std::uint8_t* p = screen.rgba.data() + at * 4;
                pixels[at] = 0.2126f * float(p[0]) + 0.7152f * float(p[1]) + 0.0722f * float(p[2]);
                const double l = double(pixels[at]);
                const std::size_t to = (y + 1) * stride + x + 1;
                sums[to] = l + sums[to - 1] + sums[to - stride] - sums[to - stride - 1];
                squares[to] =
                    l * l + squares[to - 1] + squares[to - stride] - squares[to - stride - 1];
            }
    }

    double over(const std::vector<double>& table, int x, int y, int w, int h) const {
        const auto at = [&](int column, int row) {
            return table[std::size_t(row) * (std::size_t(width) + 1) + std::size_t(column)];
        };
        return at(x + w, y + h) - at(x, y + h) - at(x + w, y) + at(x, y);
    }
};

/// Absolute correlation of the screen at (x, y) with the mask, in [0, 1]. Text may be brighter or
/// darker than its background.
float likeness(const Luminance& screen, const TextMask& mask, int x, int y) {
    const double count = double(mask.coverage.size());
    const double sum = screen.over(screen.sums, x, y, mask.width, mask.height);
    const double spread =
        screen.over(screen.squares, x, y, mask.width, mask.height) - sum * sum / count;
    constexpr double kEven = 25; // the variance of a ground, in squares of 1/255 of white
    if (spread < kEven * count)
        return 0;
    float product = 0;
    for (int row = 0; row < mask.height; ++row) {
        const float* from = screen.pixels.data() +
                            std::size_t(y + row) * std::size_t(screen.width) + std::size_t(x);
        const float* with = mask.coverage.data() + std::size_t(row) * std::size_t(mask.width);
        for (int column = 0; column < mask.width; ++column)
            product += from[column] * with[column];
    }
    return std::abs(product) / float(std::sqrt(spread)) / mask.norm;
}

} // namespace

std::vector<ScreenRect> findText(const Image& screen, const std::string& text,
                                 const ScreenRect& within) {
    const TextMask mask = maskOf(text);
    const Luminance luminance(screen);
    ScreenRect area = within;
    if (area.size.x <= 0)
        area = {{0, 0}, {float(screen.width), float(screen.height)}};
    const int left = std::max(int(area.origin.x), 0), top = std::max(int(area.origin.y), 0);
    const int right = std::min(int(area.origin.x + area.size.x), luminance.width) - mask.width;
    const int bottom = std::min(int(area.origin.y + area.size.y), luminance.height) - mask.height;
    // Measured: other words of the same font correlate by up to 0.7, the same word by 0.97 and
    // more.
    constexpr float kFound = 0.93f;
    std::vector<ScreenRect> found;
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x)
            if (likeness(luminance, mask, x, y) > kFound) {
                found.push_back({{x, y}, {mask.width, mask.height}});
                x += mask.width;
            }
    return found;
}

bool endsThere(const Image& screen, const ScreenRect& text) {
    const int gap = std::max(int(ImGui::GetFontSize() * 0.45f), 1); // wider than a space
    const auto left = std::size_t(text.origin.x + text.size.x), top = std::size_t(text.origin.y);
    int least = 255, most = 0;
    for (std::size_t y = top; y < top + std::size_t(text.size.y); ++y)
        for (std::size_t x = left; x < std::min(left + std::size_t(gap), std::size_t(screen.width));
             ++x) {
            const int green = screen.rgba[(y * screen.width + x) * 4 + 1];
            least = std::min(least, green), most = std::max(most, green);
        }
    constexpr int kEven = 24; // of 255: a row's ground, but no letter
    return most - least < kEven;
}

} // namespace limn
