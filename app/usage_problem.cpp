#include "app/usage_problem.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/nearest_word.hpp"
#include "glissade/core/odd_characters.hpp"
#include "glissade/core/words.hpp"
#include "glissade/design/design_source.hpp"
#include "glissade/study/study.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <sys/stat.h>
#include <unistd.h>

namespace glissade::app {
namespace {

/// The command that is given, or the program itself.
const CLI::App& given(const CLI::App& program) {
  const auto commands = program.get_subcommands();
  return commands.empty() ? program : *commands.front();
}

std::string full_name(const CLI::App& program) {
  const CLI::App& command = given(program);
  return &command == &program ? program.get_name() : program.get_name() + " " + command.get_name();
}

std::vector<std::string> commands_of(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string nearest_of(const std::string& word, const std::vector<std::string>& words) {
  const std::vector<std::string_view> candidates(words.begin(), words.end());
  return std::string(nearest_word(word, candidates));
}

/// Whether a word that begins with a dash is rather the name of a file.
bool may_be_file(const std::string& argument) {
  std::error_code ignored;
  if (std::filesystem::exists(argument, ignored)) return true;
  if (argument.starts_with("--")) return false;
  const std::string extension = std::filesystem::path(argument).extension().string();
  constexpr std::string_view kRead[] = {".yaml", ".yml", ".csv", ".stl", ".off"};
  return std::find(std::begin(kRead), std::end(kRead), extension) != std::end(kRead);
}

Issue unknown_option(const CLI::App& program, const std::string& argument) {
  if (may_be_file(argument)) {
    return {"", with_visible_characters(argument) + " is taken for an option",
            "What begins with - is one, unless -- stands before it.",
            "./" + with_visible_characters(argument) + ", or -- before it"};
  }
  const std::string word = argument.substr(0, argument.find('='));
  const std::string help = full_name(program) + " --help";
  Issue issue{"", full_name(program) + " has no option " + with_visible_characters(word), "", help};
  const std::string near = nearest_of(with_plain_characters(word), options_of(given(program)));
  if (!near.empty()) issue.hint = near == "--help" ? help : near + ", or " + help;
  // An option of another command, or one before the command that it belongs to.
  const std::string name = word.substr(std::min(word.find_first_not_of('-'), word.size()));
  std::vector<std::string> owners;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    const std::vector<std::string> options = options_of(*command);
    if (std::find(options.begin(), options.end(), "--" + name) != options.end())
      owners.push_back(command->get_name());
  }
  if (!owners.empty() && word.starts_with("--")) issue.why = "It belongs to " + listed(owners) + ".";
  return issue;
}

bool is_option(const std::string& argument) {
  return argument.size() > 1 && with_plain_characters(argument).front() == '-';
}

std::string name_of(const CLI::Option& option) {
  if (option.get_positional()) return option.get_type_name();
  return option.get_lnames().empty() ? "-" + option.get_snames().front() : "--" + option.get_lnames().front();
}

/// The option whose name begins what the parser says.
const CLI::Option* option_that_begins(const CLI::App& command, const std::string& text) {
  const std::string name = text.substr(0, text.find_first_of(": "));
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_name() == name) return option;
  }
  return nullptr;
}

/// Of "Could not convert: --json = x": which option, and what it takes.
std::optional<Issue> not_taken(const CLI::App& command, const std::string& text, const std::string& help) {
  constexpr std::string_view kBegins = "Could not convert: ";
  if (!text.starts_with(kBegins)) return {};
  const std::string rest = text.substr(kBegins.size());
  const std::size_t sign = std::min(rest.find(" = "), rest.size());
  const std::string name = rest.substr(0, sign);
  const std::string value = sign < rest.size() ? rest.substr(sign + std::string_view(" = ").size()) : "";
  const CLI::Option* const option = command.get_option_no_throw(name);
  const std::string type = option == nullptr ? "" : option->get_type_name();
  const bool is_flag = option != nullptr && option->get_expected_min() == 0;
  return Issue{name, "it cannot take " + shown(value),
               is_flag        ? "It takes no value."
               : type.empty() ? ""
                              : "It takes " + type + ".",
               is_flag ? name + " alone" : help};
}

