#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// What a design file can be started from.
struct DesignTemplate {
  std::string_view kind;     ///< the word for it, e.g. "chute"
  std::string_view summary;  ///< one line, for a list
};

/// @return every template; the first is the one to start from where none is named
[[nodiscard]] const std::vector<DesignTemplate>& design_templates();

/// @return a commented design file, valid as it stands; that of "points" needs a profile beside it, see
///         design_template_profile()
/// @throws InputError if there is no template of that kind (names those that there are)
[[nodiscard]] std::string design_template(std::string_view kind);

/// The template "in-run" with the sizes that rules and certificates suggest for a hill.
/// @param hill_size  HS [m]; the template itself is that of a hill of 140 m
/// @throws InputError as suggested_in_run()
[[nodiscard]] std::string in_run_template(double hill_size);

/// The file that the "points" template reads, and a small measured profile to put into it.
inline constexpr std::string_view kTemplateProfileName = "profile.csv";
[[nodiscard]] std::string_view design_template_profile();

}  // namespace glissade
