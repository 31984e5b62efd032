#include "core/processor_time.hpp"

#include <chrono>
#include <ctime>

namespace glissade::core {

double processor_seconds() {
#ifdef CLOCK_THREAD_CPUTIME_ID
  std::timespec taken{};
  if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &taken) == 0)
    return static_cast<double>(taken.tv_sec) + 1e-9 * static_cast<double>(taken.tv_nsec);
#endif
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace glissade::core
