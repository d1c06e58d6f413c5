#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <carom/output.hpp>
#include <exception>

#include "output/paint.hpp"

namespace carom {
namespace {

/// Hands Cairo's bytes to a file. An Error cannot fly through Cairo, so it waits here.
struct Sink {
    File file;
    std::exception_ptr error{};

    static cairo_status_t write(void* self, const unsigned char* bytes, unsigned count) {
        auto& sink = *static_cast<Sink*>(self);
        if (sink.error) return CAIRO_STATUS_WRITE_ERROR;
        try {
            sink.file.write({reinterpret_cast<const char*>(bytes), count});
            return CAIRO_STATUS_SUCCESS;
        } catch (...) {
            sink.error = std::current_exception();
            return CAIRO_STATUS_WRITE_ERROR;
        }
    }
    void finish(cairo_status_t status) {
        if (error) std::rethrow_exception(error);
        if (status != CAIRO_STATUS_SUCCESS) {
            throw Error(fmt::format("cannot draw {}: {}", file.target().string(), cairo_status_to_string(status)),
                        Error::Cause::run);
        }
        file.commit();
    }
};

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

cairo_status_t paint(const World& world, const View& view, cairo_surface_t* surface) {
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo(cairo_create(surface), &cairo_destroy);
    Painter(cairo.get(), centred(view, world)).paint(world);
    return cairo_status(cairo.get());
}

}  // namespace

void draw(const World& world, const View& view, const std::filesystem::path& path) {
    check(view);
    const auto ending = path.extension();
    if (ending != ".png" && ending != ".svg" && ending != ".pdf") {
        throw Error(fmt::format("{}: a picture ends with .png, .svg or .pdf", path.string()));
    }
    Sink sink{File(path)};
    cairo_surface_t* made = ending == ".png" ? cairo_image_surface_create(CAIRO_FORMAT_RGB24, view.width, view.height)
                            : ending == ".svg"
                                ? cairo_svg_surface_create_for_stream(&Sink::write, &sink, view.width, view.height)
                                : cairo_pdf_surface_create_for_stream(&Sink::write, &sink, view.width, view.height);
    Surface surface(made, &cairo_surface_destroy);
    cairo_status_t status = paint(world, view, made);
    if (status == CAIRO_STATUS_SUCCESS && ending == ".png") {
        status = cairo_surface_write_to_png_stream(made, &Sink::write, &sink);
    }
    cairo_surface_finish(made);
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(made);
    sink.finish(status);
}

}  // namespace carom
