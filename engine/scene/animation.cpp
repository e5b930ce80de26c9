// SPDX-License-Identifier: MIT
#include "engine/scene/animation.h"

#include "engine/scene/find_object.h"
#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/placement.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// Keys around a time.
struct KeysAround {
    std::size_t before = 0, after = 0;
    double share = 0;   ///< of the way from one to the other
    double seconds = 0; ///< between them
};

KeysAround keysAround(std::span<const float> times, double seconds) {
    const auto next = std::size_t(std::ranges::upper_bound(times, float(seconds)) - times.begin());
    if (next == 0 || next == times.size()) {
        const std::size_t end = next == 0 ? 0 : times.size() - 1;
        return {end, end, 0, 0};
    }
    const double first = double(times[next - 1]), length = double(times[next]) - first;
    return {next - 1, next, length > 0 ? (double(float(seconds)) - first) / length : 0, length};
}

/// Values of a key; of a cubic spline 0 and 2 are its tangents.
std::span<const float> partOfKey(const KeyedValues& keys, std::size_t key, std::size_t part) {
    const std::size_t w = keys.width();
    const std::size_t first =
        keys.interpolation == Interpolation::CubicSpline ? (3 * key + part) * w : key * w;
    return std::span(keys.values).subspan(first, w);
}

glm::dquat quaternionOf(std::span<const float> v) {
    return glm::dquat(glm::quat(v[3], v[0], v[1], v[2]));
}

void setProperty(Node& node, AnimatedProperty property, std::span<const double> v) {
    if (property == AnimatedProperty::Translation)
        node.transform.translation = {v[0], v[1], v[2]};
    if (property == AnimatedProperty::Scale) {
        // A scale of 0 would leave no direction to its axis.
        constexpr double kThin = 1e-6;
        for (int c = 0; c < 3; ++c)
            node.transform.scale[c] =
                float(std::abs(v[std::size_t(c)]) < kThin ? kThin : v[std::size_t(c)]);
    }
    if (property == AnimatedProperty::Rotation) {
        const glm::dquat q(v[3], v[0], v[1], v[2]);
        if (const double length = glm::length(q); length > 1e-12)
            node.transform.rotation = glm::quat(q / length);
    }
}

void setProperty(Light& light, AnimatedProperty property, std::span<const double> v) {
    const auto limited = [](double value) { return std::clamp(float(value), 0.f, kMaxLight); };
    if (property == AnimatedProperty::Color)
        light.color = {limited(v[0]), limited(v[1]), limited(v[2])};
    if (property == AnimatedProperty::Strength)
        light.strength = limited(v[0]);
    if (property == AnimatedProperty::Range)
        light.range = std::max(float(v[0]), 0.f);
}

bool isOfNode(AnimatedProperty property) {
    return property == AnimatedProperty::Translation || property == AnimatedProperty::Rotation ||
           property == AnimatedProperty::Scale;
}

std::size_t widthOf(AnimatedProperty property) {
    if (property == AnimatedProperty::Strength || property == AnimatedProperty::Range)
        return 1;
    return property == AnimatedProperty::Rotation ? 4 : 3;
}

void applyTrack(Document& document, const AnimationTrack& track, double seconds) {
    const auto found = document.objects.find(track.object);
    if (found == document.objects.end())
        return;
    const std::vector<double> values =
        valuesAt(track.keys, seconds, track.property == AnimatedProperty::Rotation);
    if (values.size() != widthOf(track.property) ||
        !std::ranges::all_of(values, [](double v) { return std::isfinite(float(v)); }))
        return;
    if (Node* node = std::get_if<Node>(&found->second); node && isOfNode(track.property))
        setProperty(*node, track.property, values);
    if (Light* light = std::get_if<Light>(&found->second); light && !isOfNode(track.property))
        setProperty(*light, track.property, values);
}

