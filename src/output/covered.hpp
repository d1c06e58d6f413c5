#pragma once
#include <carom/vec2.hpp>
#include <vector>

namespace carom {

/// What a line has been drawn on already, of a panel of so many pixels.
class Covered {
  public:
    /// `line`: its width; 0 for marks, which stand at one place or another.
    Covered(double width, double height, double line);

    /// False if the line from a to b would change nothing, or is outside. Otherwise it is taken to be drawn.
    bool adds(Vec2 a, Vec2 b);

  private:
    template <class F>
    bool over(Vec2 a, Vec2 b, double half, double apart, F f) const;
    void mark(Vec2 a, Vec2 b);

    std::size_t columns_, rows_;
    double half_;
    std::vector<unsigned char> seen_;  // a byte each, for they are set by rows
};

}  // namespace carom
