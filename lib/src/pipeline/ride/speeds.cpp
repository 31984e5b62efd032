#include "glissade/pipeline/speeds.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/io/csv_columns.hpp"

#include "pipeline/ride/gates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace glissade {
namespace {

constexpr const char* kDesignHint =
    "a design file in the column design, or one for all rows beside the file of speeds";
constexpr const char* kExample = "design,length_m,speed_km_h; or gate in the place of length_m";

/// A hill whose track is made once.
struct Hill {
  Design design;
  CenterlinePtr track;
  std::optional<GateTable> gates;
};

class Reader {
 public:
  Reader(const std::filesystem::path& file, const std::optional<std::filesystem::path>& design)
      : columns_(CsvColumns::read(file, "the speeds")), folder_(file.parent_path()), design_(design) {
    by_gate_ = columns_.has("gate");
    in_kilometres_ = columns_.has("speed_km_h");
    std::vector<CsvColumns::Required> required;
    if (!design) required.push_back({"design", kDesignHint});
    if (!by_gate_) required.push_back({"length_m", kExample});
    if (!in_kilometres_) required.push_back({"speed_m_per_s", kExample});
    columns_.require(required);
    columns_.require_spelt({"design", "before_edge_m", "count", by_gate_ ? "gate" : "length_m",
                            in_kilometres_ ? "speed_km_h" : "speed_m_per_s"});
    require_either("gate", "length_m");
    require_either("speed_km_h", "speed_m_per_s");
  }

  std::vector<SpeedReading> read() {
    std::vector<SpeedReading> readings;
    for (std::size_t row = 0; row < columns_.rows(); ++row) readings.push_back(reading_of(row, hill_of(row)));
    if (readings.empty()) {
      throw FileError({columns_.file().string(), "there are no speeds in the file",
                       "The first line names the columns, each other one is a speed.", "a line a speed"});
    }
    return readings;
  }

 private:
  /// Two columns that say the same could say it differently.
  void require_either(const char* one, const char* other) const {
    if (!columns_.has(one) || !columns_.has(other)) return;
    throw FileError({columns_.file().string(), "it has the columns " + std::string(one) + " and " + other,
                     "They say the same of a speed, and may differ.", "one of the two"});
  }

  [[nodiscard]] double count_of(std::size_t row) const {
    if (!columns_.has("count")) return SpeedReading{}.count;
    const double count = columns_.number(row, "count");
    constexpr double kMost = 1e6;
    if (count >= 1.0 && count <= kMost && count == std::floor(count)) return count;
    throw InputError({columns_.place(row), "count: " + columns_.text(row, "count") + " is no number of rides",
                      "A speed is the mean of 1 to 1000000 rides, a whole number of them.", "count: 12"});
  }

  [[nodiscard]] const Hill& hill_of(std::size_t row) {
    const std::string name = columns_.text(row, "design");
    if (name.empty() && !design_) {
      throw InputError({columns_.place(row), "no design is named",
                        "A speed is ridden on the in-run of its design.", kDesignHint});
    }
    const std::filesystem::path path = name.empty() && design_ ? *design_ : folder_ / name;
    const auto known = hills_.find(path.string());
    if (known != hills_.end()) return known->second;
    Hill hill{read_design(path), nullptr, {}};
    hill.track = make_centerline(hill.design);
    if (hill.design.gates) {
      const Placement placement = Placement::through(hill.design.track.start, hill.design.track.finish);
      hill.gates = pipeline::gate_table(hill.design, hill.track, placement);
    }
    return hills_.emplace(path.string(), std::move(hill)).first->second;
  }

  [[nodiscard]] double start_of(std::size_t row, const Hill& hill) const {
    const double length = hill.track->length();
    if (!by_gate_) {
      const InRunDesign& in_run = hill.design.centerline.in_run;
      const bool adds_table = hill.design.centerline.kind == CenterlineKind::in_run && !in_run.counts_to_edge;
      const double ridden = columns_.number(row, "length_m") + (adds_table ? in_run.t : 0.0);
      constexpr double kRounding = 1e-9;
      if (ridden > 0.0 && ridden <= length * (1.0 + kRounding)) return std::max(length - ridden, 0.0);
      throw InputError(
          {columns_.place(row),
           "length_m: " + length_text(columns_.number(row, "length_m")) + " is no length of this in-run",
           "It is " + length_text(length) + " long from the highest start to the edge.",
           "what e counts to, the table or the edge"});
    }
    const double gate = columns_.number(row, "gate");
    if (!hill.gates) {
      throw InputError(
          {columns_.place(row), "the design has no gates", "", "gates: {count: 49} in it, or length_m"});
    }
    for (const Gate& one : hill.gates->gates) {
      if (one.number == gate) return one.from_start;
    }
    throw InputError({columns_.place(row), "there is no gate " + rounded_text(gate, 6),
                      "The hill has gates 1 to " + std::to_string(hill.gates->gates.size()) + ".", ""});
  }

  [[nodiscard]] SpeedReading reading_of(std::size_t row, const Hill& hill) const {
    SpeedReading reading;
    reading.source = columns_.place(row);
    reading.name = hill.design.name.empty() ? reading.source : hill.design.name;
    reading.track = hill.track;
    reading.body = body_of(hill.design);
    reading.gravity = hill.design.gravity;
    reading.from_start = start_of(row, hill);
    double before_edge =
        hill.design.gates ? hill.design.gates->measuring_place : GatesDesign{}.measuring_place;
    if (columns_.has("before_edge_m")) before_edge = columns_.number(row, "before_edge_m");
    reading.place = hill.track->length() - before_edge;
    constexpr double kKilometresPerHour = 3.6;
    reading.speed = in_kilometres_ ? columns_.number(row, "speed_km_h") / kKilometresPerHour
                                   : columns_.number(row, "speed_m_per_s");
    reading.count = count_of(row);
    constexpr double kFastest = 1000.0;  // taste: [m/s], faster than anything slides
    if (!(reading.speed > 0.0)) {
      throw InputError({columns_.place(row),
                        std::string(speed_column()) + ": " +
                            rounded_text(columns_.number(row, speed_column()), 4) + " is not positive",
                        "A speed is told by its size: the body rides down to where it is measured.",
                        "the speed as a positive number, or the row left out"});
    }
    if (reading.speed > kFastest) {
      throw InputError({columns_.place(row),
                        "the speed, " + rounded_text(reading.speed, 4) + " m/s, is too high",
                        "At most 1000 m/s.", "the unit of the column"});
    }
    if (reading.place > reading.from_start && before_edge >= 0.0) return reading;
    throw InputError({columns_.place(row),
                      "the speed is measured " + length_text(before_edge) +
                          " before the edge, where no ride of this line passes",
                      "", "before_edge_m: 10"});
  }

  [[nodiscard]] const char* speed_column() const { return in_kilometres_ ? "speed_km_h" : "speed_m_per_s"; }

  CsvColumns columns_;
  std::filesystem::path folder_;
  std::optional<std::filesystem::path> design_;
  bool by_gate_ = false;
  bool in_kilometres_ = false;
  std::map<std::string, Hill> hills_;
};

}  // namespace

std::vector<SpeedReading> read_speeds(const std::filesystem::path& file,
                                      const std::optional<std::filesystem::path>& design) {
  return Reader(file, design).read();
}

}  // namespace glissade
