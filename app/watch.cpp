#include "app/watch.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"
#include "glissade/design/design_source.hpp"

#include "app/console.hpp"
#include "app/file_watch.hpp"
#include "app/interrupt.hpp"

#include <array>
#include <chrono>
#include <ctime>
#include <utility>
#include <vector>

namespace glissade::app {
namespace {

std::string time_of_day() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm local = {};
  localtime_r(&now, &local);
  std::array<char, 16> text = {};
  return {text.data(), std::strftime(text.data(), text.size(), "%H:%M:%S", &local)};
}

/// Adds what the design names now, or, of one that cannot be read, what it named before.
void add_data_files(FileWatch& files, const Watched& watched, std::vector<std::filesystem::path>& known) {
  try {
    std::vector<std::filesystem::path> named;
    for (DataFile& data : DesignSource::read(watched.design).data_files(watched.overrides.values()))
      named.push_back(std::move(data.file));
    known = std::move(named);
  } catch (const Error&) {
    // Making it tells what is wrong with it.
  }
  for (const std::filesystem::path& file : known) files.add(file);
}

std::string names_of(const FileWatch& files) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files.files()) names.push_back(file.string());
  return listed(names);
}

/// @return what to say of it: what was made, or that nothing was
std::string made(const Watched& watched, const FileWatch& files, const RunContext& context) {
  try {
    const auto start = std::chrono::steady_clock::now();
    const std::string line = watched.make(context);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return "built in " + rounded_text(taken.count(), 2) + " s: " + line;
  } catch (const InternalError&) {
    throw;  // a defect of ours is no matter of the next change
  } catch (const Error& error) {
    if (!context.stop.stop_requested()) print_problem(error);
    return "not built; waiting for a change of " + names_of(files);
  }
}

}  // namespace

ExitCode watch(const Watched& watched) {
  const Interrupt interrupt;
  const std::stop_token stop = interrupt.token();
  std::vector<std::filesystem::path> data_files;
  bool first = true;
  while (true) {
    // Looked at before it is read: a change while it is being made is one.
    FileWatch files;
    files.add(watched.design);
    add_data_files(files, watched, data_files);
    if (first && !watched.quiet) print_error("glissade: watching " + names_of(files) + "; Ctrl-C ends it\n");
    first = false;
    const std::string line = made(watched, files, interrupt.context({}));
    if (stop.stop_requested()) return ExitCode::interrupted;
    if (!watched.quiet) print(time_of_day() + "  " + line + "\n");
    if (!files.wait(stop)) return ExitCode::interrupted;
  }
}

}  // namespace glissade::app
