#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/dxf_file.hpp"

#include "drawing/extents.hpp"
#include "drawing/glyphs.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>

// Structure of the file: Autodesk's DXF reference (AC1015), and which of it readers insist on: ezdxf's notes on the
// internal structure. Every group is a line with a code and a line with its value.

namespace glissade {
namespace {

constexpr std::string_view kModelSpace = "*Model_Space";
constexpr std::string_view kPaperSpace = "*Paper_Space";

/// Handles of what every file has; those of layers and entities follow.
enum Handle : std::uint32_t {
  kVportTable = 1,
  kLtypeTable,
  kLayerTable,
  kStyleTable,
  kViewTable,
  kUcsTable,
  kAppidTable,
  kDimstyleTable,
  kBlockTable,
  kModelRecord,
  kPaperRecord,
  kModelBlock,
  kModelEnd,
  kPaperBlock,
  kPaperEnd,
  kByBlock,
  kByLayer,
  kContinuous,
  kDashed,
  kCentre,
  kStandardStyle,
  kAcadAppid,
  kStandardDimstyle,
  kRootDictionary,
  kGroupDictionary,
  kLayoutDictionary,
  kModelLayout,
  kPaperLayout,
  kPlotStyles,
  kPlotStyle,
  kFirstFree
};

class DxfText {
 public:
  void group(int code, std::string_view value) {
    number(code);
    text_ += value;
    text_ += '\n';
  }
  void group(int code, int value) {
    number(code);
    number(value);
  }
  void group(int code, double value) {
    number(code);
    // Without an exponent: not every machine's control reads one. The smallest double takes some 350 digits.
    std::array<char, 400> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value + 0.0, std::chars_format::fixed)
            .ptr;
    text_.append(digits.data(), end);
    text_ += '\n';
  }
  void handle(int code, std::uint32_t value) {
    number(code);
    std::array<char, 16> digits{};
    char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
    std::transform(digits.data(), end, digits.data(),
                   [](char c) { return c >= 'a' && c <= 'f' ? static_cast<char>(c - 'a' + 'A') : c; });
    text_.append(digits.data(), end);
    text_ += '\n';
  }
  void point(int code, Vec2 place) {
    group(code, place.x);
    group(code + 10, place.y);
  }
  void point3(int code, Vec2 place) {
    point(code, place);
    group(code + 20, 0.0);
  }
  void reserve(std::size_t bytes) { text_.reserve(bytes); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void number(int value) {
    std::array<char, 16> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text_.append(digits.data(), end);
    text_ += '\n';
  }

  std::string text_;
};

std::string_view line_type(LineStyle style) {
  return style == LineStyle::dashed ? "DASHED" : style == LineStyle::chain ? "CENTER" : "Continuous";
}

/// @return the nearest of the line widths that DXF knows, in hundredths of a millimetre
int line_weight(double width_mm) {
  constexpr std::array kWeights = {0,  5,  9,  13, 15, 18,  20,  25,  30,  35,  40,  50,
                                   53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211};
  return *std::min_element(kWeights.begin(), kWeights.end(), [&](int a, int b) {
    return std::fabs(a - 100.0 * width_mm) < std::fabs(b - 100.0 * width_mm);
  });
}

/// @return ASCII for a group's value: \U+xxxx for other characters, spaces for control characters
std::string ascii_text(const std::string& text) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string ascii;
  for (const char32_t character : drawing::characters_of(text)) {
    if (character < 0x20 || character == 0x7F) {
      ascii += ' ';
    } else if (character < 0x7F) {
      ascii += static_cast<char>(character);
    } else {
      ascii += "\\U+";
      for (int shift = 12; shift >= 0; shift -= 4) {
        ascii += kDigits[(static_cast<std::uint32_t>(character) >> static_cast<unsigned>(shift)) & 0xFU];
      }
    }
  }
  return ascii;
}

void require_layer(const Drawing& drawing, std::size_t layer) {
  if (layer < drawing.layers.size()) return;
  throw InputError(
      {"drawing " + drawing.name,
       "an entity is on layer " + std::to_string(layer) + " of " + std::to_string(drawing.layers.size()),
       "Layers are counted from 0.", ""});
}

void require_finite(const Drawing& drawing, std::string_view kind, double sum) {
  if (std::isfinite(sum)) return;
  throw InputError(
      {"drawing " + drawing.name, "a number of a " + std::string(kind) + " is not finite", "", ""});
}

void require_layers(const Drawing& drawing) {
  std::set<std::string> names;
  for (const DrawingLayer& layer : drawing.layers) {
    const bool plain = !layer.name.empty() && std::all_of(layer.name.begin(), layer.name.end(), [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
             c == '-';
    });
    if (!plain) {
      throw InputError({"layer \"" + layer.name + "\"", "its name has other characters than DXF readers take",
                        "ASCII letters, digits, \"_\" and \"-\".", ""});
    }
    if (!names.insert(layer.name).second) {
      throw InputError({"layer \"" + layer.name + "\"", "two layers have this name", "", ""});
    }
  }
}

void require_writable(const Drawing& drawing) {
  require_layers(drawing);
  for (const DrawnPath& drawn : drawing.paths) {
    require_layer(drawing, drawn.layer);
    for (const PathVertex& vertex : drawn.path.vertices) {
      require_finite(drawing, "path", vertex.at.x + vertex.at.y + vertex.bulge);
    }
  }
  for (const DrawnCircle& drawn : drawing.circles) {
    require_layer(drawing, drawn.layer);
    require_finite(drawing, "circle", drawn.circle.centre.x + drawn.circle.centre.y + drawn.circle.radius);
  }
  for (const DrawnText& text : drawing.texts) {
    require_layer(drawing, text.layer);
    require_finite(drawing, "text", text.at.x + text.at.y + text.height_mm + text.angle.radians());
  }
}

/// One file on its way.
class DxfFile {
 public:
  DxfFile(const Drawing& drawing, DxfVersion version)
      : drawing_(drawing), r2000_(version == DxfVersion::r2000) {}

