// SPDX-License-Identifier: MIT
#include "app/commands/command_line.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace limn {

struct Command::Shared {
    CLI::App app;
    std::function<Exit()> action;
};

Exit failed(const std::string& message) {
    std::fprintf(stderr, "limn: %s\n", message.c_str());
    return Exit::Failed;
}

Option& Option::required(bool required) {
    m_option->required(required);
    return *this;
}

Option& Option::needs(const Option& other) {
    m_option->needs(other.m_option);
    return *this;
}

Option& Option::excludes(const Option& other) {
    m_option->excludes(other.m_option);
    return *this;
}

Option& Option::list() {
    m_option->delimiter(',');
    return *this;
}

Option& Option::list(int count) {
    m_option->delimiter(',')->expected(count);
    return *this;
}

Option& Option::repeatable() {
    m_option->allow_extra_args(false)->take_all();
    return *this;
}

Option& Option::within(int lowest, int upper) {
    m_option->check(CLI::Range(lowest, upper));
    return *this;
}

Option& Option::within(double lowest, double upper) {
    m_option->check(CLI::Validator( // CLI::Range would accept "nan"
        [=](std::string& text) {
            const std::optional<double> value = numberOf(text);
            return value && *value >= lowest && *value <= upper
                       ? std::string()
                       : fmt::format("Value {} not in range [{:g} - {:g}]", text, lowest, upper);
        },
        fmt::format("NUMBER in [{:g} - {:g}]", lowest, upper)));
    return *this;
}

Option& Option::oneOf(const std::vector<std::string>& names) {
    m_option->check(CLI::IsMember(names));
    return *this;
}

Option& Option::check(const ArgumentCheck& check) {
    m_option->check(check);
    return *this;
}

Option& Option::typeName(const std::string& name) {
    m_option->type_name(name);
    return *this;
}

Option& Option::showDefault(const std::string& default_) {
    m_option->default_str(default_);
    return *this;
}

bool Option::isGiven() const {
    return m_option->count() > 0;
}

Command::Command(const std::string& name, const std::string& help, const std::string& version)
    : m_app(nullptr), m_shared(std::make_shared<Shared>()) {
    m_app = &m_shared->app;
    m_app->name(name);
    m_app->description(help);
    if (!version.empty())
        m_app->set_version_flag("--version", version, "Print the version and exit");
}

Command::Command(CLI::App* app, std::shared_ptr<Shared> shared)
    : m_app(app), m_shared(std::move(shared)) {}
Command::~Command() = default;
Command::Command(Command&&) noexcept = default;

Command Command::addCommand(const std::string& name, const std::string& help) {
    return {m_app->add_subcommand(name, help), m_shared};
}

void Command::requireCommand() {
    m_app->require_subcommand(1);
}

template <class T>
Option Command::option(const std::string& name, T& value, const std::string& help) {
    return Option(m_app->add_option(name, value, help));
}

template Option Command::option(const std::string&, std::string&, const std::string&);
template Option Command::option(const std::string&, int&, const std::string&);
template Option Command::option(const std::string&, float&, const std::string&);
template Option Command::option(const std::string&, double&, const std::string&);
template Option Command::option(const std::string&, std::uint32_t&, const std::string&);
template Option Command::option(const std::string&, std::uint64_t&, const std::string&);
template Option Command::option(const std::string&, std::optional<std::string>&,
                                const std::string&);
template Option Command::option(const std::string&, std::optional<float>&, const std::string&);
template Option Command::option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::option(const std::string&, std::optional<std::uint32_t>&,
                                const std::string&);
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::option(const std::string&, std::vector<float>&, const std::string&);
template Option Command::option(const std::string&, std::vector<double>&, const std::string&);
template Option Command::option(const std::string&, std::vector<std::uint32_t>&,
                                const std::string&);

Option Command::option(const std::string& name, std::function<void(const std::string&)> use,
                       const std::string& help) {
    return Option(m_app->add_option_function<std::string>(name, use, help));
}

Option Command::listOption(const std::string& name,
                           std::function<void(const std::vector<std::string>&)> use,
                           const std::string& help) {
    return Option(m_app->add_option_function<std::vector<std::string>>(name, use, help)).list();
}

Option Command::numberOption(const std::string& name, std::function<void(double)> use,
                             const std::string& help) {
    return Option(m_app->add_option_function<double>(name, use, help));
}

Option Command::flag(const std::string& name, bool& value, const std::string& help) {
    return Option(m_app->add_flag(name, value, help));
}

Option Command::flag(const std::string& name, std::function<void()> use, const std::string& help) {
    return Option(m_app->add_flag_callback(name, std::move(use), help));
}

Option Command::get(const std::string& name) const {
    return Option(m_app->get_option(name));
}

void Command::onRun(std::function<Exit()> action, std::function<std::string()> defect) {
    Shared* shared = m_shared.get(); // which owns the callback
    m_app->callback([action = std::move(action), defect = std::move(defect), shared] {
        if (const std::string why = defect ? defect() : std::string(); !why.empty())
            throw CLI::ValidationError(why);
        shared->action = action;
    });
}

Command::Chosen Command::parse(int argc, char** argv) {
    try {
        m_app->parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return {{}, m_app->exit(e) == 0 ? Exit::Done : Exit::Usage};
    }
    return {m_shared->action};
}

Command::Chosen Command::parse(std::vector<std::string> arguments) {
    std::ranges::reverse(arguments); // as CLI11 takes them
    try {
        m_app->parse(arguments);
    } catch (const CLI::ParseError& e) {
        return {{}, e.get_exit_code() == 0 ? Exit::Done : Exit::Usage};
    }
    return {m_shared->action};
}

std::optional<double> numberOf(const std::string& text) {
    double value = 0;
    return CLI::detail::lexical_cast(text, value) ? std::optional(value) : std::nullopt;
}

} // namespace limn
