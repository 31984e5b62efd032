#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/version.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/step_file.hpp"

#include "core/millimetres.hpp"
#include "io/step_names.hpp"
#include "parts/bodies/bores.hpp"
#include "parts/bodies/brep.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

// ISO 10303-21 (the text), ISO 10303-42 (geometry and topology), -43, -44 (products and assemblies), -46 (colours), as AP214
// puts them together.

namespace glissade {

using namespace io;
using namespace parts;

namespace {

/// Number of an entity: "#12".
using Id = std::uint32_t;

/// Entities on their way into one text; each is written when all that it refers to have been.
class StepText {
 public:
  explicit StepText(const std::string& name) {
    text_ =
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME(" + step_string(name) +
        ",'1980-01-01T00:00:00',(''),(''),'Glissade " + std::string(version()) +
        "','Glissade','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n";
  }

  /// Writes "#id=parts;", parts being texts, numbers and references.
  template <typename... Parts>
  Id add(const Parts&... parts) {
    const Id id = ++last_;
    put(id);
    text_ += '=';
    (put(parts), ...);
    text_ += ";\n";
    return id;
  }

  std::string take() {
    text_ += "ENDSEC;\nEND-ISO-10303-21;\n";
    return std::move(text_);
  }

  void put(std::string_view text) { text_ += text; }
  void put(const char* text) { text_ += text; }
  void put(const std::string& text) { text_ += text; }
  void put(Id id) {
    text_ += '#';
    number(id);
  }
  void put(double value) {
    const std::size_t start = text_.size();
    number(value + 0.0);
    // A real number has a decimal point, before the exponent if it has one; that is a capital E: of others, Open CASCADE
    // takes the digits and leaves the exponent.
    const std::size_t exponent = text_.find('e', start);
    if (exponent != std::string::npos) text_[exponent] = 'E';
    if (text_.find('.', start) != std::string::npos) return;
    text_.insert(exponent == std::string::npos ? text_.size() : exponent, ".");
  }
  void put(const std::vector<Id>& ids) {
    text_ += '(';
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (i > 0) text_ += ',';
      put(ids[i]);
    }
    text_ += ')';
  }
  void put(const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      text_ += i == 0 ? '(' : ',';
      put(values[i]);
    }
    text_ += ')';
  }
  void put(Vec3 triple) {
    text_ += '(';
    put(triple.x);
    text_ += ',';
    put(triple.y);
    text_ += ',';
    put(triple.z);
    text_ += ')';
  }

 private:
  template <typename Number>
  void number(Number value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text_.append(digits.data(), end);
  }

  std::string text_;
  Id last_ = 0;
};

/// To a multiple of a grid whose decimal is short: a product would bring its last digits back.
double on_grid(double value, double per_unit) {
  return std::round(value * per_unit) / per_unit + 0.0;
}

/// Lengths in millimetres.
double on_grid(double millimetres) {
  constexpr double kPerMillimetre = 1e9;
  static_assert(kPerMillimetre * kStepRounding == 1.0);
  // Beyond this, doubles are coarser than the grid.
  return std::fabs(millimetres) < 1e6 ? on_grid(millimetres, kPerMillimetre)
                                      : std::round(millimetres / kStepRounding) * kStepRounding;
}

Vec3 on_grid(Vec3 millimetres) {
  return {on_grid(millimetres.x), on_grid(millimetres.y), on_grid(millimetres.z)};
}

/// A direction in digits that move nothing: 1e-9 mm over 10 m.
Vec3 on_grid_of_directions(Vec3 along) {
  constexpr double kPerUnit = 1e13;
  return {on_grid(along.x, kPerUnit), on_grid(along.y, kPerUnit), on_grid(along.z, kPerUnit)};
}

/// Numbers that tell one entity from another of its kind.
using Key = std::array<std::uint64_t, 3>;

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t mixed = 0;
    for (const std::uint64_t part : key) {
      mixed = (mixed ^ part) * 0x9e3779b97f4a7c15U;
      mixed ^= mixed >> 29U;
    }
    return static_cast<std::size_t>(mixed);
  }
};

Key key_of(Vec3 triple) {
  return {std::bit_cast<std::uint64_t>(triple.x), std::bit_cast<std::uint64_t>(triple.y),
          std::bit_cast<std::uint64_t>(triple.z)};
}

/// What was written already, by what it says.
using Known = std::unordered_map<Key, Id, KeyHash>;

/// Points, directions and frames of one file: what comes again is written once.
class Places {
 public:
  explicit Places(StepText& text) : text_(text) {}

  Id point(Vec3 place) {
    const Vec3 rounded = on_grid(place);
    return once(points_, key_of(rounded), [&] { return text_.add("CARTESIAN_POINT('',", rounded, ")"); });
  }