  std::string whole() {
    out_.reserve(8192 + 256 * (drawing_.paths.size() + drawing_.circles.size() + drawing_.texts.size()));
    header();
    if (r2000_) {
      section("CLASSES");
      end_section();
    }
    tables();
    if (r2000_) blocks();
    entities();
    if (r2000_) objects();
    out_.group(0, "EOF");
    return out_.take();
  }

 private:
  void section(std::string_view name) {
    out_.group(0, "SECTION");
    out_.group(2, name);
  }
  void end_section() { out_.group(0, "ENDSEC"); }

  void variable(std::string_view name, int code, int value) {
    out_.group(9, name);
    out_.group(code, value);
  }

  void header() {
    constexpr int kUnitIsMillimetre = 4;
    const PlaneBox box = drawing::extents(drawing_).value_or(PlaneBox{});
    // As many handles as entities and layers need: the seed lies above all of them.
    std::size_t handles =
        kFirstFree + drawing_.layers.size() + drawing_.circles.size() + drawing_.texts.size();
    for (const DrawnPath& drawn : drawing_.paths) handles += r2000_ ? 1 : drawn.path.vertices.size();
    section("HEADER");
    out_.group(9, "$ACADVER");
    out_.group(1, r2000_ ? "AC1015" : "AC1009");
    out_.group(9, "$DWGCODEPAGE");
    out_.group(3, "ANSI_1252");
    variable("$INSUNITS", 70, kUnitIsMillimetre);
    variable("$MEASUREMENT", 70, 1);
    out_.group(9, "$EXTMIN");
    out_.point3(10, box.low);
    out_.group(9, "$EXTMAX");
    out_.point3(10, box.high);
    out_.group(9, "$HANDSEED");
    out_.handle(5, static_cast<std::uint32_t>(handles));
    end_section();
  }

  // --- tables

  void table(std::string_view name, Handle handle, std::size_t entries) {
    out_.group(0, "TABLE");
    out_.group(2, name);
    if (r2000_) {
      out_.handle(5, handle);
      out_.group(330, "0");
      out_.group(100, "AcDbSymbolTable");
    }
    out_.group(70, static_cast<int>(entries));
  }
  void end_table() { out_.group(0, "ENDTAB"); }

