#pragma once

#include "glissade/core/progress.hpp"
#include "glissade/design/design_source.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/study/plan.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::study {

/// How a point of a study ended.
enum class Status {
  arrived,        ///< the body arrives, every limit is kept
  stalled,        ///< it stops before the finish
  left_track,     ///< it lifts off
  does_not_fit,   ///< into a valley
  choked,         ///< a stream
  flies_over,     ///< a feed, the start of its track
  stands,         ///< a feed, where it lands
  limits_broken,  ///< it arrives, but a limit of the design does not hold on this track
  infeasible,     ///< no track reaches the finish, or keeps the limits
  none_found,     ///< the search ended without a track
  invalid         ///< the values do not make a design
};

inline constexpr std::array<Status, 11> kStatuses = {
    Status::arrived,    Status::stalled,    Status::left_track, Status::does_not_fit,
    Status::choked,     Status::flies_over, Status::stands,     Status::limits_broken,
    Status::infeasible, Status::none_found, Status::invalid};

/// @return the word of a row: "arrived", "stalled", "left the track", "does not fit", "choked", "flies over the start", "stands where
///         it lands", "limits broken", "infeasible", "none found",
///         "invalid"
[[nodiscard]] std::string_view word(Status status);
/// @return none if the word names no status
[[nodiscard]] std::optional<Status> status_named(std::string_view word);

/// A figure of a track under the name that --json gives it, e.g. {"travel_time_s", 2.15}; names within groups joined by
/// dots. No value where the figure does not exist for this track.
using Quantity = std::pair<std::string, std::optional<double>>;
/// Every figure of a track. Must depend on its arguments alone; called from several threads at once.
using Quantities = std::function<std::vector<Quantity>(const Design& design, const Track& track)>;

/// The usual ones: every figure of --json that a table can hold. Of each limit what was reached and by how much it is
/// broken; of a friction range the rides at its ends (`rides.low.travel_time_s`). What the clock had a part in is left out.
/// The friction at which the body stalls, which takes some fifty rides, is not among them.
[[nodiscard]] std::vector<Quantity> quantities_of(const Design& design, const Track& track);
/// The same with `stall_friction_angle_deg` and `stall_margin_deg`, at the ends of a friction range too.
[[nodiscard]] std::vector<Quantity> quantities_with_stall_margins(const Design& design, const Track& track);
/// @return whether one of the columns is a figure that quantities_of() leaves out
[[nodiscard]] bool needs_stall_margins(const std::vector<std::string>& columns);

/// A part of the work, for engines that run many processes: the chunks whose number leaves `index` when divided by `count`.
struct Shard {
  std::uint64_t index = 0;
  std::uint64_t count = 1;  ///< >= 1, > index

  /// @param text  "i/n" with 0 <= i < n
  /// @throws InputError if it is not that
  [[nodiscard]] static Shard parse(std::string_view text);
};

/// What is studied: the points of a plan, each a design, each designed anew or ridden on one frozen track.
struct Study {
  DesignSource source;
  std::vector<Override> base;  ///< of every point, before its own values
  Plan plan;
  bool frozen = false;               ///< the track of the base design is found once, and every point rides it
  std::vector<std::string> columns;  ///< quantities of a row; empty: all of them
  Quantities quantities = quantities_of;
};

/// Where a study writes, and which part of it this process computes.
struct RunOptions {
  std::filesystem::path directory = {};
  Shard shard = {};
  unsigned jobs = 0;  ///< threads; 0: one a processor
  Progress progress = {};
  std::stop_token stop = {};
};

/// What a run did, and what is there now.
struct RunReport {
  std::uint64_t points = 0;  ///< of the whole study
  std::uint64_t chunks = 0;  ///< of the whole study
  std::uint64_t chunks_of_shard = 0;
  std::uint64_t chunks_found = 0;     ///< of this shard, there before
  std::uint64_t chunks_computed = 0;  ///< of this shard, by this run
  bool complete = false;              ///< every chunk of the study is there
};

/// Rows a chunk; a chunk is a file of its own, written whole or not at all: that it exists means that it is done.
inline constexpr std::uint64_t kChunkRows = 1000;
/// @return chunks of that many points
[[nodiscard]] constexpr std::uint64_t chunks_of(std::uint64_t points) {
  return (points + kChunkRows - 1) / kChunkRows;
}

