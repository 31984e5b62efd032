// libFuzzer target of the design reader: any bytes give a design that check() accepts, or an InputError or
// InfeasibleError with at least one issue. Inputs that ever broke that are kept in tests/corpus/design.

#include "glissade/design/design.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void read(std::string_view text) {
  using namespace glissade;
  try {
    const Design design = parse_design(text, "fuzz.yaml");
    require(check(design).empty());
  } catch (const InputError& error) {
    require(!error.issues().empty());
  } catch (const InfeasibleError& error) {
    require(!error.issues().empty());
  }
}

void read_override(std::string_view text) {
  using namespace glissade;
  const std::size_t split = text.find('=');
  if (split == std::string_view::npos) return;
  constexpr std::string_view kBase =
      "{glissade: 1, track: {start: {x: 0 m, z: 2 m}, finish: {x: 2 m, z: 0 m}}, body: {friction_angle: 9 "
      "deg}}";
  try {
    const Override change{std::string(text.substr(0, split)), std::string(text.substr(split + 1))};
    require(check(parse_design(kBase, "fuzz.yaml", {change})).empty());
  } catch (const InputError&) {
  } catch (const InfeasibleError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.starts_with("--set ")) {
    read_override(text.substr(6));
  } else {
    read(text);
  }
  return 0;
}
