// libfuzzer.cpp -- gives the one fuzzer of this program the inputs of libFuzzer.

#include "fuzz/fuzzer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  insonify::fuzz::fuzzers().front().take({data, size});
  return 0;
}
