#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.hpp"

int main(int argc, char** argv) {
    using namespace carom;
    CLI::App program{"Carom: a 2D physics laboratory. Textbook answers, every joule accounted for."};
    program.name("carom");
    program.set_version_flag("--version", std::string("carom ") + CAROM_VERSION);
    program.require_subcommand(1);
    program.footer(
        "examples:\n"
        "  carom run scenes/gas.json\n"
        "  carom run scenes/projectiles.json --set speed=15 --csv path.csv --out out\n"
        "  carom run scenes/spring-pendulum.json --integrator pefrl --step 0.01 --json\n"
        "  carom plot scenes/gas.json --out out\n"
        "  carom render scenes/gas.json --file gas.mp4\n"
        "exit status: 0 all went well, 1 the run failed or an expectation was not met, 2 wrong input");
    int status = 0;
    app::add_run(program, status);
    app::add_plot(program, status);
    app::add_render(program, status);
    app::add_validate(program, status);
    app::add_schema(program, status);
    app::add_tour(program, status);
    app::handle_interrupts();
    try {
        program.parse(argc, argv);
        return status;
    } catch (const CLI::ParseError& e) {
        return program.exit(e) == 0 ? 0 : 2;
    } catch (const Error& e) {
        fmt::print(stderr, "carom: {}\n", e.what());
        return e.cause() == Error::Cause::input ? 2 : 1;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "carom: this machine has not enough memory for that\n");
        return 1;
    } catch (const std::exception& e) {
        fmt::print(stderr, "carom: {}\n", e.what());
        return 1;
    }
}
