#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/study/study.hpp"

#include "study/interrupted.hpp"
#include "study/manifest.hpp"
#include "study/table_file.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <system_error>

namespace glissade::study {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_broken(const fs::path& file, std::size_t line, const std::string& what) {
  throw FileError({file.string() + ":" + std::to_string(line), what,
                   "A chunk is written whole or not at all.",
                   "remove this file and run the sweep again, which computes it anew"});
}

std::string heading_of(const Results& results) {
  std::string line = "index";
  for (const std::string& column : results.inputs()) line += "," + as_cell(column);
  line += ",status,reason";
  for (const std::string& column : results.quantities()) line += "," + as_cell(column);
  return line;
}

/// Rows that the manifest does not know of are those of another sweep, or the manifest is not the one that was written.
void refuse_strays(const Results& results) {
  std::vector<fs::path> strays;
  std::error_code none;
  for (fs::directory_iterator entry(results.directory() / "chunks", none), end; !none && entry != end;
       entry.increment(none)) {
    const std::string name = entry->path().stem().string();
    std::uint64_t chunk = 0;
    const auto [rest, status] = std::from_chars(name.data(), name.data() + name.size(), chunk);
    if (status != std::errc() || entry->path() != chunk_path(results.directory(), chunk)) continue;
    if (rest == name.data() + name.size() && chunk >= results.chunks()) strays.push_back(entry->path());
  }
  if (strays.empty()) return;
  throw FileError({std::min_element(strays.begin(), strays.end())->string(),
                   "is none of the " + std::to_string(results.chunks()) + " chunks of this sweep",
                   "The manifest beside it tells of " + std::to_string(results.points()) + " points, of " +
                       std::to_string(kChunkRows) + " to a chunk: the rows are those of more.",
                   "the manifest.json that the sweep wrote, or without this file"});
}

/// The lines of all chunks in their order, each with its file and number.
/// @param interrupted  what is told where `stop` asks for the end
void for_each_line(const Results& results, const Progress& progress, const std::stop_token& stop,
                   const Issue& interrupted,
                   const std::function<void(const std::string&, const fs::path&, std::size_t)>& visit) {
  refuse_strays(results);
  const std::string heading = heading_of(results);
  for (std::uint64_t chunk = 0; chunk < results.chunks(); ++chunk) {
    if (stop.stop_requested()) throw Interrupted(interrupted);
    if (progress)
      progress("reading rows", static_cast<double>(chunk) / static_cast<double>(results.chunks()));
    const fs::path file = chunk_path(results.directory(), chunk);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
      const std::uint64_t missing = results.missing().size();
      throw FileError({file.string(),
                       "is missing, with " + std::to_string(missing) + " of " +
                           std::to_string(results.chunks()) + " chunks in all",
                       "The sweep has not come to its end.",
                       "the command of the sweep again, which goes on where it ended"});
    }
    std::string line;
    std::size_t number = 1;
    if (!std::getline(stream, line) || line != heading)
      throw_broken(file, 1, "the heading is not that of the manifest");
    while (std::getline(stream, line)) {
      ++number;
      // A number that is cut off is one, too.
      if (stream.eof()) throw_broken(file, number, "the line has no end: the file is cut off");
      visit(line, file, number);
    }
    const std::uint64_t first = chunk * kChunkRows;
    const std::uint64_t rows = std::min(kChunkRows, results.points() - first);
    if (number != rows + 1) {
      throw_broken(file, number, std::to_string(number - 1) + " rows instead of " + std::to_string(rows));
    }
  }
}

std::optional<double> as_number(const std::string& cell) {
  double value = 0.0;
  const auto [rest, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (status != std::errc() || rest != cell.data() + cell.size()) return {};
  return value;
}

std::vector<std::string> cells_of_row(const std::string& line, const fs::path& file, std::size_t number) {
  try {
    return cells_of(line);
  } catch (const InputError& error) {
    throw_broken(file, number, error.issues().front().what);
  }
}

Row row_of(const Results& results, const std::string& line, std::uint64_t expected, const fs::path& file,
           std::size_t number) {
  const std::vector<std::string> cells = cells_of_row(line, file, number);
  const std::size_t inputs = results.inputs().size();
  if (cells.size() != 3 + inputs + results.quantities().size())
    throw_broken(file, number, "the row is not complete");
  Row row;
  row.index = expected;
  if (cells[0] != std::to_string(expected)) {
    throw_broken(file, number,
                 "row " + cells[0] + " stands where row " + std::to_string(expected) + " belongs");
  }
  row.inputs.assign(cells.begin() + 1, cells.begin() + 1 + static_cast<std::ptrdiff_t>(inputs));
  const auto status = status_named(cells[1 + inputs]);
  if (!status) throw_broken(file, number, "'" + cells[1 + inputs] + "' is no status");
  row.status = *status;
  row.reason = cells[2 + inputs];
  row.quantities.reserve(results.quantities().size());
  for (std::size_t column = 3 + inputs; column < cells.size(); ++column) {
    row.quantities.push_back(cells[column].empty() ? std::nullopt : as_number(cells[column]));
    if (!cells[column].empty() && !row.quantities.back()) {
      throw_broken(file, number, "'" + cells[column] + "' is no number");
    }
  }
  return row;
}

}  // namespace

std::vector<std::uint64_t> Results::missing() const {
  std::vector<std::uint64_t> missing;
  for (std::uint64_t chunk = 0; chunk < chunks(); ++chunk) {
    if (!fs::exists(chunk_path(directory_, chunk))) missing.push_back(chunk);
  }
  return missing;
}

void Results::for_each(const std::function<void(const Row&)>& visit, const Progress& progress,
                       const std::stop_token& stop) const {
  std::uint64_t next = 0;
  for_each_line(*this, progress, stop, interrupted_sweep(directory_),
                [&](const std::string& line, const fs::path& file, std::size_t number) {
                  visit(row_of(*this, line, next++, file, number));
                });
}

std::map<Status, std::uint64_t> merge(const Results& results, const fs::path& file, const Progress& progress,
                                      const std::stop_token& stop) {
  AtomicFile table(file);
  table.write(heading_of(results) + "\n");
  std::map<Status, std::uint64_t> counts;
  std::uint64_t next = 0;
  const Issue interrupted{file.string(), "interrupted; the table is not written",
                          "The rows stay as they are; the same command begins the table anew.", ""};
  for_each_line(results, progress, stop, interrupted,
                [&](const std::string& line, const fs::path& place, std::size_t number) {
                  ++counts[row_of(results, line, next++, place, number).status];
                  table.write(line + "\n");
                });
  table.commit();
  return counts;
}

}  // namespace glissade::study
