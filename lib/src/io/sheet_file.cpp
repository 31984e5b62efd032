#include "glissade/io/sheet_file.hpp"

#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"

#include "drawing/glyphs.hpp"
#include "drawing/ink.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

namespace glissade {
namespace {

constexpr double kPointsPerMillimetre = 72.0 / 25.4;
/// Capital letters over the size of the font.
constexpr double kCapitalShare = 0.7;

struct SurfaceEnd {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextEnd {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
struct FontEnd {
  void operator()(cairo_font_face_t* face) const { cairo_font_face_destroy(face); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceEnd>;
using Context = std::unique_ptr<cairo_t, ContextEnd>;
using Font = std::unique_ptr<cairo_font_face_t, FontEnd>;

cairo_status_t append_bytes(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

// --- paths

/// Adds a path to the context's; its y axis points up.
void trace(cairo_t* context, const ArcPath& path) {
  const std::vector<PathPiece> pieces = pieces_of(path);
  if (pieces.empty()) return;
  cairo_new_sub_path(context);
  cairo_move_to(context, pieces.front().from.x, pieces.front().from.y);
  for (const PathPiece& piece : pieces) {
    if (piece.straight()) {
      cairo_line_to(context, piece.to.x, piece.to.y);
      continue;
    }
    const CircularArc arc = arc_of(piece);
    const double end = arc.start_angle + arc.sweep;
    if (arc.sweep > 0.0) {
      cairo_arc(context, arc.centre.x, arc.centre.y, arc.radius, arc.start_angle, end);
    } else {
      cairo_arc_negative(context, arc.centre.x, arc.centre.y, arc.radius, arc.start_angle, end);
    }
  }
  if (path.closed) cairo_close_path(context);
}

// --- lettering

/// Glyphs are numbered by their characters.
cairo_status_t number_glyph(cairo_scaled_font_t* /*font*/, unsigned long character, unsigned long* glyph) {
  *glyph = character;
  return CAIRO_STATUS_SUCCESS;
}

cairo_status_t draw_glyph(cairo_scaled_font_t* /*font*/, unsigned long number, cairo_t* context,
                          cairo_text_extents_t* extents) {
  const drawing::Glyph& glyph = drawing::glyph_of(static_cast<char32_t>(number));
  const double unit = kCapitalShare / drawing::kCapitalHeight;
  extents->x_advance = (glyph.width + drawing::kLetterSpacing) * unit;
  cairo_scale(context, unit, -unit);
  cairo_set_line_width(context, drawing::kPenWidth);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  for (const ArcPath& stroke : glyph.strokes) trace(context, stroke);
  cairo_stroke(context);
  return CAIRO_STATUS_SUCCESS;
}

Font lettering() {
  Font face(cairo_user_font_face_create());
  cairo_user_font_face_set_render_glyph_func(face.get(), draw_glyph);
  cairo_user_font_face_set_unicode_to_glyph_func(face.get(), number_glyph);
  return face;
}

/// @return the text without what cairo or a reader would stumble over: control characters and broken UTF-8
std::string printable(const std::string& text) {
  std::string clean;
  for (std::size_t i = 0, k = 0; i < text.size(); ++k) {
    const char32_t character = drawing::characters_of(std::string_view(text).substr(i))[0];
    const std::size_t size = character < 0x80 ? 1 : character < 0x800 ? 2 : character < 0x10000 ? 3 : 4;
    if (character == 0xFFFD) {
      clean += '?';
      ++i;
      continue;
    }
    clean += character < 0x20 || character == 0x7F ? std::string(" ") : text.substr(i, size);
    i += size;
  }
  return clean;
}

// --- ink

class Painter {
 public:
  /// @param font  none: texts become strokes
  Painter(cairo_t* context, cairo_font_face_t* font) : context_(context), font_(font) {}

  void paint(const drawing::Ink& ink) {
    cairo_save(context_);
    if (ink.clip) {
      cairo_rectangle(context_, ink.clip->low.x, ink.clip->low.y, ink.clip->width(), ink.clip->height());
      cairo_clip(context_);
    }
    cairo_set_source_rgb(context_, 0.0, 0.0, 0.0);
    Pen pen;
    // Lines of one pen are one stroke in a PDF: they are all black, so only what is filled between them keeps its turn.
    // In an SVG each stays a thing of its own, to be picked.
    const auto take = [&](const Pen& next) {
      if (next == pen && font_ != nullptr) return;
      stroke(pen);
      pen = next;
    };
    for (const DrawnPath& drawn : ink.drawing.paths) {
      const DrawingLayer& layer = ink.drawing.layers[drawn.layer];
      if (drawn.filled) {
        stroke(pen);
        trace(context_, drawn.path);
        const double grey = lightness(drawn.colour);
        cairo_set_source_rgb(context_, grey, grey, grey);
        cairo_fill(context_);
        cairo_set_source_rgb(context_, 0.0, 0.0, 0.0);
      } else {
        take({layer.width_mm, drawn.style.value_or(layer.style)});
        trace(context_, drawn.path);
      }
    }
    for (const DrawnCircle& drawn : ink.drawing.circles) {
      const DrawingLayer& layer = ink.drawing.layers[drawn.layer];
      take({layer.width_mm, layer.style});
      trace(context_, path_of(drawn.circle));
    }
    stroke(pen);
    for (const DrawnText& text : ink.drawing.texts) write(text);
    cairo_restore(context_);
  }

 private:
  /// Of a filled area on paper: the greys of AutoCAD's index from 250 on, everything else is black.
  static double lightness(int colour) {
    static constexpr double kGreys[] = {0.2, 0.36, 0.52, 0.68, 0.84, 1.0};
    return colour >= 250 && colour <= 255 ? kGreys[colour - 250] : 0.0;
  }
  struct Pen {
    double width = 0.0;  ///< [mm]
    LineStyle style = LineStyle::continuous;
    friend bool operator==(const Pen&, const Pen&) = default;
  };

  /// Draws what has been traced.
  void stroke(const Pen& pen) {
    if (!cairo_has_current_point(context_)) return;
    static constexpr double kDashes[] = {3.0, 1.5};
    static constexpr double kChain[] = {8.0, 1.5, 0.5, 1.5};
    cairo_set_line_width(context_, pen.width);
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_MITER);
    if (pen.style == LineStyle::dashed) {
      cairo_set_dash(context_, kDashes, 2, 0.0);
    } else if (pen.style == LineStyle::chain) {
      cairo_set_dash(context_, kChain, 4, 0.0);
    } else {
      cairo_set_dash(context_, nullptr, 0, 0.0);
    }
    cairo_stroke(context_);
  }

  void write(const DrawnText& text) {
    const std::string words = printable(text.text);
    if (font_ == nullptr) {
      for (const ArcPath& path : stroked_text(words, text.at, text.height_mm, text.angle, text.anchor)) {
        trace(context_, path);
      }
      cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
      cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
      cairo_set_dash(context_, nullptr, 0, 0.0);
      cairo_set_line_width(context_, text.height_mm * drawing::kPenWidth / drawing::kCapitalHeight);
      cairo_stroke(context_);
      return;
    }
    const double width = stroked_width(words, text.height_mm);
    const double share = text.anchor == TextAnchor::left     ? 0.0
                         : text.anchor == TextAnchor::centre ? 0.5
                                                             : 1.0;
    cairo_save(context_);
    cairo_translate(context_, text.at.x, text.at.y);
    cairo_rotate(context_, text.angle.radians());
    cairo_scale(context_, 1.0, -1.0);
    cairo_set_font_face(context_, font_);
    cairo_set_font_size(context_, text.height_mm / kCapitalShare);
    cairo_move_to(context_, -share * width, 0.0);
    cairo_show_text(context_, words.c_str());
    cairo_restore(context_);
  }

  cairo_t* context_;
  cairo_font_face_t* font_;
};

bool finite(const Drawing& drawing) {
  double sum = 0.0;
  for (const DrawnPath& drawn : drawing.paths) {
    for (const PathVertex& vertex : drawn.path.vertices)
      sum += 0.0 * (vertex.at.x + vertex.at.y + vertex.bulge);
  }
  for (const DrawnCircle& drawn : drawing.circles) {
    sum += 0.0 * (drawn.circle.centre.x + drawn.circle.centre.y + drawn.circle.radius);
  }
  for (const DrawnText& text : drawing.texts)
    sum += 0.0 * (text.at.x + text.at.y + text.height_mm + text.angle.radians());
  return sum == 0.0;
}

void paint_sheet(cairo_t* context, cairo_font_face_t* font, const Sheet& sheet, double per_mm) {
  cairo_save(context);
  // y up, in millimetres.
  cairo_translate(context, 0.0, sheet.height_mm * per_mm);
  cairo_scale(context, per_mm, -per_mm);
  Painter painter(context, font);
  for (const drawing::Ink& ink : drawing::ink_of(sheet)) {
    if (!finite(ink.drawing)) {
      throw InputError(
          {"sheet " + sheet.title.sheet + " " + sheet.title.title, "a number is not finite", "", ""});
    }
    painter.paint(ink);
  }
  cairo_restore(context);
}

void require_success(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw InternalError({"cairo", cairo_status_to_string(status), "", ""});
}

}  // namespace

std::string pdf_text(const std::vector<Sheet>& sheets, const std::string& title) {
  if (sheets.empty()) throw InputError({"drawing set", "has no sheet", "A PDF has one or more.", ""});
  std::string text;
  {
    const Surface surface(cairo_pdf_surface_create_for_stream(append_bytes, &text, 1.0, 1.0));
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, printable(title).c_str());
    // Cairo puts the clock's time here unless it is told another.
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "1980-01-01T00:00:00Z");
    const Context context(cairo_create(surface.get()));
    const Font font = lettering();
    for (const Sheet& sheet : sheets) {
      cairo_pdf_surface_set_size(surface.get(), sheet.width_mm * kPointsPerMillimetre,
                                 sheet.height_mm * kPointsPerMillimetre);
      paint_sheet(context.get(), font.get(), sheet, kPointsPerMillimetre);
      cairo_show_page(context.get());
    }
    require_success(cairo_status(context.get()));
    cairo_surface_finish(surface.get());
    require_success(cairo_surface_status(surface.get()));
  }
  return text;
}

std::string svg_text(const Sheet& sheet) {
  std::string text;
  {
    const Surface surface(
        cairo_svg_surface_create_for_stream(append_bytes, &text, sheet.width_mm, sheet.height_mm));
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_MM);
    const Context context(cairo_create(surface.get()));
    // Cairo's SVG has glyphs as symbols of coarse outlines: strokes are finer and shorter.
    paint_sheet(context.get(), nullptr, sheet, 1.0);
    require_success(cairo_status(context.get()));
    cairo_surface_finish(surface.get());
    require_success(cairo_surface_status(surface.get()));
  }
  // Cairo numbers its surfaces within a process.
  constexpr std::string_view kNumbered = "id=\"surface";
  const std::size_t start = text.find(kNumbered);
  if (start != std::string::npos) {
    const std::size_t end = text.find('"', start + kNumbered.size());
    text.replace(start, end - start, "id=\"sheet");
  }
  return text;
}

void write_pdf(const std::filesystem::path& file, const std::vector<Sheet>& sheets,
               const std::string& title) {
  write_atomically(file, pdf_text(sheets, title));
}

void write_svg(const std::filesystem::path& file, const Sheet& sheet) {
  write_atomically(file, svg_text(sheet));
}

}  // namespace glissade