  void entry(std::string_view kind, std::uint32_t handle, Handle owner, std::string_view subclass,
             std::string_view name, int handle_code = 5) {
    out_.group(0, kind);
    if (r2000_) {
      out_.handle(handle_code, handle);
      out_.handle(330, owner);
      out_.group(100, "AcDbSymbolTableRecord");
      out_.group(100, subclass);
    }
    out_.group(2, name);
  }

  void line_type_entry(Handle handle, std::string_view name, std::initializer_list<double> dashes) {
    entry("LTYPE", handle, kLtypeTable, "AcDbLinetypeTableRecord", name);
    double total = 0.0;
    for (const double dash : dashes) total += std::fabs(dash);
    out_.group(70, 0);
    out_.group(3, "");
    out_.group(72, 65);
    out_.group(73, static_cast<int>(dashes.size()));
    out_.group(40, total);
    for (const double dash : dashes) {
      out_.group(49, dash);
      if (r2000_) out_.group(74, 0);
    }
  }

  void line_types() {
    const auto used = [&](LineStyle style) {
      return std::any_of(drawing_.layers.begin(), drawing_.layers.end(),
                         [&](const DrawingLayer& layer) { return layer.style == style; }) ||
             std::any_of(drawing_.paths.begin(), drawing_.paths.end(),
                         [&](const DrawnPath& drawn) { return drawn.style == style; });
    };
    const bool dashed = used(LineStyle::dashed);
    const bool chain = used(LineStyle::chain);
    table("LTYPE", kLtypeTable, (r2000_ ? 3U : 1U) + (dashed ? 1U : 0U) + (chain ? 1U : 0U));
    if (r2000_) {
      line_type_entry(kByBlock, "ByBlock", {});
      line_type_entry(kByLayer, "ByLayer", {});
    }
    line_type_entry(kContinuous, "Continuous", {});
    const double k = drawing_.text_scale;
    if (dashed) line_type_entry(kDashed, "DASHED", {6.0 * k, -3.0 * k});
    if (chain) line_type_entry(kCentre, "CENTER", {12.0 * k, -3.0 * k, 1.5 * k, -3.0 * k});
    end_table();
  }

  void layer_entry(const DrawingLayer& layer, std::uint32_t handle) {
    entry("LAYER", handle, kLayerTable, "AcDbLayerTableRecord", layer.name);
    out_.group(70, 0);
    out_.group(62, layer.colour);
    out_.group(6, line_type(layer.style));
    if (!r2000_) return;
    out_.group(370, line_weight(layer.width_mm));
    out_.handle(390, kPlotStyle);
  }

  void layers() {
    const bool has_zero = std::any_of(drawing_.layers.begin(), drawing_.layers.end(),
                                      [](const DrawingLayer& layer) { return layer.name == "0"; });
    table("LAYER", kLayerTable, drawing_.layers.size() + (has_zero ? 0 : 1));
    // Layer 0 is there in every drawing, whether it is used or not.
    if (!has_zero) layer_entry({"0", LineStyle::continuous, 0.25, 7}, next_++);
    for (const DrawingLayer& layer : drawing_.layers) layer_entry(layer, next_++);
    end_table();
  }

  void style() {
    table("STYLE", kStyleTable, 1);
    entry("STYLE", kStandardStyle, kStyleTable, "AcDbTextStyleTableRecord", "Standard");
    out_.group(70, 0);
    out_.group(40, 0);
    out_.group(41, 1);
    out_.group(50, 0);
    out_.group(71, 0);
    out_.group(42, 2.5);
    out_.group(3, "txt");
    out_.group(4, "");
    end_table();
  }

  void block_record(Handle handle, std::string_view name, Handle layout) {
    entry("BLOCK_RECORD", handle, kBlockTable, "AcDbBlockTableRecord", name);
    out_.handle(340, layout);
  }

