#include <fmt/format.h>

#include <carom/scene.hpp>
#include <cmath>

namespace carom {

struct Twins::Pair {
    std::string place;  // what errors call it
    Twin twin;
    Quantity quantity;
    std::function<double(double)> formula;
    double largest = 0, end = 0;

    void observe(const World& world) {
        if (twin.until && world.time() > *twin.until * (1 + 1e-12)) return;
        try {
            end = std::abs(quantity(world) - formula(world.time()));
        } catch (const Error& e) {
            throw Error(fmt::format("{} is wrong at t = {:.4g} s: {}", place, world.time(), e.what()));
        }
        // What is not a number stays: no maximum of it means anything.
        largest = largest < end || std::isnan(end) ? end : largest;
    }
};

Twins::Twins(const Scene& scene, const World& start) {
    const auto twins = scene.twins();
    const auto parameters = scene.parameters();
    for (std::size_t i = 0; i < twins.size(); ++i) {
        const std::string place = fmt::format("{}: twins[{}]", scene.file(), i);
        try {
            pairs_.push_back(std::make_unique<Pair>(Pair{
                place, twins[i], {twins[i].quantity, start, parameters}, closed_form(twins[i].formula, parameters)}));
        } catch (const Error& e) {
            throw Error(fmt::format("{} is wrong: {}", place, e.what()));
        }
    }
    observe(start);
}
Twins::Twins(Twins&&) noexcept = default;
Twins::~Twins() = default;

void Twins::observe(const World& world) {
    for (const auto& pair : pairs_) pair->observe(world);
}

void Twins::save(Saver& to) const {
    for (const auto& pair : pairs_) to(pair->largest, pair->end);
}
void Twins::restore(Loader& from) {
    for (const auto& pair : pairs_) from(pair->largest, pair->end);
}

std::vector<TwinError> Twins::errors() const {
    std::vector<TwinError> out;
    for (const auto& pair : pairs_) out.push_back({pair->twin, pair->largest, pair->end});
    return out;
}

}  // namespace carom