inline constexpr const char* kManifestName = "manifest.json";

/// Computes the chunks of a shard that are not there yet, in `directory` (made if missing), beside a manifest of what is
/// studied. Any number of processes may work in one directory, on one shard too: they write the same bytes.
/// A point that fails is a row, never an end.
/// @throws InputError if the directory holds another study, which differs in ... ; a column is unknown; every value tried of
///         a key is refused (then with the reader's own problem); `frozen` and a key that shapes the track
/// @throws FileError if a file cannot be written; Interrupted if the stop token asks for it: what is written stays valid
/// @throws as solve() if the track to be frozen cannot be found
RunReport run(const Study& study, const RunOptions& options);

/// What run() refuses before it computes a point, apart from columns.
/// @throws InputError as run()
void check(const Study& study);

/// One row of a study.
struct Row {
  std::uint64_t index = 0;
  std::vector<std::string> inputs;  ///< texts, without their units
  Status status = Status::invalid;
  std::string reason;                             ///< one line; empty of a point that arrived
  std::vector<std::optional<double>> quantities;  ///< in the order of the columns
};

/// A directory of results, to read.
class Results {
 public:
  /// @throws FileError if there is no manifest or it cannot be read
  [[nodiscard]] static Results open(const std::filesystem::path& directory);

  [[nodiscard]] std::uint64_t points() const noexcept { return points_; }
  [[nodiscard]] std::uint64_t chunks() const noexcept { return chunks_of(points_); }
  [[nodiscard]] const std::vector<std::string>& inputs() const noexcept {
    return inputs_;
  }  ///< columns of inputs
  [[nodiscard]] const std::vector<std::string>& keys() const noexcept { return keys_; }    ///< their keys
  [[nodiscard]] const std::vector<std::string>& units() const noexcept { return units_; }  ///< and units
  [[nodiscard]] const std::vector<bool>& numeric() const noexcept {
    return numeric_;
  }  ///< whether an input is a number
  [[nodiscard]] const std::vector<std::string>& quantities() const noexcept { return quantities_; }
  [[nodiscard]] const std::string& design() const noexcept { return design_; }  ///< name of its file
  /// @return names of the files that were studied, as far as the manifest tells: the design's, those that it takes from
  /// and tables of points
  [[nodiscard]] const std::vector<std::string>& files() const noexcept { return files_; }
  [[nodiscard]] const std::vector<std::string>& base() const noexcept {
    return base_;
  }  ///< KEY=VALUE of every point
  /// Whether an input is independent of all others: not one of several in a table of points.
  [[nodiscard]] const std::vector<bool>& independent() const noexcept { return independent_; }
  [[nodiscard]] bool frozen() const noexcept { return frozen_; }
  [[nodiscard]] const std::filesystem::path& directory() const noexcept { return directory_; }

  /// @return numbers of the chunks that are not there
  [[nodiscard]] std::vector<std::uint64_t> missing() const;
  /// Every row in the order of their numbers, each checked.
  /// @throws FileError if a chunk is missing, cannot be read, or is not what the manifest says, with the place; Interrupted if
  ///         `stop` asks for it
  void for_each(const std::function<void(const Row&)>& visit, const Progress& progress = {},
                const std::stop_token& stop = {}) const;

 private:
  std::filesystem::path directory_;
  std::uint64_t points_ = 0;
  std::vector<std::string> inputs_;
  std::vector<std::string> keys_;
  std::vector<std::string> units_;
  std::vector<bool> numeric_;
  std::vector<std::string> quantities_;
  std::string design_;
  std::vector<std::string> files_;
  std::vector<std::string> base_;
  std::vector<bool> independent_;
  bool frozen_ = false;
};

/// All rows in one table, each number once.
/// @return how many points ended how
/// @throws FileError as Results::for_each(), or if `file` cannot be written; Interrupted if `stop` asks for it, without a table
std::map<Status, std::uint64_t> merge(const Results& results, const std::filesystem::path& file,
                                      const Progress& progress = {}, const std::stop_token& stop = {});

}  // namespace glissade::study
