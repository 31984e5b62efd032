#include "drawing/balloons.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <vector>

using namespace glissade;
using namespace glissade::drawing;

TEST_CASE(
    "lines from names to what they name do not cross nor run through names, each name has a place of its "
    "own") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0.0, 100.0);
  for (int draw = 0; draw < 40; ++draw) {
    const std::size_t count = 2 + random() % 34;
    std::vector<Named> names;
    for (std::size_t i = 0; i < count; ++i) {
      Named named;
      const std::size_t pieces = 1 + random() % 4;
      for (std::size_t k = 0; k < pieces; ++k) named.pieces.push_back({anywhere(random), anywhere(random)});
      names.push_back(std::move(named));
    }
    std::vector<Vec2> slots;
    for (int i = 0; i < 12; ++i) slots.push_back({9.0 * i, 112.0});
    for (int i = 0; i < 12; ++i) slots.push_back({-12.0, 9.0 * i});
    for (int i = 0; i < 12; ++i) slots.push_back({120.0, 9.0 * i});
    const std::vector<Label> labels = labelled(names, slots, 4.0);
    REQUIRE(labels.size() == count);
    std::set<std::size_t> taken;
    for (std::size_t i = 0; i < count; ++i) {
      taken.insert(labels[i].slot);
      for (const Vec2 piece : names[i].pieces) {
        CHECK(norm(labels[i].target - slots[labels[i].slot]) <= norm(piece - slots[labels[i].slot]));
      }
      for (std::size_t k = 0; k < count; ++k) {
        if (k == i) continue;
        const Vec2 other = slots[labels[k].slot];
        CHECK_FALSE(lines_cross(slots[labels[i].slot], labels[i].target, other, labels[k].target));
        CHECK_FALSE(line_passes(slots[labels[i].slot], labels[i].target, other, 4.0));
      }
    }
    CHECK(taken.size() == count);
  }
}

TEST_CASE("lines from names keep off other words where there is room for it") {
  // Straight across the word lies the shorter way.
  const std::vector<Named> names = {{{{0.0, 0.0}}}};
  const std::vector<Vec2> slots = {{50.0, 0.0}, {50.0, 20.0}, {50.0, 40.0}};
  CHECK(labelled(names, slots, 4.0)[0].slot == 0);
  CHECK(labelled(names, slots, 4.0, {{25.0, 0.0}})[0].slot == 1);
  // With no other way it is crossed.
  CHECK(labelled(names, {slots[0]}, 4.0, {{25.0, 0.0}})[0].slot == 0);
}

TEST_CASE("whether lines cross, and pass a point") {
  CHECK(lines_cross({0.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}, {2.0, 0.0}));
  CHECK_FALSE(lines_cross({0.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}, {0.9, 1.1}));
  CHECK(line_passes({0.0, 0.0}, {10.0, 0.0}, {5.0, 0.9}, 1.0));
  CHECK_FALSE(line_passes({0.0, 0.0}, {10.0, 0.0}, {11.5, 0.0}, 1.0));
  CHECK(line_passes({1.0, 1.0}, {1.0, 1.0}, {1.5, 1.0}, 1.0));
}
