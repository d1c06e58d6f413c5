#pragma once
// Contacts with friction by an interior point: sure where there are too many sets of contacts that push and slide.

#include "solvers/island_row.hpp"

namespace carom {

/// What a contact may give: a normal impulse that pushes, and of sliding and rolling no more than parts of it.
struct ContactCone {
    IslandRow normal, slip, roll;
    double mass;                           ///< effective, along the normal [kg]
    double friction, rolling;              ///< largest impulse of sliding, and of rolling [m], of a normal one of 1
    double speed, slip_speed, roll_speed;  ///< that are wanted
};
struct ConeImpulse {
    double normal, slip, roll;
};

/// In the plane a cone has edges, four with rolling, and its impulses are sums of impulses along these that pull
/// nowhere: min ½ |v − v̂|²_M where every edge comes apart at the speed wanted at least. That is a quadratic programme,
/// solved by Mehrotra's predictor and corrector (Nocedal and Wright, Numerical Optimization, 2006, 16.6). Contacts that
/// slide would part by it; they are held together as in Acary, Cadoux, Lemaréchal, Malick, ZAMM 91 (2011) 155: the
/// speed wanted is less by friction times that of sliding, as the solution before had it.
class InteriorPoint {
  public:
    InteriorPoint(const IslandBodies& bodies, BlockMatrix<3>& matrix)
        : bodies_(bodies), matrix_(matrix), v_(bodies.free), step_(bodies.size()) {}
    void add(const ContactCone& cone);
    /// False if it does not come near enough to the solution.
    bool solve();

    const Scratch<double>& velocities() const { return v_; }
    /// Of the contact that was added as this one.
    ConeImpulse impulse(std::size_t contact) const;

  private:
    struct Edge {
        IslandRow row;
        double slip, roll;  ///< impulses of these, of a normal one of 1
        double compliance;
        double target = 0;            ///< the speed [m/s] wanted
        double impulse = 0, gap = 0;  ///< both positive: how fast it parts beyond what is wanted [m/s]
        double goal = 0;              ///< for their product
        double lack = 0;              ///< by how much gap and speed differ
        double weight = 0;            ///< by how much the impulse is less per speed
        double at_rest = 0;           ///< the change of impulse if no speed changed
        double impulse_change = 0, gap_change = 0;

        double below() const { return gap + compliance * impulse; }
        double wanted(const ContactCone& c, double lift) const {
            return c.speed - lift + slip * c.slip_speed + roll * c.roll_speed;
        }
    };
    /// What is known of a contact, and its edges.
    struct Contact {
        ContactCone cone;
        std::size_t first, end;
    };

    void begin();
    double follow_slip();
    void make_room(double speed);
    double step(double mean, double least);
    double aim();
    double mean_product() const;
    double lack(const Edge& edge) const;
    double worst_lack() const;
    bool fits(double part) const;
    double imbalance() const;
    /// Whether it is so near the solution for slips that are held: products are such a part of the first ones.
    bool is_near(double part, double of_products) const;

    const IslandBodies& bodies_;
    BlockMatrix<3>& matrix_;
    Scratch<double> v_, step_;
    Scratch<Contact> contacts_;
    Scratch<Edge> edges_;
    double fastest_ = 0;  ///< [m/s], of what moves and of what comes together
};

}  // namespace carom