/// `direction` moved by a matrix, or as it was where the matrix flattens it.
glm::vec3 turned(const glm::dmat4& by, glm::vec3 direction) {
    const glm::dvec3 d = glm::dmat3(by) * glm::dvec3(direction);
    const double length = glm::length(d);
    return length > 1e-12 && std::isfinite(length) ? glm::vec3(d / length) : direction;
}

void carry(Light& light, const glm::dmat4& by) {
    const LightRectangle before = lightRectangle(light);
    const glm::vec3 width = turned(by, glm::normalize(before.halfWidth));
    light.position = glm::vec3(by * glm::dvec4(light.position, 1));
    light.direction = turned(by, light.direction);
    light.roll = rollTowards(light, width);
}

void carry(Camera& camera, const glm::dmat4& by) {
    const float ahead = glm::distance(camera.target, camera.eye);
    const glm::vec3 forward = turned(by, glm::normalize(camera.target - camera.eye));
    camera.eye = glm::vec3(by * glm::dvec4(camera.eye, 1));
    camera.target = camera.eye + ahead * forward;
    camera.up = turned(by, camera.up);
}

} // namespace

std::size_t KeyedValues::width() const {
    return values.size() / (times.size() * (interpolation == Interpolation::CubicSpline ? 3 : 1));
}

std::vector<double> valuesAt(const KeyedValues& keys, double seconds, bool isRotation) {
    const KeysAround around = keysAround(keys.times, seconds);
    const bool isCubic = keys.interpolation == Interpolation::CubicSpline;
    const std::size_t middle = isCubic ? 1 : 0;
    const std::span<const float> a = partOfKey(keys, around.before, middle),
                                 b = partOfKey(keys, around.after, middle);
    std::vector<double> out(a.begin(), a.end());
    if (keys.interpolation == Interpolation::Step || around.before == around.after)
        return out;
    const double t = around.share;
    if (isCubic) { // Hermite's spline, whose tangents are per second
        const std::span<const float> leaving = partOfKey(keys, around.before, 2),
                                     arriving = partOfKey(keys, around.after, 0);
        const double d = around.seconds, t2 = t * t, t3 = t2 * t;
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = (2 * t3 - 3 * t2 + 1) * double(a[i]) +
                     d * (t3 - 2 * t2 + t) * double(leaving[i]) + (3 * t2 - 2 * t3) * double(b[i]) +
                     d * (t3 - t2) * double(arriving[i]);
    } else if (isRotation && out.size() == 4) {
        const glm::dquat q = glm::slerp(quaternionOf(a), quaternionOf(b), t);
        out = {q.x, q.y, q.z, q.w};
    } else {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] += t * (double(b[i]) - double(a[i]));
    }
    return out;
}

double SceneAnimation::duration() const {
    double last = 0;
    for (const AnimationTrack& track : tracks)
        last = std::max(last, double(track.keys.times.back()));
    return last;
}

Document posedDocument(const Document& document, const SceneAnimation& animation, double seconds) {
    Document posed = document;
    for (const AnimationTrack& track : animation.tracks)
        applyTrack(posed, track, seconds);
    Placements before(document), after(posed);
    for (const auto& [object, node] : animation.carried) {
        const auto found = posed.objects.find(object);
        if (found == posed.objects.end() || !findObjectAs<Node>(document, node))
            continue;
        const glm::dmat4 from = before.of(node).toWorld, to = after.of(node).toWorld;
        if (from == to || std::abs(glm::determinant(from)) < 1e-30)
            continue;
        const glm::dmat4 by = to * glm::inverse(from);
        if (Light* light = std::get_if<Light>(&found->second))
            carry(*light, by);
        else if (Camera* camera = std::get_if<Camera>(&found->second))
            carry(*camera, by);
    }
    return posed;
}

void makeMovingDynamic(Document& document, const SceneAnimation& animation) {
    for (const AnimationTrack& track : animation.tracks)
        if (isOfNode(track.property))
            if (const auto found = document.objects.find(track.object);
                found != document.objects.end())
                if (Node* node = std::get_if<Node>(&found->second))
                    node->dynamic = true;
}

} // namespace limn
