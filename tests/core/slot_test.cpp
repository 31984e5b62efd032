#include "glissade/core/slot.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <numbers>

namespace {

using namespace glissade;

Slot random_slot(testing::Random& random) {
  const double turned = random.between(0.0, 6.28);
  const double reach = random.between(0.5e-3, 40e-3);
  return {{random.between(-2.0, 2.0), random.between(-2.0, 2.0)},
          {reach * std::cos(turned), reach * std::sin(turned)},
          random.between(1e-3, 15e-3)};
}

}  // namespace

TEST_CASE("slots: the outline of a slot has its area and bounds, and tells the slot whichever way it runs") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 200; ++run) {
    const Slot slot = random_slot(random);
    const ArcPath path = path_of(slot);
    const double area = std::numbers::pi * slot.radius * slot.radius + 4.0 * slot.radius * norm(slot.reach);
    CHECK(std::fabs(signed_area(path) / area - 1.0) < 1e-9);
    const PlaneBox box = bounds(path);
    CHECK(std::fabs(box.width() - 2.0 * (std::fabs(slot.reach.x) + slot.radius)) < 1e-12);
    CHECK(std::fabs(box.height() - 2.0 * (std::fabs(slot.reach.y) + slot.radius)) < 1e-12);
    ArcPath turned = path;
    turned.vertices.insert(turned.vertices.begin(), turned.vertices.back());
    turned.vertices.pop_back();
    for (const ArcPath& one : {path, reversed(path), turned}) {
      const auto found = as_slot(one);
      REQUIRE(found);
      CHECK(norm(found->middle - slot.middle) < 1e-14 + 1e-15 * norm(slot.middle));
      CHECK(std::fabs(found->radius - slot.radius) < 1e-14);
      CHECK(std::fabs(std::fabs(dot(found->reach, slot.reach)) - dot(slot.reach, slot.reach)) < 1e-14);
      CHECK(std::fabs(overall_length(*found) - 2.0 * (norm(slot.reach) + slot.radius)) < 1e-13);
    }
  }
}

TEST_CASE("slots: figures with two arcs that no bolt could slide along are none") {
  const ArcPath slot = path_of(Slot{{0.1, 0.2}, {0.0, 0.01}, 6e-3});
  CHECK(as_slot(slot));
  ArcPath open = slot;
  open.closed = false;
  CHECK_FALSE(as_slot(open));
  CHECK_FALSE(as_slot(path_of(Circle{{0.0, 0.0}, 0.1})));
  for (std::size_t i = 0; i < slot.vertices.size(); ++i) {
    ArcPath bent = slot;
    bent.vertices[i].bulge += 1e-3;
    CHECK_FALSE(as_slot(bent));
    ArcPath moved = slot;
    moved.vertices[i].at = moved.vertices[i].at + Vec2{1e-4, 0.0};
    CHECK_FALSE(as_slot(moved));
    ArcPath inward = slot;
    inward.vertices[i].bulge = -inward.vertices[i].bulge;
    CHECK(as_slot(inward).has_value() == (slot.vertices[i].bulge == 0.0));
  }
  // Leans: half circles side by side, not end to end.
  ArcPath leaning = slot;
  leaning.vertices[1].at = leaning.vertices[1].at + Vec2{2e-3, 0.0};
  leaning.vertices[2].at = leaning.vertices[2].at + Vec2{2e-3, 0.0};
  CHECK_FALSE(as_slot(leaning));
}
