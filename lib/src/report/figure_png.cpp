#include "glissade/report/figure_png.hpp"

#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"

#include <cmath>
#include <memory>

#include <cairo.h>
#include <librsvg/rsvg.h>

namespace glissade {
namespace {

template <auto release>
struct Release {
  void operator()(auto* object) const { release(object); }
};

using Handle = std::unique_ptr<RsvgHandle, Release<g_object_unref>>;
using Surface = std::unique_ptr<cairo_surface_t, Release<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Release<cairo_destroy>>;

Handle parsed(const std::string& svg) {
  GError* error = nullptr;
  Handle handle(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (handle) return handle;
  const std::string reason = error ? error->message : "unknown reason";
  g_clear_error(&error);
  throw InputError({"", "the drawing is not valid SVG: " + reason, "", ""});
}

cairo_status_t append(void* target, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void write_png(const std::filesystem::path& file, const std::string& svg, double scale) {
  const Handle handle = parsed(svg);
  double width = 0.0;
  double height = 0.0;
  if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height)) {
    throw InputError({"", "the drawing has no size in pixels", "", ""});
  }
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                   static_cast<int>(std::ceil(scale * width)),
                                                   static_cast<int>(std::ceil(scale * height))));
  const Context context(cairo_create(surface.get()));
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  const RsvgRectangle viewport{0.0, 0.0, scale * width, scale * height};
  GError* error = nullptr;
  if (!rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error)) {
    const std::string reason = error ? error->message : "unknown reason";
    g_clear_error(&error);
    throw InputError({"", "the drawing cannot be rendered: " + reason, "", ""});
  }
  std::string png;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &png) != CAIRO_STATUS_SUCCESS) {
    throw InternalError({"", "the picture could not be encoded", "", ""});
  }
  write_atomically(file, png);
}

}  // namespace glissade
