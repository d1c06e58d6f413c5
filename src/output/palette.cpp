#include <array>
#include <carom/output.hpp>

namespace carom {

Colour palette(std::size_t i) {
    // Okabe and Ito's, in the order of the bodies' usual colours, so that a curve looks like its body; but black in the
    // place of yellow, which is too faint for a line on white.
    static constexpr std::array<Colour, 7> colours{{{0, 114, 178, 255},
                                                    {230, 159, 0, 255},
                                                    {0, 158, 115, 255},
                                                    {213, 94, 0, 255},
                                                    {86, 180, 233, 255},
                                                    {204, 121, 167, 255},
                                                    {0, 0, 0, 255}}};
    return colours[i % colours.size()];
}

}  // namespace carom
