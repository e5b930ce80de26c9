// SPDX-License-Identifier: MIT
// PROGRAM [FILE] [options of GoogleTest]: runs the tests of one source file, such as
// tests/scene/light_test.cpp, or all.
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

namespace {

/// The names of the tests of a source file, as a filter takes them.
std::string testsOf(const std::string& file) {
    std::string names;
    const testing::UnitTest& program = *testing::UnitTest::GetInstance();
    for (int i = 0; i < program.total_test_suite_count(); ++i) {
        const testing::TestSuite& suite = *program.GetTestSuite(i);
        for (int k = 0; k < suite.total_test_count(); ++k) {
            const testing::TestInfo& test = *suite.GetTestInfo(k);
            if (std::string(test.file()).ends_with(file))
                names += std::string(suite.name()) + '.' + test.name() + ':';
        }
    }
    return names;
}

} // namespace

int main(int count, char** arguments) {
    testing::InitGoogleTest(&count, arguments);
    if (count > 1) {
        const std::string names = testsOf(arguments[1]);
        if (names.empty()) {
            std::fprintf(stderr, "%s: has no tests in this program\n", arguments[1]);
            return 1;
        }
        GTEST_FLAG_SET(filter, names);
    }
    return RUN_ALL_TESTS();
}