  Id direction(Vec3 along) {
    const Vec3 rounded = on_grid_of_directions(along);
    return once(directions_, key_of(rounded), [&] { return text_.add("DIRECTION('',", rounded, ")"); });
  }

  Id vector(Vec3 along) {
    const Id way = direction(along);
    return once(vectors_, {way, 0, 0}, [&] { return text_.add("VECTOR('',", way, ",1.)"); });
  }

  Id placement(Vec3 origin, Vec3 axis, Vec3 reference) {
    const Id centre = point(origin);
    const Id normal = direction(axis);
    const Id across = direction(reference);
    return once(placements_, {centre, normal, across},
                [&] { return text_.add("AXIS2_PLACEMENT_3D('',", centre, ",", normal, ",", across, ")"); });
  }

 private:
  template <typename Write>
  static Id once(Known& known, const Key& key, const Write& write) {
    const auto [entry, fresh] = known.try_emplace(key, 0);
    if (fresh) entry->second = write();
    return entry->second;
  }

  StepText& text_;
  Known points_;
  Known directions_;
  Known vectors_;
  Known placements_;
};

/// A direction square to an axis that others with that axis have as well; where angles count from says nothing of a face or an
/// arc that does not close on itself.
Vec3 common_reference(Vec3 axis) {
  constexpr std::array<Vec3, 3> kAxes = {Vec3{0.0, 0.0, 1.0}, Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}};
  Vec3 least = kAxes[0];
  for (const Vec3 one : kAxes) {
    if (dot(axis, one) == 0.0) return one;
    if (std::fabs(dot(axis, one)) < std::fabs(dot(axis, least))) least = one;
  }
  const Vec3 square = cross(axis, least);
  return (1.0 / norm(square)) * square;
}

/// Beyond it [mm] the digits of an angle are too coarse to count from anywhere but the arc itself.
constexpr double kLargeRadius = 1e5;

/// The geometry of one solid.
class SolidText {
 public:
  SolidText(StepText& text, Places& places, const Brep& brep) : text_(text), places_(places), brep_(brep) {}

  Id whole(const std::string& name) {
    for (const Vec3& vertex : brep_.vertices) {
      points_.push_back(places_.point(vertex));
      vertices_.push_back(text_.add("VERTEX_POINT('',", points_.back(), ")"));
    }
    for (const BrepEdge& edge : brep_.edges) edges_.push_back(edge_curve(edge));
    std::vector<Id> faces;
    for (const BrepFace& face : brep_.faces) faces.push_back(advanced_face(face));
    const Id shell = text_.add("CLOSED_SHELL('',", faces, ")");
    return text_.add("MANIFOLD_SOLID_BREP(", step_string(name), ",", shell, ")");
  }

 private:
  Id curve(const BrepEdge& edge) {
    if (edge.kind == CurveKind::line) {
      const Vec3 along = brep_.vertices[edge.to] - brep_.vertices[edge.from];
      return text_.add("LINE('',", points_[edge.from], ",", places_.vector((1.0 / norm(along)) * along), ")");
    }
    if (edge.kind == CurveKind::cubic) {
      return text_.add("B_SPLINE_CURVE_WITH_KNOTS('',3,", poles(edge.poles),
                       ",.UNSPECIFIED.,.F.,.F.,(4,4),(0.,1.),.UNSPECIFIED.)");
    }
    if (edge.kind == CurveKind::mouth) return mouth(edge);
    const bool open_arc =
        edge.kind == CurveKind::circle && edge.from != edge.to && edge.radius < kLargeRadius;
    const Id place =
        places_.placement(edge.centre, edge.axis, open_arc ? common_reference(edge.axis) : edge.reference);
    if (edge.kind == CurveKind::circle) return text_.add("CIRCLE('',", place, ",", on_grid(edge.radius), ")");
    return text_.add("ELLIPSE('',", place, ",", edge.radius, ",", edge.second_radius, ")");
  }

  Id edge_curve(const BrepEdge& edge) {
    const Id shape = curve(edge);
    return text_.add("EDGE_CURVE('',", vertices_[edge.from], ",", vertices_[edge.to], ",", shape, ",.T.)");
  }

  Id mouth(const BrepEdge& edge) {
    const RationalCurve rational = rational_mouth(edge);
    const std::string degree = std::to_string(rational.degree);
    const std::string end = std::to_string(rational.degree + 1);
    std::vector<Id> poles;
    poles.reserve(rational.poles.size());
    for (const Vec3 pole : rational.poles) poles.push_back(places_.point(pole));
    return text_.add("(BOUNDED_CURVE()B_SPLINE_CURVE(", degree, ",", poles,
                     ",.UNSPECIFIED.,.T.,.F.)B_SPLINE_CURVE_WITH_KNOTS((", end, ",", degree, ",", end,
                     "),(0.,1.,2.),.UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM()"
                     "RATIONAL_B_SPLINE_CURVE(",
                     rational.weights, ")REPRESENTATION_ITEM(''))");
  }

