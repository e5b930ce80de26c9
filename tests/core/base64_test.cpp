// SPDX-License-Identifier: MIT
#include "engine/core/base64.h"

#include <gtest/gtest.h>

namespace limn::base64_test {
namespace {

TEST(Base64, HasTheVectorsOfItsRfc) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xff\x00\xfb", 3)), "/wD7");
}

} // namespace
} // namespace limn::base64_test
