// Any text is either an expression or an Error; an expression gives a number, and the same one again, also in a copy.

#include <bit>
#include <carom/scene.hpp>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace carom;
    static const World world = [] {
        World w;
        w.add(Body{.position = {1, 2}, .velocity = {3, 4}, .name = "a"});
        w.add(Body{.position = {-1, 0.5}, .name = "b[0][1]"});
        w.step(0.1);
        return w;
    }();
    const std::map<std::string, double> parameters{{"k", 2.5}, {"zero", 0}};
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    try {
        const Quantity quantity(text, world, parameters);
        if (bits(quantity(world)) != bits(quantity(world))) std::abort();
    } catch (const Error&) {
    }
    try {
        const auto f = closed_form(text, parameters), copy = f;
        if (bits(f(0.5)) != bits(copy(0.5))) std::abort();
    } catch (const Error&) {
    }
    return 0;
}