void require_values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const bool names_file = type == "FILE" || type == "DIR" || type == "MESH" || type.starts_with("DESIGN");
  for (const std::string& value : option.results()) {
    if (value.empty()) {
      throw InputError({name_of(option), "an empty text is given", "It takes " + type + ".",
                        names_file ? "the name of a file or directory; a shell's variable may be empty"
                                   : "a value, or no " + name_of(option)});
    }
    const auto odd = odd_character(value);
    if (option.get_positional() && odd && odd->offset == 0 && is_option(value)) {
      throw InputError({with_visible_characters(value), "it begins with " + odd->name + ", not with -",
                        "Options begin with the minus of the keyboard.", with_plain_characters(value)});
    }
    if (!names_file || value != "-") continue;
    const bool reads = option.get_positional();
    throw InputError({name_of(option), "- is no name of a file",
                      reads ? "Standard input has a name of its own."
                            : "Standard output carries the result alone: files are written whole, beside it.",
                      reads ? "/dev/stdin" : name_of(option) + " and a name"});
  }
}

/// The directory of a sweep whose rows the command merges into one file; empty where it does something else.
std::string merged_directory(const CLI::App& command) {
  const CLI::Option* const merged = command.get_option_no_throw("--merge");
  return merged == nullptr || merged->results().empty() ? std::string() : merged->results().front();
}

/// Whether an option names the directory that a sweep writes into, or its merged table.
bool is_output_of_sweep(const CLI::Option& option) {
  return option.get_type_name() == "PATH";
}

/// Whether an option names a file that the command writes whole.
bool writes_file(const CLI::Option& option) {
  return !option.get_positional() && (option.get_type_name() == "FILE" || is_output_of_sweep(option));
}

std::vector<Override> overrides_of(const CLI::App& command) {
  std::vector<Override> overrides;
  const CLI::Option* const option = command.get_option_no_throw("--set");
  if (option == nullptr) return overrides;
  for (const std::string& text : option->results()) {
    const std::size_t sign = text.find('=');
    if (sign != std::string::npos) overrides.push_back({text.substr(0, sign), text.substr(sign + 1)});
  }
  return overrides;
}

/// All files that an option has the command write whole.
std::vector<std::string> written_by(const CLI::App& command, const CLI::Option& option) {
  std::vector<std::string> files = option.results();
  if (is_output_of_sweep(option) && merged_directory(command).empty()) {
    std::vector<std::string> inside;
    for (const std::string& directory : files) {
      // Manifest and rows take no other file's place.
      for (const char* const name : {"sweep.html", "sweep.sbatch"})
        inside.push_back((std::filesystem::path(directory) / name).string());
    }
    return inside;
  }
  if (name_of(option) != "--frozen") return files;
  for (const std::string& design : option.results())
    files.push_back(
        std::filesystem::path(design).replace_extension(".csv").string());  // of a track that needs a table
  return files;
}

/// Looks that no file is put in the place of the one that standard output or standard error goes to, by its name or as
/// /dev/stdout: what is printed would go to a file without a name.
/// @throws InputError with the option
void require_beside_output(const CLI::Option& option, const std::string& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0 || !S_ISREG(file.st_mode)) return;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat output {};
    if (::fstat(stream, &output) != 0 || output.st_dev != file.st_dev || output.st_ino != file.st_ino)
      continue;
    const std::string which = stream == STDOUT_FILENO ? "standard output" : "standard error";
    throw InputError({name_of(option), with_visible_characters(path) + " is where " + which + " goes",
                      "Files are written whole and put in place: what is printed would be lost.",
                      "another name"});
  }
}

/// Whether two names are of one file, whether it is there or not.
bool is_one_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  const auto whole = [](const std::string& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  return whole(a) == whole(b) || std::filesystem::equivalent(a, b, ignored);
}

/// Whether a file is one of those that a sweep has left in its directory.
bool is_of_sweep(const std::string& directory, const std::string& path) {
  std::error_code ignored;
  const std::filesystem::path sweep(directory);
  return std::filesystem::equivalent(path, sweep / "manifest.json", ignored) ||
         std::filesystem::equivalent(std::filesystem::absolute(path).parent_path(), sweep / "chunks",
                                     ignored);
}

/// Whether what stands at `path` has the name of a file that a sweep was made of.
bool was_swept(const std::string& directory, const std::string& path) {
  std::error_code ignored;
  if (directory.empty() || !std::filesystem::is_regular_file(path, ignored)) return false;
  try {
    // The manifest knows no directories: a sweep is the same wherever it runs.
    const std::vector<std::string> files = study::Results::open(directory).files();
    return std::find(files.begin(), files.end(), std::filesystem::path(path).filename().string()) !=
           files.end();
  } catch (const Error&) {
    return false;  // the command says what is wrong with it
  }
}