  std::vector<Id> poles(const std::array<Vec3, 4>& places) {
    std::vector<Id> ids;
    for (const Vec3 place : places) ids.push_back(places_.point(place));
    return ids;
  }

  /// Where angles count from does not matter: no edge of the face closes on itself, and the face is small enough.
  [[nodiscard]] bool open_face(const BrepFace& face) const {
    if (face.kind == SurfaceKind::plane) return true;
    if (face.kind != SurfaceKind::cylinder || !(face.radius < kLargeRadius)) return false;
    for (const std::vector<BrepUse>& loop : face.loops) {
      for (const BrepUse& use : loop) {
        if (brep_.edges[use.edge].from == brep_.edges[use.edge].to) return false;
      }
    }
    return true;
  }

  Id ruled(const BrepFace& face) {
    const std::vector<Id> first = poles(face.rails[0]);
    const std::vector<Id> second = poles(face.rails[1]);
    return text_.add("B_SPLINE_SURFACE_WITH_KNOTS('',1,3,(", first, ",", second,
                     "),.UNSPECIFIED.,.F.,.F.,.F.,(2,2),(4,4),(0.,1.),(0.,1.),.UNSPECIFIED.)");
  }

  Id surface(const BrepFace& face) {
    if (face.kind == SurfaceKind::ruled) return ruled(face);
    const Id place = places_.placement(face.origin, face.axis,
                                       open_face(face) ? common_reference(face.axis) : face.reference);
    switch (face.kind) {
      case SurfaceKind::cylinder:
        return text_.add("CYLINDRICAL_SURFACE('',", place, ",", on_grid(face.radius), ")");
      case SurfaceKind::cone:
        return text_.add("CONICAL_SURFACE('',", place, ",", face.radius, ",", face.half_angle, ")");
      case SurfaceKind::ruled:
      case SurfaceKind::plane:
        break;
    }
    return text_.add("PLANE('',", place, ")");
  }

  Id advanced_face(const BrepFace& face) {
    std::vector<Id> bounds;
    for (const std::vector<BrepUse>& loop : face.loops) {
      std::vector<Id> uses;
      for (const BrepUse& use : loop) {
        uses.push_back(text_.add("ORIENTED_EDGE('',*,*,", edges_[use.edge], use.forward ? ",.T.)" : ",.F.)"));
      }
      const Id closed = text_.add("EDGE_LOOP('',", uses, ")");
      bounds.push_back(
          text_.add(bounds.empty() ? "FACE_OUTER_BOUND(''," : "FACE_BOUND('',", closed, ",.T.)"));
    }
    const Id on = surface(face);
    return text_.add("ADVANCED_FACE('',", bounds, ",", on, face.outward ? ",.T.)" : ",.F.)");
  }

  StepText& text_;
  Places& places_;
  const Brep& brep_;
  std::vector<Id> points_;
  std::vector<Id> vertices_;
  std::vector<Id> edges_;
};

/// A product with the representation of its shape.
struct Product {
  Id definition = 0;
  Id representation = 0;
};

/// One file: contexts, products, colours, places.
class StepFile {
 public:
  explicit StepFile(const std::string& name) : text_(name) {
    application_ = text_.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
    text_.add("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,",
              application_, ")");
    product_context_ = text_.add("PRODUCT_CONTEXT('',", application_, ",'mechanical')");
    definition_context_ =
        text_.add("PRODUCT_DEFINITION_CONTEXT('part definition',", application_, ",'design')");
    const Id length = text_.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    const Id angle = text_.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    const Id solid = text_.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    const Id accuracy = text_.add("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-06),", length,
                                  ",'distance_accuracy_value','')");
    space_ = text_.add("(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((", accuracy,
                       "))GLOBAL_UNIT_ASSIGNED_CONTEXT((", length, ",", angle, ",", solid,
                       "))REPRESENTATION_CONTEXT('',''))");
    origin_ = frame({});
  }

  Product add_part(const ShopPart& part) {
    const Brep brep = brep_of(part);
    const std::string name = step_name(part);
    const Id solid = SolidText(text_, places_, brep).whole(name);
    styled_.push_back(text_.add("STYLED_ITEM('',(", style(part.colour), "),", solid, ")"));
    const Id shape =
        text_.add("ADVANCED_BREP_SHAPE_REPRESENTATION('',(", origin_, ",", solid, "),", space_, ")");
    return product(name, shape);
  }

