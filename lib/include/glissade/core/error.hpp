#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace glissade {

/// One finding about an input, in the four parts that every message of Glissade has.
struct Issue {
  std::string where;  ///< "file.yaml:14:19", "--drop", "mesh.stl, facet 12"; empty: the call itself
  std::string what;   ///< the offending thing with its value: "friction_angle: 41 deg is steeper than ..."
  std::string why;    ///< the bound and its reason, one sentence; may be empty
  std::string hint;   ///< what to try, without the word "Try"; may be empty

  friend bool operator==(const Issue&, const Issue&) = default;
};

/// @return "where: what", then indented lines with the why and "Try: " the hint; no newline at the end
[[nodiscard]] std::string to_text(const Issue& issue);

/// Root of everything that Glissade throws; carries at least one issue, what() is all of them as text.
class Error : public std::runtime_error {
 public:
  explicit Error(std::vector<Issue> issues);
  explicit Error(Issue issue) : Error(std::vector<Issue>{std::move(issue)}) {}

  [[nodiscard]] const std::vector<Issue>& issues() const noexcept { return issues_; }

 private:
  std::vector<Issue> issues_;
};

/// An argument, option or design breaks its stated domain. Exit code 2.
class InputError : public Error {
  using Error::Error;
};

/// The input is well formed, but no track can do what it asks for. Exit code 3.
class InfeasibleError : public Error {
  using Error::Error;
};

/// An iteration ended without meeting its tolerance. Exit code 4.
class ConvergenceError : public Error {
  using Error::Error;
};

/// A file cannot be read or written, or is not of its format. Exit code 5.
class FileError : public Error {
  using Error::Error;
};

/// Work was asked to end before it was done. Exit code 130.
class Interrupted : public Error {
  using Error::Error;
};

/// A promise of Glissade's own is broken: a defect to report, never a matter of input. Exit code 70.
class InternalError : public Error {
  using Error::Error;
};

}  // namespace glissade
