#pragma once

#include "glissade/core/slot.hpp"
#include "glissade/parts/shop_part.hpp"

#include "support/workshop_shapes.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace testing {

inline glissade::ShopPart shop_part(int number, const std::string& name, glissade::PartBody body) {
  glissade::ShopPart part;
  part.number = number;
  part.name = name;
  part.material = "S235";
  part.thickness = 0.004;
  part.density = 7850.0;
  part.body = std::move(body);
  part.places = {glissade::Frame{}};
  part.colour = {0.1 * (number % 10), 0.5, 0.7};
  return part;
}

/// Metres.
inline glissade::PlaneRegion metre_band(int arcs, int holes) {
  return glissade::scaled(band(arcs, 3000.0, 250.0, holes), 1e-3);
}

/// A plate that leans: a thin section along bends to the left and right, and a straight.
inline glissade::SweptBody leaning_plate(double lean, double height, double thickness) {
  glissade::ArcPath path = glissade::scaled(bending_line(5, 3000.0), 1e-3);
  // Goes on straight, then to the right, tangent to what came before.
  const glissade::PathPiece last{path.vertices[4].at, path.vertices[5].at, path.vertices[4].bulge};
  const glissade::Vec2 chord = last.to - last.from;
  const double heading = std::atan2(chord.y, chord.x) + 2.0 * std::atan(last.bulge);
  const glissade::Vec2 on{std::cos(heading), std::sin(heading)};
  const glissade::Vec2 straight_end = last.to + 0.4 * on;
  path.vertices.push_back({straight_end, glissade::bulge_of_sweep(-0.3)});
  path.vertices.push_back(
      {straight_end + 0.5 * glissade::Vec2{std::cos(heading - 0.15), std::sin(heading - 0.15)}, 0.0});
  const glissade::Vec2 up{height * std::cos(lean), height * std::sin(lean)};
  const glissade::Vec2 out{-thickness * std::sin(lean), thickness * std::cos(lean)};
  return {path, {{0.0, 0.0}, up, up + out, out}};
}

/// A floor along bends to either side, with a tab, a step and slots on its arcs and its straight piece.
inline glissade::RolledSheet slotted_floor() {
  glissade::RolledSheet sheet;
  sheet.path = leaning_plate(0.0, 0.2, 0.004).path;
  sheet.thickness = 0.004;
  std::vector<double> joints = {0.0};
  for (const glissade::PathPiece& piece : glissade::pieces_of(sheet.path))
    joints.push_back(joints.back() + glissade::length(piece));
  const double whole = joints.back();
  sheet.region.outline.closed = true;
  const double tab = joints[1] + 0.2;
  for (const glissade::Vec2 corner : {glissade::Vec2{0.0, 0.02},
                                      {tab, 0.02},
                                      {tab, 0.0},
                                      {tab + 0.04, 0.0},
                                      {tab + 0.04, 0.02},
                                      {whole, 0.02},
                                      {whole, 0.4},
                                      {0.015, 0.4},
                                      {0.015, 0.38},
                                      {0.0, 0.38}})
    sheet.region.outline.vertices.push_back({corner, 0.0});
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const double middle = 0.5 * (joints[i] + joints[i + 1]);
    sheet.region.cutouts.push_back(glissade::rectangle({middle - 0.02, 0.05}, {middle + 0.02, 0.0542}));
  }
  return sheet;
}

/// A leaning plate whose section moves across along its arcs, evenly on each.
inline glissade::SweptBody widening_plate() {
  glissade::SweptBody body = leaning_plate(0.2, 0.25, 0.004);
  for (std::size_t i = 0; i < body.path.vertices.size(); ++i) {
    const double out = i < 2 ? 0.0 : 0.02 * static_cast<double>(i - 1);
    body.shifts.emplace_back(body.section.size(), out);
  }
  return body;
}

/// Middles of the pieces of a path, along it.
inline std::vector<double> middles_of(const glissade::ArcPath& path) {
  std::vector<double> middles;
  double start = 0.0;
  for (const glissade::PathPiece& piece : glissade::pieces_of(path)) {
    const double whole = glissade::length(piece);
    middles.push_back(start + 0.5 * whole);
    start += whole;
  }
  return middles;
}

/// The slotted floor with two holes in each of its pieces.
inline glissade::RolledSheet drilled_floor() {
  glissade::RolledSheet sheet = slotted_floor();
  for (const double middle : middles_of(sheet.path)) {
    sheet.region.holes.push_back({{middle + 0.06, 0.2}, 6e-3});
    sheet.region.holes.push_back({{middle + 0.07, 0.3}, 4.5e-3});
  }
  return sheet;
}

inline glissade::SweptBody drilled_leaning_plate() {
  glissade::SweptBody body = leaning_plate(0.6, 0.25, 0.004);
  for (const double middle : middles_of(body.path)) body.holes.push_back({{middle, 0.12}, 6e-3});
  return body;
}

