#include "app/track_input.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/words.hpp"

#include "app/option_value.hpp"

#include <cstddef>
#include <utility>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

CenterlineKind kind_named(const std::string& word_given) {
  if (const auto kind = centerline_kind(word_given)) return *kind;
  std::vector<std::string> words;
  for (const CenterlineKind kind : centerline_kinds()) words.emplace_back(word(kind));
  throw InputError({"--centerline", "'" + word_given + "' is no kind of centerline", "", listed(words)});
}

void require_drawable(CenterlineKind kind) {
  if (!is_drawn(kind)) return;
  throw InputError({"--centerline", "a track of " + std::string(word(kind)) + " needs a design file",
                    "Its shape does not fit on a command line.", "glissade init " + std::string(word(kind))});
}

}  // namespace

void Overrides::add_to(CLI::App& command) {
  command
      .add_option("--set", texts_,
                  "Replace a value of the design file, e.g. body.friction_angle=19deg; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
}

std::vector<Override> Overrides::values() const {
  std::vector<Override> values;
  for (const std::string& text : texts_) {
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos || sign == 0) {
      throw InputError({"--set", "'" + text + "' is not of the form KEY=VALUE",
                        "A key is the path to a value in the design file, its names joined by dots.",
                        "--set body.friction_angle=19deg"});
    }
    values.push_back({text.substr(0, sign), text.substr(sign + 1)});
  }
  return values;
}

void DesignInput::add_to(CLI::App& command, const char* what) {
  command.add_option("design", file_, what)->type_name("DESIGN.yaml")->required();
  overrides_.add_to(command);
}

Design DesignInput::read() const {
  return read_design(file_, overrides_.values());
}

void TrackInput::add_to(CLI::App& command) {
  command.add_option("design", file_, "Design file; without one, the options below say what is needed")
      ->type_name("DESIGN.yaml");
  overrides_.add_to(command);
  const auto add = [&](const std::string& name, std::string& text, const std::string& unit,
                       const std::string& description) {
    command.add_option(name, text, description)
        ->type_name(unit)
        ->group("Instead of a design file (plain numbers in SI units, or with a unit: 400mm)");
  };
  add("--run", run_, "LENGTH", "Horizontal distance from start to finish; negative for a finish on the left");
  add("--drop", drop_, "LENGTH", "Height of the start above the finish");
  add("--friction-angle", friction_angle_, "ANGLE", "Friction angle of body on track, with its unit: 11deg");
  add("--friction-coefficient", friction_coefficient_, "NUMBER", "The same as its tangent; 0 for none");
  add("--entry-speed", entry_speed_, "SPEED", "Speed at the start [default: 0, from rest]");
  add("--drag", drag_, "1/LENGTH", "Air density x drag coefficient x frontal area / (2 x mass) [default: 0]");
  add("--gravity", gravity_, "ACCELERATION", "[default: 9.81]");
  if (scope_ == Scope::one_kind) {
    add("--centerline", centerline_, "KIND",
        "fastest, constant-speed, straight, cycloid or no-curvature-load [default: fastest]");
  }
  add("--p", p_, "P", "Of constant-speed: the square of the speed it keeps [default: the P that is fastest]");
}

std::vector<std::string> TrackInput::options_given() const {
  const std::vector<std::pair<std::string, const std::string*>> options = {
      {"--run", &run_},
      {"--drop", &drop_},
      {"--friction-angle", &friction_angle_},
      {"--friction-coefficient", &friction_coefficient_},
      {"--entry-speed", &entry_speed_},
      {"--drag", &drag_},
      {"--gravity", &gravity_},
      {"--centerline", &centerline_},
      {"--p", &p_}};
  std::vector<std::string> given;
  for (const auto& [name, text] : options) {
    if (!text->empty()) given.push_back(name);
  }
  return given;
}

