// SPDX-License-Identifier: MIT
#include "editor_ui/document/object_rules.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace limn::object_rules_test {
namespace {

template <class T>
bool validWith(const std::function<void(T&)>& change) {
    T object;
    change(object);
    return isValid(object);
}

constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(ObjectRules, DefaultsAreValid) {
    EXPECT_TRUE(isValid(Node{}));
    EXPECT_TRUE(isValid(Material{}));
    EXPECT_TRUE(isValid(Light{}));
    EXPECT_TRUE(isValid(Camera{}));
    EXPECT_TRUE(isValid(Sky{}));
    EXPECT_TRUE(isValid(BakeSettings{}));
    EXPECT_TRUE(isValid(RelightSettings{}));
}

TEST(ObjectRules, NumbersOutsideTheirRangesAreNot) {
    EXPECT_FALSE(validWith<Node>([](Node& n) { n.transform.scale.y = 0; }));
    EXPECT_FALSE(validWith<Node>([](Node& n) { n.transform.translation.x = kInf; }));
    EXPECT_FALSE(validWith<Node>([](Node& n) { n.transform.rotation = {0, 0, 0, 0}; }));
    EXPECT_FALSE(validWith<Light>([](Light& l) { l.strength = -1; }));
    EXPECT_FALSE(validWith<Light>([](Light& l) { l.strength = std::nanf(""); }));
    EXPECT_FALSE(validWith<Light>([](Light& l) { l.innerAngle = l.outerAngle; }));
    EXPECT_FALSE(validWith<Light>([](Light& l) { l.direction = {0, 0, 0}; }));
    EXPECT_FALSE(validWith<Light>([](Light& l) { l.size.x = 0; }));
    EXPECT_FALSE(validWith<Light>([](Light& l) { l.size.y = -1; }));
    EXPECT_FALSE(validWith<Light>([](Light& l) { l.size.y = kInf; }));
    EXPECT_FALSE(validWith<Light>([](Light& l) { l.size.x = std::nanf(""); }));
    EXPECT_FALSE(validWith<Light>([](Light& l) { l.roll = std::nanf(""); }));
    EXPECT_FALSE(validWith<Material>([](Material& m) { m.baseColor.x = 1.5f; }));
    EXPECT_FALSE(validWith<Material>([](Material& m) { m.emission.y = -0.1f; }));
    EXPECT_FALSE(validWith<Material>([](Material& m) { m.transmission = 1.1f; }));
    EXPECT_FALSE(validWith<Material>([](Material& m) { m.ior = 0.9f; }));
    EXPECT_FALSE(validWith<Material>([](Material& m) { m.ior = NAN; }));
    EXPECT_FALSE(validWith<Material>([](Material& m) { m.thickness = -1; }));
    EXPECT_FALSE(validWith<Sky>([](Sky& s) { s.radiance.z = -1; }));
    EXPECT_FALSE(validWith<Sky>([](Sky& s) { s.ground.x = -1; }));
    EXPECT_FALSE(validWith<Sky>([](Sky& s) { s.rotation = NAN; }));
    EXPECT_FALSE(validWith<Camera>([](Camera& c) { c.target = c.eye; }));
    EXPECT_FALSE(validWith<BakeSettings>([](BakeSettings& b) { b.bands = 9; }));
    EXPECT_FALSE(validWith<BakeSettings>([](BakeSettings& b) { b.surfels = 63; }));
    EXPECT_FALSE(validWith<RelightSettings>([](RelightSettings& r) { r.maxBounces = 0; }));
    EXPECT_TRUE(validWith<Node>([](Node& n) { n.transform.scale.y = -1; }));
}

} // namespace
} // namespace limn::object_rules_test
