#include "state/bodies.hpp"

#include <fmt/format.h>

#include <cmath>

#include "state/validate.hpp"

namespace carom {

Colour default_colour(std::size_t n) {
    static constexpr Colour okabe_ito[] = {{0, 114, 178, 255},  {230, 159, 0, 255},  {0, 158, 115, 255},
                                           {213, 94, 0, 255},   {86, 180, 233, 255}, {204, 121, 167, 255},
                                           {240, 228, 66, 255}, {120, 120, 120, 255}};
    return okabe_ito[n % std::size(okabe_ito)];
}

std::string called(const Body& body) {
    return body.name.empty() ? std::string("Body") : fmt::format("Body '{}'", body.name);
}

namespace {

double moment_of_inertia(const Body& body) {
    return body.moment_of_inertia.value_or(0.5 * body.mass * body.radius * body.radius);
}

}  // namespace

void Bodies::check(const Body& body, BodyId which) const {
    const std::string where = called(body);
    validate(body, where);
    if (const auto named = by_name.find(body.name); named != by_name.end() && named->second != which)
        throw Error(fmt::format("{}.name must be unique, and there is a body '{}' already", where, body.name));
    if (body.kind == Kind::dynamic && !std::isfinite(moment_of_inertia(body)))
        throw Error(fmt::format("{} must have a moment of inertia that a number can hold [kg m²], got {}", where,
                                moment_of_inertia(body)));
    if (body.kind == Kind::fixed && (body.velocity != Vec2{} || body.angular_velocity != 0))
        throw Error(fmt::format("{}.velocity must be 0 for a fixed body (a driven one keeps a velocity)", where));
}

BodyId Bodies::add(const Body& body, State& state) {
    BodyId which;
    if (free_.empty()) {
        which = {static_cast<std::uint32_t>(row_of_.size()), 1};
        row_of_.push_back(no_row);
        generation_.push_back(1);
    } else {
        which = {free_.back(), ++generation_[free_.back()]};
        free_.pop_back();
    }
    row_of_[which.index] = static_cast<std::uint32_t>(size());
    const auto open = [](auto&... array) { (array.emplace_back(), ...); };
    open(id, kind, mass, inverse_mass, inertia, inverse_inertia, radius, charge, restitution, friction, colour, shapes,
         state.x.linear, state.x.angular, state.v.linear, state.v.angular);
    id.back() = which;
    write(size() - 1, body, state);
    return which;
}

void Bodies::write(std::size_t r, const Body& body, State& state) {
    const double I = moment_of_inertia(body);
    const bool dynamic = body.kind == Kind::dynamic;
    kind[r] = body.kind;
    mass[r] = body.mass;
    inverse_mass[r] = dynamic ? 1 / body.mass : 0;
    inertia[r] = I;
    inverse_inertia[r] = dynamic && I > 0 && !body.fixed_rotation ? 1 / I : 0;
    radius[r] = body.radius;
    charge[r] = body.charge;
    restitution[r] = body.restitution;
    friction[r] = body.friction;
    colour[r] = body.colour.value_or(default_colour(id[r].index));
    shapes[r] = body.shapes;
    if (!body.name.empty()) {
        name[id[r].index] = body.name;
        by_name[body.name] = id[r];
    }
    state.x.linear[r] = body.position;
    state.x.angular[r] = body.angle;
    state.v.linear[r] = body.velocity;
    state.v.angular[r] = body.angular_velocity;
}

void Bodies::set(BodyId which, const Body& body, State& state) {
    const std::size_t r = row(which);
    forget_name(which.index);
    write(r, body, state);
}

void Bodies::forget_name(std::uint32_t index) {
    const auto named = name.find(index);
    if (named == name.end()) return;
    by_name.erase(named->second);
    name.erase(named);
}

void Bodies::remove(BodyId which, State& state) {
    const std::size_t hole = row(which);
    const auto close = [hole](auto&... array) { ((array[hole] = array.back(), array.pop_back()), ...); };
    close(id, kind, mass, inverse_mass, inertia, inverse_inertia, radius, charge, restitution, friction, colour, shapes,
          state.x.linear, state.x.angular, state.v.linear, state.v.angular);
    if (hole < size()) row_of_[id[hole].index] = static_cast<std::uint32_t>(hole);
    row_of_[which.index] = no_row;
    free_.push_back(which.index);
    forget_name(which.index);
}

bool Bodies::contains(BodyId which) const {
    return which.index < row_of_.size() && row_of_[which.index] != no_row &&
           generation_[which.index] == which.generation;
}

std::size_t Bodies::row(BodyId which) const {
    if (!contains(which)) {
        if (which.index >= row_of_.size())
            throw Error("BodyId must come from World::add of this world, got one that no body ever had");
        throw Error(fmt::format("BodyId is stale: body {} (generation {}) was removed from this world", which.index,
                                which.generation));
    }
    return row_of_[which.index];
}

std::size_t Bodies::row(BodyId which, std::string_view whose, std::string_view field) const {
    try {
        return row(which);
    } catch (const Error& e) {
        throw Error(fmt::format("{}.{}: {}", whose, field, e.what()));
    }
}

Body Bodies::body(std::size_t r, const State& state) const {
    const auto named = name.find(id[r].index);
    return {.kind = kind[r],
            .position = state.x.linear[r],
            .angle = state.x.angular[r],
            .velocity = state.v.linear[r],
            .angular_velocity = state.v.angular[r],
            .mass = mass[r],
            .moment_of_inertia = inertia[r] > 0 ? std::optional(inertia[r]) : std::nullopt,
            .fixed_rotation = kind[r] == Kind::dynamic && inertia[r] > 0 && inverse_inertia[r] == 0,
            .radius = radius[r],
            .shapes = shapes[r],
            .charge = charge[r],
            .restitution = restitution[r],
            .friction = friction[r],
            .name = named == name.end() ? std::string() : named->second,
            .colour = colour[r]};
}

void Bodies::check_members(const State& state) {
    const std::size_t n = size();
    bool right = row_of_.size() == generation_.size() && n + free_.size() == row_of_.size();
    for (const std::size_t size :
         {kind.size(), mass.size(), inverse_mass.size(), inertia.size(), inverse_inertia.size(), radius.size(),
          charge.size(), restitution.size(), friction.size(), colour.size(), shapes.size(), state.x.linear.size(),
          state.x.angular.size(), state.v.linear.size(), state.v.angular.size()})
        right = right && size == n;
    for (std::size_t row = 0; row < n && right; ++row)
        right = contains(id[row]) && row_of_[id[row].index] == row && kind[row] <= Kind::driven;
    for (const std::uint32_t index : free_) right = right && index < row_of_.size() && row_of_[index] == no_row;
    by_name.clear();
    for (const auto& [index, words] : name) {
        right = right && index < row_of_.size() && row_of_[index] < n;
        if (right) by_name[words] = id[row_of_[index]];
    }
    if (!right) Loader::fail();
}

}  // namespace carom
