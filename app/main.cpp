#include "glissade/core/error.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"

#include <csignal>
#include <exception>
#include <new>
#include <string>

namespace {

using glissade::app::ExitCode;

int failed(const glissade::Error& error, ExitCode code) {
  glissade::app::print_problem(error);
  return static_cast<int>(code);
}

int defect(const std::string& what) {
  glissade::app::print_error(
      "glissade: defect: " + what +
      "\n      This is a fault of Glissade, not of your input. Please report it with the "
      "command and the design.\n");
  return static_cast<int>(ExitCode::defect);
}

}  // namespace

int main(int argc, char** argv) {
  glissade::app::reserve_standard_streams();
  // A closed pipe is noticed where it is written to, after files have been finished.
  std::signal(SIGPIPE, SIG_IGN);
  // So is a limit on the size of files: writing fails, and what was begun is removed.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return static_cast<int>(glissade::app::run(argc, argv));
  } catch (const glissade::InputError& error) {
    return failed(error, ExitCode::usage);
  } catch (const glissade::InfeasibleError& error) {
    return failed(error, ExitCode::infeasible);
  } catch (const glissade::ConvergenceError& error) {
    return failed(error, ExitCode::not_converged);
  } catch (const glissade::FileError& error) {
    return failed(error, ExitCode::file);
  } catch (const glissade::Interrupted& error) {
    return failed(error, ExitCode::interrupted);
  } catch (const std::bad_alloc&) {
    return failed(
        glissade::InputError(
            {"", "the memory of this machine does not suffice", "",
             "a larger mesh.tolerance where there is a mesh; less to read or to vary where there is none"}),
        ExitCode::usage);
  } catch (const std::exception& error) {
    return defect(error.what());
  }
}
