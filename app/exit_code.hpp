#pragma once

namespace glissade::app {

/// What the program's end says; docs/cli.md lists them.
enum class ExitCode {
  done = 0,
  faulty = 1,         ///< the inspected object is faulty
  usage = 2,          ///< an option, an argument or a design is wrong
  infeasible = 3,     ///< no track does what was asked, or the body does not arrive on it
  not_converged = 4,  ///< an iteration ended without meeting its tolerance
  file = 5,           ///< a file cannot be read or written
  defect = 70,        ///< Glissade's own fault
  interrupted = 130,  ///< ended by Ctrl-C
};

}  // namespace glissade::app
