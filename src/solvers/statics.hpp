#pragma once
// Forces that hold up an island in which nothing moves, if its contacts and joints can bear them
// (docs/theory/softstep.md).

#include <utility>

#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"

namespace carom {

/// An island on the springs of its points and joints, which begin with what these bore and else without a load: of the
/// many ways in which forces may be in balance it is one that came about without wedging anything. Points that would
/// have to pull let go, and who would have to rub harder than Coulomb's law allows gives way, until the others bear
/// what they can. Points across which no load presses, as between crates side by side, are left out while it can be
/// done without them. These forces are then in balance and within their cones: nothing has a reason to move.
class Statics {
  public:
    /// Their matrix. For an island that is coupled like the one before, as piles of a crowd are, it is not analysed
    /// anew.
    struct Springs {
        BlockMatrix<3> matrix;
        std::size_t bodies = 0;
        Scratch<std::pair<std::uint32_t, std::uint32_t>> couplings;
    };
    /// Of the bodies in these rows, which have the accelerations that loads alone would give them, and so many
    /// contacts.
    Statics(const SoftScene&, const SoftContacts&, const Scratch<std::uint32_t>& rows, std::size_t count, Springs&);

    /// Adds the points at which a contact is closed, between the bodies at these places of the island: they touch, or
    /// press on one another by a preload, as near as that holds them.
    void add(SoftContact&, std::uint32_t place_a, std::uint32_t place_b);
    /// Adds what a mechanism's joints bear where its bodies are, with their places in the island by row. False if they
    /// do not hold there, and are to be put right first, or what they bear is not for this.
    bool add(const Mechanism&, const State&, const Scratch<std::uint32_t>& place);

    /// False if there are none, or none were found.
    bool find_forces();
    /// Whether it explains every overlap, in substeps of h [s].
    bool explains_overlaps(double h) const;
    /// Whether these velocities of the bodies, in their places by threes, are none: what rolls or slides freely is no
    /// faster than `most` [m/s], and dry friction takes the others in dt [s].
    bool can_stop(Scratch<double> velocities, double most, double dt);
    /// [m/s], of velocities by threes; turning counts by the radius of gyration.
    double fastest(const Scratch<double>& velocities) const;
    /// Products of blocks so far.
    std::size_t work() const { return work_; }

    /// Overlaps stay as they are: what a spring bears more than before it bears by its preload. Never less than by
    /// its overlap alone: that would be another way to overlap by more each time. Joints are rigid and have none.
    void write_forces() const;

  private:
    /// A direction in which something holds, as a spring does.
    struct Prop {
        IslandRow row;
        double limit;   ///< largest force; of a contact's friction, for a normal force of 1
        double mass;    ///< effective [kg, kg m²]; 0 if it does not hold at all
        double before;  ///< what it bore so far [N], of rolling or turning [N m]
        double stiffness = mass;
        double force = 0;  ///< that it bears, likewise
    };
    /// What pushes one way only, or not at all.
    struct Stop {
        Prop along;
        double sign = 1;  ///< of its force
        bool is_closed = true;
        int opened = 0;  ///< so many times

        double bears() const { return sign * along.force; }
        /// How fast the two go into one another.
        double nears(const Scratch<double>& v) const { return -sign * along.row.speed(v); }
    };
    struct Support : Stop {
        SoftContact* contact;
        int point;
        Prop slip, roll;
    };
    /// A row of a joint.
    struct RowOfJoint {
        JointMemory* memory;
        std::uint32_t row;
    };
    /// It is kept, or dry friction or a motor keeps it as far as these can.
    struct Tie : RowOfJoint {
        Prop along;
        double braked;  ///< what bears more, between limits that are one, is at one of them
    };
    struct Limit : RowOfJoint, Stop {
        Step step;
    };
    struct Drawn : RowOfJoint {
        double force;  ///< of a spring, where it is
        bool is_most;
    };

    Prop prop(const IslandRow&, double limit, double before) const;
    bool is_loaded(Vec2 along, std::uint32_t place_a, std::uint32_t place_b) const;
    bool is_edited(std::uint32_t row, std::uint32_t place) const;
    void add(const Law&, double at, double hair, const IslandRow&, RowOfJoint);
    void draw(const IslandRow&, const Law&, double at, RowOfJoint);
    void even_out(std::size_t first_tie);
    template <class Act>
    void each_prop(Act act);
    template <class Act>
    void each_stop(Act act);
    void analyse();
    void factor();
    bool balance(int most_rounds);
    bool is_small(const Scratch<double>& left, const Scratch<double>& size, double part) const;
    double nothing() const;
    bool pulls(const Stop&) const;
    std::size_t count_over() const;
    bool close_all();
    static bool ease(const Scratch<Support*>& points, Prop Support::*of, double bears);
    struct Given {
        bool way = false, closes = false;  ///< anything at all, and somebody closed
    };
    Given give_way(double part, bool falls, double bears);

    const SoftScene& scene_;
    const SoftContacts& contacts_;
    IslandBodies bodies_;
    Scratch<double> loads_;  ///< on each body, three numbers [N, N m]
    Scratch<double> sizes_;  ///< of what these are sums of
    Scratch<double> v_;      ///< accelerations that the springs leave, likewise
    Scratch<double> bent_;   ///< by how much they give way, likewise
    double fastest_ = 0;
    double stiffness_ = 0;  ///< of springs, in masses
    Scratch<Support> supports_;
    Scratch<std::pair<SoftContact*, int>> apart_;  ///< points that bear nothing, whatever they bore on the way here
    Scratch<Tie> ties_;
    Scratch<Limit> limits_;
    Scratch<Drawn> drawn_;
    Scratch<RowOfJoint> rows_;  ///< all of them
    Scratch<std::pair<std::uint32_t, std::uint32_t>> couplings_;
    Springs& springs_;
    std::size_t work_ = 0;
};

}  // namespace carom
