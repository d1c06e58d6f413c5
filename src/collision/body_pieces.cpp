#include "collision/convex.hpp"

namespace carom {

std::vector<Piece> pieces_of(const Bodies& bodies) {
    std::vector<Piece> all;
    all.reserve(bodies.size());
    for (std::uint32_t row = 0; row < bodies.size(); ++row) {
        Piece piece;
        piece.row = row;
        piece.restitution = bodies.restitution[row], piece.friction = bodies.friction[row];
        piece.outline.radius = bodies.radius[row];
        if (bodies.shapes[row].empty()) all.push_back(piece);
        for (const Shape& shape : bodies.shapes[row]) {
            piece.restitution = shape.restitution.value_or(bodies.restitution[row]);
            piece.friction = shape.friction.value_or(bodies.friction[row]);
            piece.rolling_resistance = shape.rolling_resistance, piece.surface_speed = shape.surface_speed;
            piece.sensor = shape.sensor, piece.filter = shape.filter;
            for (const Convex& outline : pieces_of(shape.geometry)) {
                piece.outline = outline;
                all.push_back(piece);
                ++piece.number;
            }
            ++piece.shape;
        }
    }
    return all;
}

}  // namespace carom
