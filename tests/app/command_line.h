// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace fs = std::filesystem;

inline std::string contents(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

struct Outcome {
    int exit = -1;
    std::string out, err;
};

/// An empty folder for the files of one test, removed at its end.
class CommandLine : public testing::Test {
protected:
    void SetUp() override {
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        m_folder = fs::temp_directory_path() / ("limn_" + name + std::to_string(getpid()));
        fs::create_directories(m_folder);
    }
    void TearDown() override { fs::remove_all(m_folder); }

    std::string path(const std::string& name) const { return (m_folder / name).string(); }

    /// Runs `limn arguments` as a shell would.
    Outcome limn(const std::string& arguments) const {
        const std::string out = path("stdout"), err = path("stderr");
        const std::string command = "XDG_CACHE_HOME='" + path("cache") +
                                    "' '" LIMN_EXECUTABLE "' " + arguments + " </dev/null >'" +
                                    out + "' 2>'" + err + "'";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(out), contents(err)};
    }

    /// Fails unless the command exits with 1, prints nothing on stdout and one line, with `word`,
    /// on stderr.
    void expectRefusal(const std::string& arguments, const std::string& word) const {
        const Outcome run = limn(arguments);
        EXPECT_EQ(run.exit, 1) << arguments << "\n" << run.err;
        EXPECT_EQ(run.out, "") << arguments;
        EXPECT_EQ(run.err.rfind("limn: ", 0), 0u) << arguments << "\n" << run.err;
        EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << arguments << ": more than one line\n"
                                                          << run.err;
        EXPECT_NE(run.err.find(word), std::string::npos)
            << arguments << ": does not say " << word << "\n"
            << run.err;
    }

    /// Stdout as the one JSON object that --json promises.
    nlohmann::json json(const std::string& arguments) const {
        const Outcome run = limn(arguments);
        EXPECT_EQ(run.exit, 0) << arguments << "\n" << run.err;
        const nlohmann::json object = nlohmann::json::parse(run.out, nullptr, false);
        EXPECT_TRUE(object.is_object()) << arguments << "\n" << run.out;
        return object;
    }

private:
    fs::path m_folder;
};

inline void expectKeys(const nlohmann::json& object, const std::vector<std::string>& keys) {
    for (const std::string& key : keys)
        EXPECT_TRUE(object.contains(key)) << key << " is missing in " << object.dump();
}