  void tables() {
    section("TABLES");
    if (r2000_) {
      table("VPORT", kVportTable, 0);
      end_table();
    }
    line_types();
    layers();
    style();
    if (r2000_) {
      table("VIEW", kViewTable, 0);
      end_table();
      table("UCS", kUcsTable, 0);
      end_table();
      table("APPID", kAppidTable, 1);
      entry("APPID", kAcadAppid, kAppidTable, "AcDbRegAppTableRecord", "ACAD");
      out_.group(70, 0);
      end_table();
      table("DIMSTYLE", kDimstyleTable, 1);
      out_.group(100, "AcDbDimStyleTable");
      entry("DIMSTYLE", kStandardDimstyle, kDimstyleTable, "AcDbDimStyleTableRecord", "Standard", 105);
      out_.group(70, 0);
      end_table();
      table("BLOCK_RECORD", kBlockTable, 2);
      block_record(kModelRecord, kModelSpace, kModelLayout);
      block_record(kPaperRecord, kPaperSpace, kPaperLayout);
      end_table();
    }
    end_section();
  }

  void block(std::string_view name, Handle record, Handle begin, Handle end) {
    out_.group(0, "BLOCK");
    object(begin, record);
    out_.group(100, "AcDbEntity");
    out_.group(8, "0");
    out_.group(100, "AcDbBlockBegin");
    out_.group(2, name);
    out_.group(70, 0);
    out_.point3(10, {});
    out_.group(3, name);
    out_.group(1, "");
    out_.group(0, "ENDBLK");
    object(end, record);
    out_.group(100, "AcDbEntity");
    out_.group(8, "0");
    out_.group(100, "AcDbBlockEnd");
  }

  void blocks() {
    section("BLOCKS");
    block(kModelSpace, kModelRecord, kModelBlock, kModelEnd);
    block(kPaperSpace, kPaperRecord, kPaperBlock, kPaperEnd);
    end_section();
  }

  // --- entities

  void object(std::uint32_t handle, std::uint32_t owner) {
    out_.handle(5, handle);
    out_.handle(330, owner);
  }

  void entity(std::string_view kind, std::size_t layer, std::string_view subclass, int colour = 0,
              std::optional<LineStyle> style = {}) {
    out_.group(0, kind);
    if (r2000_) {
      object(next_++, kModelRecord);
      out_.group(100, "AcDbEntity");
    }
    out_.group(8, drawing_.layers[layer].name);
    if (style) out_.group(6, line_type(*style));
    if (colour != 0) out_.group(62, colour);
    if (r2000_) out_.group(100, subclass);
  }

  void polyline(const DrawnPath& drawn) {
    entity("LWPOLYLINE", drawn.layer, "AcDbPolyline", drawn.colour, drawn.style);
    out_.group(90, static_cast<int>(drawn.path.vertices.size()));
    out_.group(70, drawn.path.closed ? 1 : 0);
    // Where bulges are written, every vertex has one: readers are known that fail otherwise.
    const bool curved = std::any_of(drawn.path.vertices.begin(), drawn.path.vertices.end(),
                                    [](const PathVertex& vertex) { return vertex.bulge != 0.0; });
    for (const PathVertex& vertex : drawn.path.vertices) {
      out_.point(10, vertex.at);
      if (curved) out_.group(42, vertex.bulge);
    }
  }

  void piece(const DrawnPath& drawn, const PathPiece& piece) {
    if (piece.straight()) {
      entity("LINE", drawn.layer, "AcDbLine", drawn.colour, drawn.style);
      out_.point3(10, piece.from);
      out_.point3(11, piece.to);
      return;
    }
    const CircularArc arc = arc_of(piece);
    // DXF arcs run counter-clockwise.
    const Vec2 first = (piece.bulge > 0.0 ? piece.from : piece.to) - arc.centre;
    const Vec2 last = (piece.bulge > 0.0 ? piece.to : piece.from) - arc.centre;
    entity("ARC", drawn.layer, "AcDbCircle", drawn.colour, drawn.style);
    out_.point3(10, arc.centre);
    out_.group(40, arc.radius);
    out_.group(50, Angle::from_radians(math::atan2(first.y, first.x)).degrees());
    out_.group(51, Angle::from_radians(math::atan2(last.y, last.x)).degrees());
  }

