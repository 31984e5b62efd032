#include "app/sweep_text.hpp"

#include "glissade/core/number_text.hpp"

#include "app/table.hpp"

#include <algorithm>

namespace glissade::app {

std::string counts_text(const std::map<study::Status, std::uint64_t>& counts) {
  std::uint64_t all = 0;
  for (const auto& [status, count] : counts) all += count;
  Table table({"Status", "points", "share"});
  for (const study::Status status : study::kStatuses) {
    const auto found = counts.find(status);
    if (found == counts.end()) continue;
    const double share = 100.0 * static_cast<double>(found->second) / static_cast<double>(all);
    table.add({std::string(word(status)), std::to_string(found->second), rounded_text(share, 4) + " %"});
  }
  return table.text();
}

std::string run_text(const study::RunReport& report, const std::string& directory) {
  std::string text =
      labelled("Points", std::to_string(report.points) + " in " + std::to_string(report.chunks) +
                             (report.chunks == 1 ? " chunk" : " chunks"));
  std::string done = std::to_string(report.chunks_computed) + " computed";
  if (report.chunks_found != 0) done += ", " + std::to_string(report.chunks_found) + " there before";
  if (report.chunks_of_shard != report.chunks)
    done += " (this shard has " + std::to_string(report.chunks_of_shard) + ")";
  text += labelled("Chunks", done);
  text += labelled("Rows", directory + "/chunks");
  return text;
}

std::string summary_text(const study::Summary& summary) {
  std::string text = "\n" + counts_text(summary.counts);
  if (summary.varying.empty()) return text;
  Table table({"Figure", "lowest", "5 %", "median", "95 %", "highest"});
  constexpr int kDigits = 5;
  for (const std::size_t place : summary.varying) {
    const study::ColumnFacts& facts = summary.quantities[place];
    table.add({facts.name, rounded_text(facts.lowest, kDigits),
               rounded_text(facts.quantiles.front(), kDigits), rounded_text(facts.quantiles[2], kDigits),
               rounded_text(facts.quantiles.back(), kDigits), rounded_text(facts.highest, kDigits)});
  }
  return text + "\n" + table.text();
}

std::string for_shell(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.,:=/+%-";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

namespace {

/// The file of what a task prints, as sbatch reads it in a line of the batch file: quotes and spaces as a shell does, but a
/// backslash takes the next character's meaning within quotes too, and Slurm replaces what follows a % (%% is one).
/// @return beside the rows; where no line can say their directory, in the folder of the submission
std::string log_file(const std::string& directory) {
  const auto untellable = [](unsigned char letter) {
    return letter == '\\' || letter < 0x20 || letter == 0x7F;
  };
  const std::string name = "slurm-%A_%a.log";
  if (std::any_of(directory.begin(), directory.end(), untellable)) return name;
  std::string text;
  for (const char letter : directory) text += letter == '%' ? std::string("%%") : std::string(1, letter);
  return for_shell(text + "/" + name);
}

}  // namespace

std::string batch_text(const std::vector<std::string>& arguments, const std::string& directory,
                       std::uint64_t tasks) {
  std::string text =
      "#!/bin/bash\n"
      "# Written by glissade sweep --slurm. Submit it where the command was given: paths are relative to "
      "that folder.\n"
      "# A task that dies is submitted again, alone with --array=NUMBER; what is written is not computed "
      "twice.\n"
      "#SBATCH --job-name=glissade-sweep\n";
  text += "#SBATCH --array=0-" + std::to_string(tasks - 1) + "\n";
  text += "#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=1\n";
  text += "#SBATCH --output=" + log_file(directory) + "\n\n";
  text += "exec \"${GLISSADE:-glissade}\"";
  for (const std::string& word : arguments) text += " " + for_shell(word);
  // Not SLURM_ARRAY_TASK_COUNT: of tasks that are submitted again it counts those alone.
  text += " \\\n  --shard \"$SLURM_ARRAY_TASK_ID/" + std::to_string(tasks) +
          "\" --jobs \"${SLURM_CPUS_PER_TASK:-1}\" --quiet\n";
  return text;
}

}  // namespace glissade::app