/// Whether what stands at `path` is a file that the command reads: an argument, or what a design names.
bool is_read(const CLI::App& command, const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  const std::string merged = merged_directory(command);
  if (!merged.empty() && is_of_sweep(merged, path)) return true;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() && name_of(*option) != "--points") continue;
    for (const std::string& argument : option->results()) {
      if (!std::filesystem::is_regular_file(argument, ignored)) continue;
      if (std::filesystem::equivalent(argument, path, ignored)) return true;
      if (!option->get_type_name().ends_with("DESIGN.yaml") && !option->get_type_name().starts_with("DESIGN"))
        continue;
      try {
        for (const DataFile& data : DesignSource::read(argument).data_files(overrides_of(command))) {
          if (std::filesystem::equivalent(data.file, path, ignored)) return true;
        }
      } catch (const Error&) {
        continue;  // the command says what is wrong with it
      }
    }
  }
  return false;
}

}  // namespace

Issue unknown_command(const CLI::App& program, const std::string& word) {
  const std::vector<std::string> commands = commands_of(program);
  const std::string near = nearest_of(word, commands);
  return {"", "there is no command " + with_visible_characters(word), "There are " + listed(commands) + ".",
          near.empty() ? full_name(program) + " --help" : full_name(program) + " " + near};
}

Issue usage_issue(const CLI::App& program, const std::string& parser_text) {
  std::vector<std::string> rest = program.remaining(true);
  // What stands behind it is no option.
  const auto end_of_options = std::find(rest.begin(), rest.end(), "--");
  const auto found = std::find_if(rest.begin(), end_of_options, &is_option);
  const std::optional<std::string> option = found == end_of_options ? std::nullopt : std::optional(*found);
  if (end_of_options != rest.end()) rest.erase(end_of_options);
  const bool has_command = &given(program) != &program;
  const bool command_first = !has_command && !rest.empty() && !is_option(rest.front());
  if (command_first) return unknown_command(program, rest.front());
  if (option) return unknown_option(program, *option);
  const std::string help = full_name(program) + " --help";
  if (!rest.empty()) {
    return {"",
            full_name(program) + " does not know what to do with " + with_visible_characters(rest.front()),
            "It takes no further argument.", help};
  }
  std::string what = parser_text;
  while (!what.empty() && (what.back() == '\n' || what.back() == ' ')) what.pop_back();
  if (const auto issue = not_taken(given(program), what, help)) return *issue;
  if (const CLI::Option* const named = option_that_begins(given(program), what)) {
    const std::string name = name_of(*named);
    const std::string type = named->get_type_name();
    if (what.find(": At Most ") != std::string::npos)
      return {name, "it is given more than once", "It takes one " + type + ".", "one of them"};
    if (what.ends_with(" missing")) return {name, "no value is given", "It takes " + type + ".", help};
    if (what.ends_with(" is required")) return {"", name + " is required", "", help};
  }
  return {"", std::move(what), "", help};
}

void require_values(const CLI::App& program) {
  for (const CLI::Option* option : given(program).get_options()) require_values_of(*option);
}

void refuse_ignored(const CLI::App& command, const std::vector<std::string>& options,
                    const std::string& beside, const std::string& why, const std::string& hint) {
  for (const std::string& name : options) {
    const CLI::Option& option = *command.get_option(name);
    if (option.count() == 0) continue;
    throw InputError({name_of(option), "it changes nothing " + beside, why, hint});
  }
}

void keep_what_is_read(const CLI::App& program) {
  const std::vector<const CLI::Option*> options = given(program).get_options();
  for (auto one = options.begin(); one != options.end(); ++one) {
    if (!writes_file(**one)) continue;
    for (const std::string& path : written_by(given(program), **one)) {
      require_beside_output(**one, path);
      if (is_read(given(program), path)) {
        throw InputError({name_of(**one), with_visible_characters(path) + " is read by this command, too",
                          "What it holds would be lost.", "another name"});
      }
      if (was_swept(merged_directory(given(program)), path)) {
        throw InputError({name_of(**one),
                          with_visible_characters(path) + " has the name of a file that was swept",
                          "What it holds would be lost.", "another name, such as sweep.csv"});
      }
      const auto same = [&](const CLI::Option* other) {
        if (!writes_file(*other)) return false;
        const std::vector<std::string> files = written_by(given(program), *other);
        return std::any_of(files.begin(), files.end(),
                           [&](const std::string& file) { return is_one_file(file, path); });
      };
      const auto other = std::find_if(options.begin(), one, same);
      if (other == one) continue;
      throw InputError({name_of(**one),
                        with_visible_characters(path) + " is what " + name_of(**other) + " writes",
                        "One of the two would be lost.", "another name"});
    }
  }
}

}  // namespace glissade::app