Design TrackInput::design(const std::optional<Friction>& default_friction) const {
  const std::vector<std::string> given = options_given();
  if (file_.empty()) {
    if (given.empty() && overrides_.empty()) {
      throw InputError({"", "there is nothing to work on: neither a design file nor options are given", "",
                        "glissade solve --run 10 --drop 5 --friction-angle 11deg"});
    }
    if (!overrides_.empty()) {
      throw InputError({"--set", "there is no design file whose values it could replace", "", ""});
    }
    return from_options(default_friction);
  }
  if (!given.empty()) {
    throw InputError({given.front(), "it cannot be combined with a design file (" + file_ + ")",
                      "The file says it already.",
                      "--set, which replaces a value of the file: --set body.friction_angle=19deg"});
  }
  return read_design(file_, overrides_.values());
}

Friction TrackInput::friction(const std::optional<Friction>& default_friction) const {
  if (default_friction && friction_angle_.empty() && friction_coefficient_.empty()) return *default_friction;
  if (friction_angle_.empty() == friction_coefficient_.empty()) {
    throw InputError({"", "exactly one of --friction-angle and --friction-coefficient is needed",
                      "Friction decides which track is the fastest.",
                      "--friction-angle 11deg, or --friction-coefficient 0 for none"});
  }
  if (!friction_angle_.empty()) {
    return at_option("--friction-angle", [&] {
      return Friction::from_angle(
          Angle::from_radians(option_value(friction_angle_, Dimension::angle, "--friction-angle")));
    });
  }
  return at_option("--friction-coefficient", [&] {
    return Friction::from_coefficient(
        option_value(friction_coefficient_, Dimension::number, "--friction-coefficient"));
  });
}

Design TrackInput::from_options(const std::optional<Friction>& default_friction) const {
  if (run_.empty() || drop_.empty()) {
    throw InputError({"", std::string(run_.empty() ? "--run" : "--drop") + " is missing",
                      "Without a design file, --run and --drop say where the finish lies.",
                      "glissade solve --run 10 --drop 5 --friction-angle 11deg"});
  }
  Design design;
  const double run = option_value(run_, Dimension::length, "--run");
  const double drop = option_value(drop_, Dimension::length, "--drop");
  if (!(drop > 0.0) && entry_speed_.empty()) {
    throw InputError({"--drop", drop_ + " is not positive",
                      "It is how far the start lies above the finish; nothing but gravity drives the body.",
                      "a --drop above 0, or an --entry-speed with which the body climbs"});
  }
  design.track.start = {0.0, 0.0, drop};
  design.track.finish = {run, 0.0, 0.0};
  design.body.friction = friction(default_friction);
  if (!entry_speed_.empty()) {
    design.body.entry_speed = option_value(entry_speed_, Dimension::speed, "--entry-speed");
  }
  if (!drag_.empty()) design.body.drag_per_metre = option_value(drag_, Dimension::per_length, "--drag");
  if (!gravity_.empty()) design.gravity = option_value(gravity_, Dimension::acceleration, "--gravity");
  if (!centerline_.empty()) design.centerline.kind = kind_named(centerline_);
  require_drawable(design.centerline.kind);
  if (!p_.empty()) {
    design.centerline.constant_speed_p = option_value(p_, Dimension::specific_energy, "--p");
    if (centerline_.empty()) design.centerline.kind = CenterlineKind::constant_speed;
    if (design.centerline.kind != CenterlineKind::constant_speed) {
      throw InputError(
          {"--p", "only the centerline constant-speed has a P", "", "--centerline constant-speed"});
    }
  }
  design.locations = {{"track", "--run, --drop"},
                      {"track.start", "--drop"},
                      {"track.finish", "--run, --drop"},
                      {"track.finish.z", "--drop"},
                      {"body.entry_speed", "--entry-speed"},
                      {"body.drag", "--drag"},
                      {"gravity", "--gravity"},
                      {"centerline", "--centerline"},
                      {"centerline.p", "--p"}};
  if (friction_angle_.empty()) {
    design.locations["body.friction_coefficient"] = "--friction-coefficient";
  } else {
    design.locations["body.friction_angle"] = "--friction-angle";
  }
  return design;
}

}  // namespace glissade::app
