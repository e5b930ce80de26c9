// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace limn {

/// Exit status of the process: 0 done, 1 failed (one line on stderr), 2 bad usage, 3 done, with
/// findings that `limn lint` is to fail on.
enum class Exit : int { Done = 0, Failed = 1, Usage = 2, Findings = 3 };

/// Describes what is wrong with the text of an argument; empty: nothing.
using ArgumentCheck = std::function<std::string(const std::string& text)>;

/// Prints `limn: message` on stderr and returns Exit::Failed.
Exit failed(const std::string& message);

/// An option of a command. The functions that return the option itself add a condition, which is
/// checked before the command runs. CLI11, which costs a compiler seconds, stays in
/// command_line.cpp.
class Option {
public:
    explicit Option(CLI::Option* option) : m_option(option) {}

    Option& required(bool required = true);
    Option& needs(const Option& other);
    Option& excludes(const Option& other);
    Option& list();          ///< takes several values, separated by commas
    Option& list(int count); ///< takes so many
    Option& repeatable();    ///< takes one value each time that it is given
    Option& within(int lowest, int upper);
    Option& within(double lowest, double upper); ///< not NaN either
    Option& oneOf(const std::vector<std::string>& names);
    Option& check(const ArgumentCheck& check);
    Option& typeName(const std::string& name);        ///< what --help shows in place of the value
    Option& showDefault(const std::string& default_); ///< in --help

    bool isGiven() const;

private:
    CLI::Option* m_option;
};

/// A command of the program. What options are bound to must outlive it.
class Command {
public:
    /// The program itself, with the text of --version.
    Command(const std::string& name, const std::string& help, const std::string& version = {});
    ~Command();
    Command(Command&&) noexcept;

    Command addCommand(const std::string& name, const std::string& help);
    void requireCommand();

    /// An option with a value, or a positional argument where `name` has no dash. T: std::string,
    /// int, float, double, unsigned integers of 32 and 64 bits, optionals and vectors of some of
    /// these; command_line.cpp lists them.
    template <class T>
    Option option(const std::string& name, T& value, const std::string& help);
    Option option(const std::string& name, std::function<void(const std::string&)> use,
                  const std::string& help);
    Option listOption(const std::string& name,
                      std::function<void(const std::vector<std::string>&)> use,
                      const std::string& help);
    Option numberOption(const std::string& name, std::function<void(double)> use,
                        const std::string& help);
    Option flag(const std::string& name, bool& value, const std::string& help);
    Option flag(const std::string& name, std::function<void()> use, const std::string& help);
    Option get(const std::string& name) const; ///< Precondition: there is such an option.

    /// Sets what the program does when this command is chosen. `defect` describes, after all
    /// options were read, what is wrong with their combination; empty: nothing.
    void onRun(std::function<Exit()> action, std::function<std::string()> defect = {});

    /// Reads the arguments and prints help or what is wrong with them. Returns the action of the
    /// chosen command, or the status with which the program is to end.
    struct Chosen {
        std::function<Exit()> action; ///< null where the program is to end
        Exit status = Exit::Done;
    };
    Chosen parse(int argc, char** argv);
    /// The same of arguments without the program's name, in silence.
    Chosen parse(std::vector<std::string> arguments);

private:
    struct Shared; ///< by the program and its commands
    Command(CLI::App* app, std::shared_ptr<Shared> shared);

    CLI::App* m_app;
    std::shared_ptr<Shared> m_shared;
};

/// The number that a whole text spells; none if it does not. NaN and infinity are numbers here.
std::optional<double> numberOf(const std::string& text);

/// The names of an enumeration as Option::oneOf() takes them.
template <class Names>
std::vector<std::string> namesIn(const Names& names) {
    return {names.begin(), names.end()};
}

} // namespace limn
