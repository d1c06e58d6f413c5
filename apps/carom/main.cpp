#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "commands.hpp"

namespace {

using namespace carom;

int complain(const std::string& what, int status) {
    std::fflush(stdout);                                           // what was said before stands before this
    std::fputs(fmt::format("carom: {}\n", what).c_str(), stderr);  // who cannot be told is not told by a throw either
    return status;
}

/// The command line's own mistakes, in one line like all others. CLI11 says of a word that is no command, or no option,
/// that a command is missing.
int complain(const CLI::App& program, const CLI::ParseError& e, const std::string& first) {
    if (first.starts_with('-') && program.get_subcommands().empty())
        return complain(fmt::format("there is no option '{}' (carom --help shows what there is)", first), 2);
    if (program.get_subcommands().empty()) {
        if (std::filesystem::is_regular_file(first))
            return complain(fmt::format("'{}' is no command; did you mean 'carom run {}'?", first, first), 2);
        std::string commands;
        for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
            commands += (commands.empty() ? "" : ", ") + command->get_name();
        return complain(fmt::format("there is no command '{}'; there are {}", first, commands), 2);
    }
    std::string what = e.what(), help = "carom";
    for (const CLI::App* chosen : program.get_subcommands()) help += " " + chosen->get_name();
    // CLI11 names them from the last to the first.
    if (e.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError))
        what = fmt::format("not expected: {}", fmt::join(program.remaining(true), " "));
    if (const auto twice = what.find(": At Most 1 required"); twice != std::string::npos)
        what = fmt::format("{} can be given once", what.substr(0, twice));
    for (char& c : what)
        if (c == '\n') c = ' ';
    return complain(fmt::format("{} ({} --help shows what there is)", what, help), 2);
}

/// What is asked for: `help COMMAND` is COMMAND --help.
std::vector<std::string> words_of(int argc, char** argv, const CLI::App& program) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty()) return {"--help"};
    if (words[0] != "help") return words;
    words.erase(words.begin());
    const auto commands = program.get_subcommands([](const CLI::App*) { return true; });
    const auto is_first = [&words](const CLI::App* command) { return command->get_name() == words[0]; };
    // Of what is no command is said which there are.
    if (words.empty() || std::any_of(commands.begin(), commands.end(), is_first)) words.emplace_back("--help");
    return words;
}

int run(CLI::App& program, int argc, char** argv, const int& status) {
    const std::vector<std::string> words = words_of(argc, argv, program);
    try {
        program.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them from the back
        return status;
    } catch (const CLI::ParseError& e) {
        return e.get_exit_code() == 0 ? program.exit(e) : complain(program, e, words[0]);
    } catch (const Error& e) {
        return complain(e.what(), e.cause() == Error::Cause::input ? 2 : 1);
    } catch (const std::system_error& e) {
        // A full disk behind standard output, which fmt calls "file".
        const bool is_output = std::ferror(stdout) != 0;
        return complain(is_output ? "cannot write to standard output: " + e.code().message() : e.what(), 1);
    } catch (const std::bad_alloc&) {
        return complain("this machine has not enough memory for that", 1);
    } catch (const std::exception& e) {
        return complain(e.what(), 1);
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App program{"Carom: a 2D physics laboratory. Textbook answers, every joule accounted for."};
    program.name("carom");
    program.set_version_flag("--version", std::string("carom ") + CAROM_VERSION);
    program.require_subcommand(1);
    program.footer(
        "carom help COMMAND, or carom COMMAND --help, has the options of a command\n"
        "examples:\n"
        "  carom run scenes/gas.json\n"
        "  carom run scenes/wind.json --set wy=2 --out out\n"
        "  carom plot scenes/spring-pendulum.json --integrator pefrl --step 1/100\n"
        "  carom render scenes/gas.json --file gas.mp4\n"
        "  carom run scenes/*.json\n"
        "  carom check scenes/kepler.json\n"
        "  carom bench scenes/contacts/pyramid.json\n"
        "exit status: 0 all went well, 1 the run failed, an expectation was not met or check says no, 2 wrong input");
    int status = 0;
    app::add_run(program, status);
    app::add_plot(program, status);
    app::add_render(program, status);
    app::add_check(program, status);
    app::add_validate(program, status);
    app::add_schema(program, status);
    app::add_bench(program, status);
    app::add_tour(program, status);
    app::handle_interrupts();
    status = run(program, argc, argv, status);
    // A full disk behind standard output shows only now.
    if (status == 0 && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0))
        return complain(fmt::format("cannot write to standard output: {}", std::strerror(errno)), 1);
    return status;
}
