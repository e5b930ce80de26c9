// SPDX-License-Identifier: MIT
// A bake killed again and again at any moment goes on where it was, to the undisturbed result.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace limn::bake_kill_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Starts `limn bake` of a sample of about a second, its stdout in `out`.
pid_t startBake(const fs::path& folder, const std::vector<std::string>& more, const fs::path& out) {
    std::vector<std::string> words = {LIMN_EXECUTABLE,
                                      "bake",
                                      "cornell",
                                      "--surfels",
                                      "2000",
                                      "--lightmap",
                                      "1500",
                                      "--rays",
                                      "1000",
                                      "--links",
                                      "32",
                                      "--json",
                                      "-o",
                                      (folder / "out.limnbake").string()};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
        dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    return child;
}

nlohmann::json finishBake(const fs::path& folder, const std::vector<std::string>& more) {
    const fs::path out = folder / "summary.json";
    int status = 0;
    waitpid(startBake(folder, more, out), &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    std::ifstream in(out);
    return nlohmann::json::parse(std::string(std::istreambuf_iterator<char>(in), {}));
}

TEST(BakeKill, TwentyKillsLaterTheBakeEqualsTheUndisturbedOne) {
    const fs::path folder = fs::temp_directory_path() / ("limn_kill" + std::to_string(getpid()));
    fs::create_directories(folder);
    const auto start = std::chrono::steady_clock::now();
    const nlohmann::json undisturbed = finishBake(folder, {"--no-cache"});
    auto most = (std::chrono::steady_clock::now() - start) * 2 / 3;

    const std::vector<std::string> cache = {"--cache", (folder / "cache").string()};
    std::mt19937 random(11);
    for (int killed = 0; killed < 20;) {
        const pid_t child = startBake(folder, cache, "/dev/null");
        std::this_thread::sleep_for(most * (random() % 1000) / 1000);
        kill(child, SIGKILL);
        int status = 0;
        waitpid(child, &status, 0);
        if (WIFSIGNALED(status)) {
            ++killed;
        } else { // it was done before: begin anew, and do not wait as long
            ASSERT_EQ(WEXITSTATUS(status), 0);
            fs::remove_all(folder / "cache");
            most /= 2;
        }
    }
    const nlohmann::json last = finishBake(folder, cache);
    EXPECT_EQ(last["hash"], undisturbed["hash"]);
    EXPECT_LT(last["counts"]["rays"], undisturbed["counts"]["rays"]) << "nothing was kept";
    EXPECT_EQ(finishBake(folder, cache)["counts"]["rays"], 0);
    fs::remove_all(folder);
}

} // namespace
} // namespace limn::bake_kill_test
