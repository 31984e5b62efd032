#include "glissade/section/measures.hpp"

namespace glissade::section {
namespace {

struct FindWidth : PassingVisitor {
  std::optional<WidthLaw> found;
  void width(const char*, const WidthLaw& law, const char*) { found = law; }
};

struct SetWidth : PassingVisitor {
  double wanted = 0.0;
  void width(const char*, WidthLaw& law, const char*) const { law = wanted; }
};

}  // namespace

std::optional<WidthLaw> width_law(const Measures& measures) {
  FindWidth visitor;
  visit_measures(measures, visitor);
  return visitor.found;
}

Measures with_width(Measures measures, double width) {
  SetWidth visitor;
  visitor.wanted = width;
  visit_measures(measures, visitor);
  return measures;
}

}  // namespace glissade::section
