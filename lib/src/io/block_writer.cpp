#include "io/block_writer.hpp"

#include <utility>

namespace glissade {

BlockWriter::BlockWriter(AtomicFile& file) : file_(file), filling_(kBlockBytes) {}

void BlockWriter::wait() {
  if (writing_.valid()) writing_.get();
}

void BlockWriter::next(std::size_t used) {
  wait();
  if (leaving_.empty()) leaving_.resize(kBlockBytes);
  std::swap(filling_, leaving_);
  writing_ = std::async(std::launch::async, [this, used] { file_.write(leaving_.data(), used); });
}

void BlockWriter::finish(std::size_t used) {
  wait();
  file_.write(filling_.data(), used);
}

}  // namespace glissade