  void add_assembly(const Workshop& workshop, const std::vector<Product>& parts) {
    std::vector<Id> places;
    std::vector<std::size_t> owners;
    std::vector<Id> items{origin_};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (const Frame& place : workshop.parts[i].places) {
        places.push_back(frame(place));
        items.push_back(places.back());
        owners.push_back(i);
      }
    }
    const Id shape = text_.add("SHAPE_REPRESENTATION('',", items, ",", space_, ")");
    const Product whole = product(workshop.name, shape);
    for (std::size_t k = 0; k < places.size(); ++k) {
      occurrence(whole, parts[owners[k]], places[k], step_name(workshop.parts[owners[k]]), k + 1);
    }
  }

  std::string take() {
    text_.add("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',", styled_, ",", space_, ")");
    return text_.take();
  }

 private:
  Id frame(const Frame& place) {
    return places_.placement(core::kMillimetres * place.origin, place.z, place.x);
  }

  Product product(const std::string& name, Id shape) {
    const std::string quoted = step_string(name);
    const Id made = text_.add("PRODUCT(", quoted, ",", quoted, ",'',(", product_context_, "))");
    text_.add("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(", made, "))");
    const Id formation = text_.add("PRODUCT_DEFINITION_FORMATION('','',", made, ")");
    const Id definition =
        text_.add("PRODUCT_DEFINITION('design','',", formation, ",", definition_context_, ")");
    const Id definition_shape = text_.add("PRODUCT_DEFINITION_SHAPE('','',", definition, ")");
    text_.add("SHAPE_DEFINITION_REPRESENTATION(", definition_shape, ",", shape, ")");
    return {definition, shape};
  }

  void occurrence(const Product& whole, const Product& part, Id place, const std::string& name,
                  std::size_t count) {
    const Id usage = text_.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE('", std::to_string(count), "',",
                               step_string(name), ",'',", whole.definition, ",", part.definition, ",$)");
    const Id shape = text_.add("PRODUCT_DEFINITION_SHAPE('','',", usage, ")");
    const Id move = text_.add("ITEM_DEFINED_TRANSFORMATION('','',", origin_, ",", place, ")");
    const Id relation = text_.add("(REPRESENTATION_RELATIONSHIP('','',", part.representation, ",",
                                  whole.representation, ")REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(",
                                  move, ")SHAPE_REPRESENTATION_RELATIONSHIP())");
    text_.add("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(", relation, ",", shape, ")");
  }

  Id style(const std::array<double, 3>& colour) {
    const std::string key = exact_text(colour[0]) + "," + exact_text(colour[1]) + "," + exact_text(colour[2]);
    const auto [entry, fresh] = styles_.try_emplace(key, 0);
    if (!fresh) return entry->second;
    const Id rgb = text_.add("COLOUR_RGB('',", colour[0], ",", colour[1], ",", colour[2], ")");
    const Id fill_colour = text_.add("FILL_AREA_STYLE_COLOUR('',", rgb, ")");
    const Id fill = text_.add("FILL_AREA_STYLE('',(", fill_colour, "))");
    const Id area = text_.add("SURFACE_STYLE_FILL_AREA(", fill, ")");
    const Id side = text_.add("SURFACE_SIDE_STYLE('',(", area, "))");
    const Id usage = text_.add("SURFACE_STYLE_USAGE(.BOTH.,", side, ")");
    entry->second = text_.add("PRESENTATION_STYLE_ASSIGNMENT((", usage, "))");
    return entry->second;
  }

  StepText text_;
  Places places_{text_};
  Id application_ = 0;
  Id product_context_ = 0;
  Id definition_context_ = 0;
  Id space_ = 0;
  Id origin_ = 0;
  std::vector<Id> styled_;
  std::unordered_map<std::string, Id> styles_;
};

}  // namespace

std::string step_text(const ShopPart& part) {
  StepFile file(step_name(part));
  (void)file.add_part(part);
  return file.take();
}

std::string step_text(const Workshop& workshop) {
  if (workshop.parts.empty()) {
    throw InputError({"assembly " + workshop.name, "has no part", "A STEP file holds one or more.", ""});
  }
  StepFile file(workshop.name);
  std::vector<Product> parts;
  parts.reserve(workshop.parts.size());
  for (const ShopPart& part : workshop.parts) parts.push_back(file.add_part(part));
  file.add_assembly(workshop, parts);
  return file.take();
}

void write_step(const std::filesystem::path& file, const ShopPart& part) {
  write_atomically(file, step_text(part));
}

void write_step(const std::filesystem::path& file, const Workshop& workshop) {
  write_atomically(file, step_text(workshop));
}

}  // namespace glissade
