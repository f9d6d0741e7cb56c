// scenario_fuzzer.cpp -- reads any bytes as the YAML of a scenario.

#include "fuzz/fuzzer.h"
#include "insonify/files.h"

namespace insonify::scenario_fuzzer {
namespace {

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  static const std::filesystem::path world = file.write("world.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::filesystem::path path = file.write("scenario.yaml", fuzz::text_of(bytes));
  fuzz::expect_error_or_nothing([&] { static_cast<void>(load_scenario(path)); });
}

const fuzz::Listed kListed("scenario", take);

}  // namespace
}  // namespace insonify::scenario_fuzzer
