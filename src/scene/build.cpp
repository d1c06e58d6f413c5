#include "scene/document.hpp"
#include "scene/kinds.hpp"
#include "scene/memory.hpp"
#include "scene/typed.hpp"

namespace carom {

namespace {

// How many bodies a builder will make, before it makes them; 0 where only it can know.
double bodies_of(const Rope& r) { return r.segments; }
double bodies_of(const Lattice& l) { return static_cast<double>(l.nx) * l.ny; }
double bodies_of(const GridOf& g) { return static_cast<double>(g.nx) * g.ny; }
double bodies_of(const NotebookGas& g) { return g.count; }
double bodies_of(const Fill& f) {
    if (f.count) return *f.count;
    const double mean_square = (f.smallest_radius * f.smallest_radius + f.smallest_radius * f.largest_radius +
                                f.largest_radius * f.largest_radius) /
                               3;
    return f.fraction.value_or(0) * (f.high.x - f.low.x) * (f.high.y - f.low.y) / (3.14159265358979 * mean_square);
}
double bodies_of(const Gas& g) { return bodies_of(g.fill); }

/// A builder that draws random numbers and names no seed of its own takes the scene's.
int* seed_of(Fill& f) { return &f.seed; }
int* seed_of(Gas& g) { return &g.fill.seed; }
int* seed_of(NotebookGas& g) { return &g.seed; }
template <class T>
int* seed_of(T&) {
    return nullptr;
}

bool names_seed(const Json& item) {
    return item.contains("seed") ||
           (item.contains("fill") && item["fill"].is_object() && item["fill"].contains("seed"));
}

}  // namespace

void build_all(World& world, const Reader& reader, const Json& root, const Place& top, int seed) {
    for_each_item(root, top, "builders", [&](const Json& item, const Place& place) {
        read_typed(reader, item, place, builder_types, [&](auto builder, const Place& at) {
            require_memory_for(bodies_of(builder), place);
            if (int* own = seed_of(builder); own && !names_seed(item)) *own = seed;
            at_place(at, [&] { build(world, builder); });
        });
    });
}

}  // namespace carom
