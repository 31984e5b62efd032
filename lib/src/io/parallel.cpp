#include "io/parallel.hpp"

#include "glissade/core/stop.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace glissade::io {
namespace {

// A block stays in the cache of the core that formats it until the system has copied it.
constexpr std::size_t kBlockBytes = std::size_t{1} << 20U;
// More threads than this wait for each other: copying to the system is one after the other.
constexpr std::size_t kMostThreads = 8;

std::size_t thread_count() {
  return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostThreads);
}

class OrderedWriting {
 public:
  OrderedWriting(AtomicFile& file, const BlockPlan& plan, const std::stop_token& stop)
      : file_(file),
        plan_(plan),
        stop_(stop),
        items_per_block_(std::max<std::size_t>(1, kBlockBytes / plan.most_bytes_per_item)),
        bytes_per_block_(items_per_block_ * plan.most_bytes_per_item + kBytesBeyondBlock),
        blocks_((plan.items + items_per_block_ - 1) / items_per_block_) {}

  void run() {
    {
      std::vector<std::jthread> helpers;
      for (std::size_t i = 1; i < std::min(thread_count(), blocks_); ++i)
        helpers.emplace_back([this] { work(); });
      work();
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void work() {
    try {
      const auto block = std::make_unique_for_overwrite<char[]>(bytes_per_block_);
      while (const std::optional<std::size_t> number = take()) {
        require_going(stop_);
        const std::size_t first = *number * items_per_block_;
        const std::size_t last = std::min(first + items_per_block_, plan_.items);
        const char* const end = plan_.format(first, last, block.get());
        if (!wait_for_turn(*number)) return;
        file_.write(block.get(), static_cast<std::size_t>(end - block.get()));
        pass_turn();
      }
    } catch (...) {
      fail(std::current_exception());
    }
  }

  [[nodiscard]] std::optional<std::size_t> take() {
    const std::scoped_lock lock(mutex_);
    if (failure_ || taken_ == blocks_) return std::nullopt;
    return taken_++;
  }

  /// @return false if another thread failed: the block will never have its turn
  [[nodiscard]] bool wait_for_turn(std::size_t number) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || written_ == number; });
    return !failure_;
  }

  void pass_turn() {
    {
      const std::scoped_lock lock(mutex_);
      ++written_;
    }
    changed_.notify_all();
  }

  void fail(const std::exception_ptr& failure) {
    {
      const std::scoped_lock lock(mutex_);
      if (!failure_) failure_ = failure;
    }
    changed_.notify_all();
  }

  AtomicFile& file_;
  const BlockPlan& plan_;
  const std::stop_token& stop_;
  std::size_t items_per_block_;
  std::size_t bytes_per_block_;
  std::size_t blocks_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t taken_ = 0;
  std::size_t written_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

void write_in_order(AtomicFile& file, const BlockPlan& plan, const std::stop_token& stop) {
  OrderedWriting(file, plan, stop).run();
}

void in_ranges(std::size_t count, const std::function<void(std::size_t first, std::size_t last)>& work,
               const std::stop_token& stop) {
  constexpr std::size_t kItemsBetweenPauses = std::size_t{1} << 16U;  // taste: a millisecond or less
  // A thread takes some 30 us to start, items some 3 ns each: it must have far more of them to be worth it.
  constexpr std::size_t kWorthAThread = 100'000;
  const std::size_t ranges = std::clamp<std::size_t>(count / kWorthAThread, 1, thread_count());
  const auto share = [&](std::size_t first, std::size_t last) {
    do {
      require_going(stop);
      const std::size_t pause = std::min(first + kItemsBetweenPauses, last);
      work(first, pause);
      first = pause;
    } while (first < last);
  };
  std::vector<std::future<void>> others;
  for (std::size_t i = 1; i < ranges; ++i) {
    others.push_back(std::async(std::launch::async, share, i * count / ranges, (i + 1) * count / ranges));
  }
  share(0, count / ranges);
  for (std::future<void>& other : others) other.get();
}

void each_in_turn(std::size_t count, const std::function<void(std::size_t)>& begin,
                  const std::function<void(std::size_t)>& work) {
  std::mutex mutex;
  std::size_t next = 0;
  std::size_t failed = count;
  std::exception_ptr failure;
  const auto take = [&](std::size_t& at) {
    const std::scoped_lock lock(mutex);
    if (failure || next == count) return false;
    at = next++;
    begin(at);
    return true;
  };
  const auto run = [&] {
    std::size_t at = 0;
    try {
      while (take(at)) work(at);
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!failure || at < failed) {
        failure = std::current_exception();
        failed = at;
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min(thread_count(), count); ++i) helpers.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace glissade::io
