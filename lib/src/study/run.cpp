#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/made_directories.hpp"
#include "glissade/study/study.hpp"

#include "study/evaluation.hpp"
#include "study/interrupted.hpp"
#include "study/manifest.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <system_error>
#include <thread>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace glissade::study {
namespace {

namespace fs = std::filesystem;

/// The rows of one chunk, computed on every thread of the arena.
std::string chunk_text(const Evaluation& evaluation, const Plan& plan, std::uint64_t chunk,
                       const std::stop_token& stop, const std::function<void()>& row_done) {
  const std::uint64_t first = chunk * kChunkRows;
  const std::uint64_t last = std::min(first + kChunkRows, plan.count());
  std::vector<std::string> rows(last - first);
  tbb::parallel_for(
      tbb::blocked_range<std::uint64_t>(first, last, 1),
      [&](const tbb::blocked_range<std::uint64_t>& range) {
        for (std::uint64_t index = range.begin(); index != range.end(); ++index) {
          if (stop.stop_requested()) return;
          rows[index - first] = evaluation.row(index);
          row_done();
        }
      },
      tbb::simple_partitioner());
  std::string text = table_heading(plan, evaluation.columns()) + "\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

}  // namespace

std::string_view word(Status status) {
  switch (status) {
    case Status::arrived:
      return "arrived";
    case Status::stalled:
      return "stalled";
    case Status::left_track:
      return "left the track";
    case Status::does_not_fit:
      return to_text(RideEnd::does_not_fit);
    case Status::choked:
      return to_text(RideEnd::choked);
    case Status::flies_over:
      return to_text(RideEnd::flies_over_start);
    case Status::stands:
      return to_text(RideEnd::stands_at_start);
    case Status::limits_broken:
      return "limits broken";
    case Status::infeasible:
      return "infeasible";
    case Status::none_found:
      return "none found";
    case Status::invalid:
      return "invalid";
  }
  throw InternalError({"", "a status without a word", "", ""});
}

std::optional<Status> status_named(std::string_view given) {
  for (const Status status : kStatuses) {
    if (word(status) == given) return status;
  }
  return {};
}

Shard Shard::parse(std::string_view text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto [slash, first] = std::from_chars(text.data(), end, shard.index);
  if (first == std::errc() && slash != end && *slash == '/') {
    const auto [rest, second] = std::from_chars(slash + 1, end, shard.count);
    if (second == std::errc() && rest == end && shard.index < shard.count) return shard;
  }
  throw InputError({"--shard", "'" + std::string(text) + "' is not of the form i/n with 0 <= i < n",
                    "Shards are counted from 0: of 16, the first is 0/16 and the last 15/16.",
                    "--shard 0/16"});
}

RunReport run(const Study& study, const RunOptions& options) {
  if (options.progress) options.progress("preparing the sweep", {});
  check(study);
  const Evaluation evaluation(study, options.stop);
  const std::string manifest = manifest_text(study, evaluation.columns());
  MadeDirectories made;  // gone where not even the manifest can be written
  made.make(options.directory);
  made.make(options.directory / "chunks");
  place_manifest(options.directory, manifest);
  made.keep();  // other processes write into them, too

  RunReport report;
  report.points = study.plan.count();
  report.chunks = chunks_of(report.points);
  std::vector<std::uint64_t> wanted;
  for (std::uint64_t chunk = options.shard.index; chunk < report.chunks; chunk += options.shard.count) {
    ++report.chunks_of_shard;
    if (fs::exists(chunk_path(options.directory, chunk))) {
      ++report.chunks_found;
    } else {
      wanted.push_back(chunk);
    }
  }

  const int jobs =
      static_cast<int>(options.jobs != 0 ? options.jobs : std::max(std::thread::hardware_concurrency(), 1U));
  const tbb::global_control most(tbb::global_control::max_allowed_parallelism,
                                 static_cast<std::size_t>(jobs));
  tbb::task_arena arena(jobs);
  std::atomic<std::uint64_t> rows_done{0};
  std::uint64_t rows_wanted = 0;
  for (const std::uint64_t chunk : wanted) {
    rows_wanted += std::min(kChunkRows, study.plan.count() - chunk * kChunkRows);
  }
  const auto row_done = [&] { ++rows_done; };
  for (const std::uint64_t chunk : wanted) {
    if (options.progress) {
      options.progress("computing points",
                       static_cast<double>(rows_done.load()) / static_cast<double>(rows_wanted));
    }
    std::string text;
    arena.execute([&] { text = chunk_text(evaluation, study.plan, chunk, options.stop, row_done); });
    if (options.stop.stop_requested()) throw Interrupted(interrupted_sweep(options.directory));
    write_atomically(chunk_path(options.directory, chunk), text);
    ++report.chunks_computed;
  }
  report.complete = Results::open(options.directory).missing().empty();
  return report;
}

}  // namespace glissade::study