/// A plate that leans, above and beside its path, with bevelled edges, a lap along a part of one of them, slots and holes.
inline glissade::RolledSheet leaning_sheet(double lean = 0.5) {
  glissade::RolledSheet sheet = slotted_floor();
  const double whole = glissade::length(sheet.path);
  sheet.foot = {0.22, -0.1};
  sheet.across = {-std::cos(lean), std::sin(lean)};
  sheet.bevels = {{0.0, 0.002}, {0.2, -0.003}, {0.23, 0.0}};
  sheet.region = {};
  sheet.region.outline.closed = true;
  for (const glissade::Vec2 corner : {glissade::Vec2{0.0, 0.0},
                                      {whole, 0.0},
                                      {whole, 0.2},
                                      {whole - 0.03, 0.2},
                                      {whole - 0.03, 0.23},
                                      {0.012, 0.23},
                                      {0.012, 0.2},
                                      {0.0, 0.2}})
    sheet.region.outline.vertices.push_back({corner, 0.0});
  for (const double middle : middles_of(sheet.path)) {
    sheet.region.cutouts.push_back(glissade::rectangle({middle - 0.02, 0.16}, {middle + 0.02, 0.17}));
    sheet.region.holes.push_back({{middle, 0.1}, 5e-3});
  }
  return sheet;
}

/// An angle between two mitres, with holes and slots.
inline glissade::AngleBar mitred_angle() {
  const auto line = [](double from, double to, double y) {
    return glissade::ArcPath{{{{from, y}, 0.0}, {{to, y}, 0.0}}, false};
  };
  glissade::AngleBar bar{line(0.0, 0.5, 0.0), line(-0.003, 0.506, 0.006), line(-0.03, 0.56, 0.06), 0.006,
                         0.06};
  bar.holes = {{{0.1, 0.037}, 5.5e-3}, {{0.4, 0.037}, 5.5e-3}};
  bar.slots = {path_of(glissade::Slot{{0.25, 0.037}, {5e-3, 4e-3}, 6e-3})};
  return bar;
}

/// Angles rolled to a whole ring and to half a one with straight ends, their drilled legs outwards.
inline glissade::AngleBar angle_ring() {
  const auto line = [](double radius) { return reversed(path_of(glissade::Circle{{}, radius})); };
  glissade::AngleBar bar{line(0.2), line(0.205), line(0.25), 0.005, 0.05};
  for (int k = 0; k < 6; ++k)
    bar.holes.push_back({{0.23 * std::cos(k + 0.5), 0.23 * std::sin(k + 0.5)}, 5.5e-3});
  return bar;
}

inline glissade::AngleBar half_angle_ring() {
  const auto line = [](double radius) {
    return glissade::ArcPath{
        {{{radius, 0.04}, 0.0}, {{radius, 0.0}, -1.0}, {{-radius, 0.0}, 0.0}, {{-radius, 0.04}, 0.0}}, false};
  };
  glissade::AngleBar bar{line(0.2), line(0.205), line(0.25), 0.005, 0.05};
  bar.holes = {{{0.0, -0.23}, 6e-3}};
  bar.slots = {path_of(glissade::Slot{{0.23, 0.01}, {0.0, 6e-3}, 6e-3})};
  return bar;
}

/// A tube between two planes that lean, with a window and four holes beside it.
inline glissade::TubeGore opened_tube() {
  const auto degrees = [](double angle) { return glissade::Angle::from_degrees(angle); };
  glissade::TubeGore tube{0.1, 0.003, 0.5, degrees(-6.0), degrees(7.0)};
  tube.windows = {{0.15, 0.3, degrees(-115.0), degrees(-65.0)}};
  for (const double along : {0.13, 0.32}) {
    for (const double angle : {-125.0, -55.0}) tube.holes.push_back({along, degrees(angle), 4.5e-3});
  }
  return tube;
}

