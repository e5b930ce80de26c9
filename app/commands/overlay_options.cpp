// SPDX-License-Identifier: MIT
#include "app/commands/overlay_options.h"

#include "engine/json/json.h"
#include "engine/techniques/technique_table.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

void addOverlayFlags(Command& command, OverlayFlags& flags) {
    std::vector<std::string> names = {"none"};
    for (const OverlayKind* kind : overlayKinds())
        names.emplace_back(kind->name);
    command.option("--overlay", flags.name, "What the technique computed, to draw over a .png")
        .oneOf(names);
    command.option("--overlay-depth", flags.depth,
                   "Depth of the tree that 'clusters' and 'lit-clusters' show; 0: the root "
                   "(default: 6)");
    Option pick =
        command.option("--pick", flags.pick, "Pixel x,y whose cache, cell or probe is shown")
            .list(2);
    command.option("--cache", flags.cache, "Number of the cache, cell or probe that is shown")
        .excludes(pick);
}

const OverlayKind* overlayKindOf(const OverlayFlags& flags) {
    for (const OverlayKind* kind : overlayKinds())
        if (kind->name == flags.name)
            return kind;
    return nullptr;
}

/// "links and lobes", the kinds for which a flag is.
template <class Takes>
static std::string namesOf(const Takes& takes) {
    std::string names;
    for (const OverlayKind* kind : overlayKinds())
        if (takes(*kind))
            names += (names.empty() ? "" : " and ") + std::string(kind->name);
    return names;
}

Result<void> checkOverlayFlags(const OverlayFlags& flags) {
    const auto hasDepth = [](const OverlayKind& kind) { return kind.hasDepth; };
    const auto picks = [](const OverlayKind& kind) { return kind.pick != OverlayPick::None; };
    const OverlayKind* kind = overlayKindOf(flags);
    const bool picked = !flags.pick.empty() || flags.cache;
    if (flags.depth && !(kind && hasDepth(*kind)))
        return fail("--overlay-depth: is for --overlay " + namesOf(hasDepth));
    if (picked && !(kind && picks(*kind)))
        return fail("--pick, --cache: are for --overlay " + namesOf(picks));
    if (!picked && kind && kind->pick == OverlayPick::Required)
        return fail(fmt::format("--overlay {}: needs --pick X,Y or --cache N", kind->name));
    return {};
}

Result<void> checkOverlayTechnique(const OverlayFlags& flags, const Technique& technique) {
    const Technique& owner = techniqueOf(*overlayKindOf(flags));
    if (&owner != &technique)
        return fail(fmt::format("--overlay {}: is of the technique \"{}\", not of \"{}\"",
                                flags.name, owner.name, technique.name));
    return {};
}

static Result<std::uint32_t> pickedNumber(const OverlayFlags& flags, const OverlaySource& source,
                                          const TraceScene& trace, const Camera& camera,
                                          glm::vec2 size) {
    const glm::vec2 pixel(float(flags.pick[0]), float(flags.pick[1]));
    if (pixel.x >= size.x || pixel.y >= size.y)
        return fail(fmt::format("--pick: the picture has {} x {} pixels", size.x, size.y));
    const glm::vec2 ndc = (pixel + 0.5f) / size * 2.f - 1.f;
    const glm::vec3 d = rayDirection(camera, size.x / size.y, ndc.x, -ndc.y);
    const Hit hit = trace.closestHit({camera.eye, glm::normalize(d)}, TraceMask::Seen);
    const auto number = hit ? source.pickAt(trace.scene(), hit) : std::nullopt;
    if (!number)
        return fail("--pick: nothing at this pixel can be picked");
    return *number;
}

Result<OverlayRequest> overlayRequest(const OverlayFlags& flags, const OverlaySource& source,
                                      const TraceScene& trace, const Camera& camera,
                                      std::uint32_t width, std::uint32_t height) {
    OverlayRequest options;
    options.kind = overlayKindOf(flags);
    options.depth = flags.depth.value_or(options.depth);
    if (flags.cache) {
        if (*flags.cache >= source.pickCount())
            return fail(fmt::format("--cache: there are {} to pick from 0 on", source.pickCount()));
        options.pick = *flags.cache;
    } else if (!flags.pick.empty()) {
        const Result<std::uint32_t> number =
            pickedNumber(flags, source, trace, camera, glm::vec2(width, height));
        if (!number)
            return tl::make_unexpected(number.error());
        options.pick = *number;
    }
    return options;
}

static std::string hexColor(std::uint32_t c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c & 255, c >> 8 & 255, c >> 16 & 255);
}

Json legendJson(const OverlayLegend& legend) {
    Json json;
    json["title"] = legend.title;
    json["colors"] = Json::array();
    for (const OverlayLegend::Entry& e : legend.entries)
        json["colors"].push_back({{"color", hexColor(e.color)}, {"meaning", e.text}});
    json["notes"] = legend.notes;
    return json;
}

std::string legendText(const OverlayLegend& legend) {
    std::string text = legend.title + "\n";
    for (const OverlayLegend::Entry& e : legend.entries)
        text += fmt::format("  {}  {}\n", hexColor(e.color), e.text);
    for (const std::string& note : legend.notes)
        text += fmt::format("  {}\n", note);
    return text;
}

} // namespace limn
