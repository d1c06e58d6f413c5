#pragma once
#include <cairo.h>

#include <array>
#include <carom/output.hpp>
#include <deque>
#include <map>

namespace carom {

inline constexpr int caption_height = 36;  ///< pixels
inline constexpr Colour wall_colour{70, 70, 70, 255}, paper{255, 255, 255, 255}, ink_colour{34, 34, 34, 255};

/// An Error if nothing can be drawn through it.
void check(const View& view);
/// The point of the world where a body's anchor is.
Vec2 end_of(const World& world, BodyId body, Vec2 anchor);
/// The same of a joint's body; the ground's anchors are points of the world.
Vec2 end_of(const World& world, const std::optional<BodyId>& body, Vec2 anchor);
/// The rope of a pulley: from one body up to the ground, across, and down to the other.
std::array<Line, 3> rope_of(const World& world, const Joint& joint, const PulleyJoint& pulley);
/// The body's colour; a fixed or driven one that was given none is grey.
Colour fill_of(const Body& body, BodyId id);
/// The same of a part without an inside; a fixed one looks like a wall.
Colour line_of(const Body& body, BodyId id);
/// Whether a disc has a radius that shows how it is turned.
bool shows_angle(const Body& body);

/// Where a body is to be seen: what leaves a periodic box on one side comes in on the other.
std::vector<Vec2> places(const World& world, Vec2 position);
/// 1, 2 or 5 times a power of ten, not above what is wanted.
double round_length(double wanted);
std::string with_prefix(double value, const char* unit);

/// The last places of one body.
struct Trail {
    Colour colour{};
    std::deque<std::pair<double, Vec2>> places{};  ///< time [s] and position [m]
};

/// Paints one picture. Lengths on paper are pixels; the world's are metres.
class Painter {
  public:
    Painter(cairo_t* cairo, View view) : cairo_(cairo), view_(std::move(view)), scale_(view_.scale()) {}
    void paint(const World& world, const std::map<BodyId, Trail>* trails = nullptr);

  private:
    /// How a body looks, and where.
    struct Appearance {
        Vec2 position;
        double angle;
        Colour fill, line;
        Kind kind;
        bool marked;  ///< a radius shows how a disc is turned
    };
    void background();
    void scene(const World& world, const std::map<BodyId, Trail>* trails);
    /// Where the scene is to be drawn: once, or of a periodic box that is followed through, box beside box.
    std::vector<Vec2> repeats(const World& world) const;
    double grid_spacing() const;
    /// Of the plane, in all of the picture above the caption [m].
    Bounds all_seen() const;
    void grid();
    void grid_numbers();
    /// What a pattern begins at, so that it lies still on what it is drawn on while the view moves.
    Vec2 origin() const { return view_.follow ? view_.pixel({0, 0}) : Vec2{}; }
    void walls(const World& world);
    void room(const Rectangle& walls);
    void stadium(const Stadium& walls);
    void half_plane(const HalfPlane& wall);
    void periodic(const Periodic& box);
    void clip_to(const Periodic& box);
    void tracks(const World& world);
    void way(const World& world, Vec2 from, Vec2 to);
    void trail(const World& world, const Trail& trail);
    void springs(const World& world);
    void coil(Vec2 from, Vec2 to, double rest_length);
    void bodies(const World& world, bool small);
    void joints(const World& world);
    void joint(const World& world, const Joint& joint, const DistanceJoint& rod);
    void joint(const World& world, const Joint& joint, const RevoluteJoint& hinge);
    void joint(const World& world, const Joint& joint, const PrismaticJoint& slide);
    void joint(const World& world, const Joint& joint, const WeldJoint& weld);
    void joint(const World& world, const Joint& joint, const WheelJoint& wheel);
    void joint(const World& world, const Joint& joint, const GearJoint& gear);
    void joint(const World& world, const Joint& joint, const PulleyJoint& pulley);
    void joint(const World& world, const Joint& joint, const DragHandle& hand);
    template <class T>
    void joint(const World&, const Joint&, const T&) {}  // motors, dry friction and filters are not seen
    void segment(Vec2 from, Vec2 to, double width, bool dashed = false);
    void pin(Vec2 at, double radius);
    void rail(const World& world, const Joint& joint, Vec2 axis);
    void disc(const Appearance& body, double radius);
    void point(const Appearance& body);
    void shape(const Appearance& body, const Shape& shape);
    void inside(const Appearance& body, bool sensor, Vec2 low, Vec2 high);
    void line(const Appearance& body, const std::vector<Vec2>& pixels, bool sensor, bool one_sided);
    void radius_line(const Appearance& body, Vec2 from, double length);
    void hatch(Vec2 low, Vec2 high);
    void contact_forces(const World& world);
    void arrow(Vec2 from, Vec2 way, Colour paint);
    void caption(const World& world);
    /// Returns where it ends.
    double scale_bar(double middle);
    void force_bar(double left, double middle);

    void colour(Colour colour, double opacity = 1);
    void move_to(Vec2 pixel) { cairo_move_to(cairo_, pixel.x, pixel.y); }
    void line_to(Vec2 pixel) { cairo_line_to(cairo_, pixel.x, pixel.y); }
    void stroke(double width);
    void dash();
    double scene_height() const { return view_.height - (view_.caption ? caption_height : 0); }

    cairo_t* cairo_;
    View view_;
    double scale_;
    double pixels_per_newton_ = 0;  ///< of the contact forces, if any were drawn
};

}  // namespace carom