/// Plates, a floor, a leaning wall, gores of a pipe: one of each kind, some in several places.
inline glissade::Workshop sample_workshop() {
  glissade::Workshop workshop;
  workshop.name = "Chute with 'quotes', Länge";
  glissade::PlaneRegion wall = metre_band(7, 9);
  const glissade::Vec2 at = wall.holes[4].centre + glissade::Vec2{0.05, 0.0};
  wall.cutouts.push_back({{{at, 0.0},
                           {at + glissade::Vec2{0.03, 0.0}, 1.0},
                           {at + glissade::Vec2{0.03, 0.012}, 0.0},
                           {at + glissade::Vec2{0.0, 0.012}, 1.0}},
                          true});
  workshop.parts.push_back(shop_part(1, "left_wall", glissade::Prism{wall, 0.004}));
  workshop.parts.back().places.push_back({{0.0, 0.0, 0.5}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  glissade::FlatPattern pattern{wall, {}, {}, {}, wall.outline.vertices[3].at + glissade::Vec2{0.02, 0.03},
                                0.02};
  pattern.bends.push_back(
      {wall.outline.vertices[2].at, wall.holes[1].centre, glissade::Angle::from_radians(0.1), 0.004, true});
  pattern.bends.push_back(
      {wall.outline.vertices[4].at, wall.holes[3].centre, glissade::Angle::from_radians(0.1), 0.004, false});
  pattern.rolls.push_back({wall.outline.vertices[5].at, wall.holes[4].centre, 2.5});
  workshop.parts.back().pattern = pattern;
  workshop.parts.back().mass = 20.4;
  workshop.parts.back().centre_of_gravity = {1.0, -1.0, 0.0};
  workshop.parts.push_back(shop_part(2, "floor", glissade::Prism{metre_band(6, 0), 0.5}));
  workshop.parts.push_back(shop_part(3, "leaning_wall", leaning_plate(0.6, 0.25, 0.004)));
  workshop.parts.push_back(shop_part(4, "gore",
                                     glissade::TubeGore{0.1, 0.003, 0.3, glissade::Angle::from_radians(-0.1),
                                                        glissade::Angle::from_radians(0.12)}));
  workshop.parts.back().places = {{{1.0, 0.0, 0.0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, {{2.0, 0.0, 0.0}}};
  workshop.parts.push_back(shop_part(5, "pipe", glissade::TubeGore{0.05, 0.002, 1.0, {}, {}}));
  // Coordinates of some nanometres, which take an exponent.
  const glissade::PathVertex tiny{{0.4, 7.5254e-9}, 0.2};
  glissade::ArcPath plate{{{{0.0, 0.3}}, {{0.0, 0.0}}, tiny, {{0.5, 3e-7}}, {{0.5, 0.3}}}, true};
  workshop.parts.push_back(shop_part(6, "plate", glissade::Prism{{plate, {}, {}}, 0.4}));
  workshop.parts.push_back(shop_part(7, "slotted_floor", slotted_floor()));
  workshop.parts.push_back(
      shop_part(8, "trough",
                glissade::TroughGore{0.1, 0.003, 0.05, 0.3, glissade::Angle::from_radians(-0.1),
                                     glissade::Angle::from_radians(0.12)}));
  workshop.parts.push_back(shop_part(9, "half_round", glissade::TroughGore{0.1, 0.003, 0.0, 0.3, {}, {}}));
  workshop.parts.push_back(shop_part(10, "widening_wall", widening_plate()));
  workshop.parts.push_back(shop_part(11, "drilled_floor", drilled_floor()));
  workshop.parts.push_back(shop_part(12, "drilled_wall", drilled_leaning_plate()));
  workshop.parts.push_back(shop_part(13, "slotted_wall", leaning_sheet()));
  workshop.parts.push_back(shop_part(14, "mitred_angle", mitred_angle()));
  workshop.parts.push_back(shop_part(15, "ring_of_angle", angle_ring()));
  workshop.parts.push_back(shop_part(16, "half_ring_of_angle", half_angle_ring()));
  workshop.parts.push_back(shop_part(17, "opened_tube", opened_tube()));
  workshop.items.push_back({"bolt M12 x 40", "ISO 4017 8.8", 24, "joint 1"});
  workshop.bends.push_back(
      {2, 1, 0.25, 0.0, glissade::Angle::from_radians(0.03), glissade::Angle::from_radians(0.03), 2.5, 2e-4});
  workshop.setting_out.push_back(
      {"start", 0.0, 0.0, 0.0, {0.0, 0.0, 0.0}, glissade::Angle::from_radians(1.2), 2.5, 0.0, {-0.1}});
  workshop.setting_out.push_back(
      {"joint 1", 2.0, 1.4, -1.1, {1.4, 0.0, -1.1}, glissade::Angle::from_radians(0.6), 2.5, 0.1, {-0.1}});
  workshop.setting_out.push_back(
      {"end", 3.0, 2.4, -1.3, {2.4, 0.0, -1.3}, glissade::Angle::from_radians(0.1), 2.5, 0.0, {-0.1}});
  workshop.offset_names = {"underside"};
  workshop.checks.push_back({"smallest hole", glissade::ShopVerdict::pass, "14 mm", "at least 4 mm", "part 1",
                             "a source", "Holes are wide enough.", "secondary", true});
  workshop.notes = {"Floor: rolled; K = 0.5"};
  return workshop;
}

/// The sample as it stands on site: parts drawn in the plane of the track, upright.
inline glissade::Workshop upright_workshop() {
  glissade::Workshop workshop = sample_workshop();
  for (glissade::ShopPart& part : workshop.parts) {
    for (glissade::Frame& place : part.places) {
      for (glissade::Vec3* axis : {&place.origin, &place.x, &place.y, &place.z})
        *axis = {axis->x, -axis->z, axis->y};
    }
  }
  return workshop;
}

}  // namespace testing
