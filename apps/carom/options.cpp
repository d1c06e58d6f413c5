// The options that several commands share.

#include <fmt/format.h>

#include "commands.hpp"

namespace carom::app {

namespace {

template <class V>
std::string names_of() {
    return []<std::size_t... k>(std::index_sequence<k...>) {
        std::string all;
        ((all += std::string(k ? ", " : "") + std::variant_alternative_t<k, V>::name), ...);
        return all;
    }
    (std::make_index_sequence<std::variant_size_v<V>>{});
}

/// The text of a field, with its unit, as the option's help.
template <class S>
std::string help_of(const std::string& name) {
    std::string text;
    const auto look = [&](const auto& f) {
        if (f.name == name) text = *f.unit ? fmt::format("{} [{}]", f.text, f.unit) : f.text;
    };
    std::apply([&](const auto&... f) { (look(f), ...); }, fields(static_cast<const S*>(nullptr)));
    return text;
}

void add_overrides(CLI::App& command, Overrides& o) {
    const auto add = [&](const char* option, const char* place, const char* type, const std::string& help) {
        command
            .add_option_function<std::string>(
                option,
                [&o, option, place](const std::string& value) {
                    o.push_back({option, place, value});
                },
                help)
            ->type_name(type);
    };
    command
        .add_option_function<std::vector<std::string>>(
            "--set",
            [&o](const std::vector<std::string>& all) {
                for (const std::string& assignment : all) o.push_back({"--set", "", assignment});
            },
            "another value for a parameter or a place of the scene: speed=15, world.gravity=[0,-1.6], "
            "bodies.ball.mass=2")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    add("--duration", "run.duration", "TIME", help_of<Plan>("duration"));
    add("--step", "run.step", "TIME", help_of<Plan>("step"));
    add("--every", "run.every", "N", help_of<Plan>("every"));
    add("--measure-from", "run.measure_from", "TIME", help_of<Plan>("measure_from"));
    add("--integrator", "world.integrator", "NAME", names_of<Integrator>());
    add("--solver", "world.solver", "NAME", names_of<Solver>());
    add("--seed", "seed", "N", "of all random numbers of the scene");
    add("--threads", "world.threads", "N", help_of<Settings>("threads"));
}

}  // namespace

void add_scene(CLI::App& command, std::string& file, Overrides& o) {
    command.add_option("SCENE", file, "scene file, data file of a run, or - for standard input")
        ->required()
        ->type_name("");
    add_overrides(command, o);
}

CLI::Option* add_scenes(CLI::App& command, std::vector<std::string>& files, Overrides& o) {
    CLI::Option* scenes =
        command.add_option("SCENE", files, "scene files, data files of runs, or - for standard input");
    add_overrides(command, o);
    return scenes->required()->type_name("");
}

CLI::Validator in_range(const Range& range) {
    return {[range](const std::string& text) {
                double value = 0;
                const bool right = CLI::detail::lexical_cast(text, value) && range.contains(value);
                return right ? std::string() : fmt::format("must be {}, got {}", range.words, text);
            },
            ""};
}

CLI::Option* add_format(CLI::App& command, std::string& format) {
    return command.add_option("--format", format, "of the pictures")
        ->check(CLI::IsMember({"png", "svg", "pdf"}))
        ->type_name("NAME")
        ->capture_default_str();
}

}  // namespace carom::app