  void text(const DrawnText& drawn) {
    entity("TEXT", drawn.layer, "AcDbText");
    out_.point3(10, drawn.at);
    out_.group(40, drawn.height_mm * drawing_.text_scale);
    out_.group(1, ascii_text(drawn.text));
    if (drawn.angle != Angle()) out_.group(50, drawn.angle.degrees());
    if (drawn.anchor != TextAnchor::left) {
      out_.group(72, drawn.anchor == TextAnchor::centre ? 1 : 2);
      out_.point3(11, drawn.at);
    }
    if (r2000_) out_.group(100, "AcDbText");
  }

  void entities() {
    section("ENTITIES");
    for (const DrawnPath& drawn : drawing_.paths) {
      if (r2000_) {
        polyline(drawn);
      } else {
        for (const PathPiece& one : pieces_of(drawn.path)) piece(drawn, one);
      }
    }
    for (const DrawnCircle& drawn : drawing_.circles) {
      entity("CIRCLE", drawn.layer, "AcDbCircle");
      out_.point3(10, drawn.circle.centre);
      out_.group(40, drawn.circle.radius);
    }
    for (const DrawnText& drawn : drawing_.texts) text(drawn);
    end_section();
  }

  // --- objects

  void dictionary(Handle handle, std::uint32_t owner,
                  std::initializer_list<std::pair<std::string_view, Handle>> entries) {
    out_.group(0, "DICTIONARY");
    object(handle, owner);
    out_.group(100, "AcDbDictionary");
    out_.group(281, 1);
    for (const auto& [name, target] : entries) {
      out_.group(3, name);
      out_.handle(350, target);
    }
  }

  void layout(Handle handle, std::string_view name, int tab, Handle record, int flags) {
    out_.group(0, "LAYOUT");
    object(handle, kLayoutDictionary);
    out_.group(100, "AcDbPlotSettings");
    out_.group(1, "");
    out_.group(2, "");
    out_.group(4, "");
    out_.group(6, "");
    out_.group(70, flags);
    out_.group(100, "AcDbLayout");
    out_.group(1, name);
    out_.group(70, 1);
    out_.group(71, tab);
    out_.handle(330, record);
  }

  void objects() {
    section("OBJECTS");
    dictionary(kRootDictionary, 0,
               {{"ACAD_GROUP", kGroupDictionary},
                {"ACAD_LAYOUT", kLayoutDictionary},
                {"ACAD_PLOTSTYLENAME", kPlotStyles}});
    dictionary(kGroupDictionary, kRootDictionary, {});
    dictionary(kLayoutDictionary, kRootDictionary, {{"Model", kModelLayout}, {"Layout1", kPaperLayout}});
    layout(kModelLayout, "Model", 0, kModelRecord, 1024);
    layout(kPaperLayout, "Layout1", 1, kPaperRecord, 0);
    out_.group(0, "ACDBDICTIONARYWDFLT");
    object(kPlotStyles, kRootDictionary);
    out_.group(100, "AcDbDictionary");
    out_.group(281, 1);
    out_.group(3, "Normal");
    out_.handle(350, kPlotStyle);
    out_.group(100, "AcDbDictionaryWithDefault");
    out_.handle(340, kPlotStyle);
    out_.group(0, "ACDBPLACEHOLDER");
    object(kPlotStyle, kPlotStyles);
    end_section();
  }

  const Drawing& drawing_;
  bool r2000_;
  DxfText out_;
  std::uint32_t next_ = kFirstFree;
};

}  // namespace

std::string dxf_text(const Drawing& drawing, const DxfOptions& options) {
  const Drawing flat = without_dimensions(drawing);
  require_writable(flat);
  return DxfFile(flat, options.version).whole();
}

void write_dxf(const std::filesystem::path& file, const Drawing& drawing, const DxfOptions& options) {
  const std::string text = dxf_text(drawing, options);
  write_atomically(file, text);
}

}  // namespace glissade
