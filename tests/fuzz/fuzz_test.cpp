// fuzz_test.cpp -- each fuzzer takes its kept inputs and, for a second, damaged copies of them: `./dev fuzz` in
// small.

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <random>

#include "fuzz/fuzzer.h"

namespace insonify::fuzz_test {
namespace {

constexpr std::chrono::seconds kTime(1);
constexpr unsigned kLongest = 60;  // For one input, before it counts as endless [s].

// The input that is taken, for the handler of signals.
std::string taken, kept_as;

void keep_input(int signal) {
  const int file = open(kept_as.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  static_cast<void>(!write(file, taken.data(), taken.size()));
  static_cast<void>(!write(STDERR_FILENO, "The input is kept in ", 21));
  static_cast<void>(!write(STDERR_FILENO, kept_as.data(), kept_as.size()));
  static_cast<void>(!write(STDERR_FILENO, "\n", 1));
  std::signal(signal, SIG_DFL);
  raise(signal);
}

std::vector<std::string> inputs_of(const std::string& fuzzer) {
  const std::filesystem::path folder = INSONIFY_SOURCE_DIR "/tests/fuzz";
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "seeds" / fuzzer)) {
    files.push_back(entry.path());
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder / "found")) {
    if (entry.path().filename().string().starts_with(fuzzer + "-")) {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  std::vector<std::string> inputs;
  for (const std::filesystem::path& path : files) {
    std::ifstream file(path, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return inputs;
}

// Damages inputs by chance, the same on all machines.
class Damage {
 public:
  std::size_t up_to(std::size_t most) { return chance_() % (most + 1); }

  std::string of(std::string input, const std::string& other) {
    for (std::size_t changes = 1 + up_to(2); changes > 0 && !input.empty(); --changes) {
      change(input, other);
    }
    return input;
  }

 private:
  void change(std::string& input, const std::string& other) {
    const std::size_t at = up_to(input.size() - 1);
    switch (up_to(6)) {
      case 0:
        input[at] = static_cast<char>(static_cast<unsigned char>(input[at]) ^ 1U << up_to(7));
        break;
      case 1:
        input.replace(at, std::size_t{1} << up_to(3), std::size_t{1} << up_to(3), "\xff\x7f\0\x80"[up_to(3)]);
        break;
      case 2:
        input.resize(at);
        break;
      case 3:
        input.erase(at, 1 + up_to(20));
        break;
      case 4:
        input.insert(at, other.substr(up_to(other.size()), 1 + up_to(60)));
        break;
      case 5:
        input.insert(at, input.substr(up_to(input.size() - 1), 1 + up_to(60)));
        break;
      default:
        change_number(input, at);
    }
  }

  // The next number of a text.
  void change_number(std::string& input, std::size_t at) {
    constexpr const char* kNumbers[] = {"0", "-1", "1e999", "nan", "4294967296", "18446744073709551616", "", "1e-320"};
    const std::size_t start = input.find_first_of("0123456789", at);
    if (start != std::string::npos) {
      const std::size_t end = input.find_first_not_of("0123456789.e", start);
      input.replace(start, end - start, kNumbers[up_to(std::size(kNumbers) - 1)]);
    }
  }

  std::mt19937 chance_{7};
};

class FuzzTest : public testing::TestWithParam<fuzz::Fuzzer> {
 protected:
  FuzzTest() {
    // Small ones, so that no input takes long.
    setenv("INSONIFY_LIMITS", "memory=2e9 seconds=10 pixels=1e6 triangles=1e6 instances=1e4 nodes=1e5 bytes=1e8", 1);
    kept_as = (std::filesystem::current_path() / ("found-" + GetParam().name)).string();
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGALRM}) {
      std::signal(signal, keep_input);
    }
  }
  ~FuzzTest() override {
    alarm(0);
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGALRM}) {
      std::signal(signal, SIG_DFL);
    }
    unsetenv("INSONIFY_LIMITS");
  }

  static void take(const std::string& input) {
    taken = input;
    alarm(kLongest);
    GetParam().take({reinterpret_cast<const std::uint8_t*>(taken.data()), taken.size()});
  }
};

TEST_P(FuzzTest, WholeAndDamagedInputsAreTakenOrRefused) {
  const std::vector<std::string> inputs = inputs_of(GetParam().name);
  ASSERT_FALSE(inputs.empty());
  for (const std::string& input : inputs) {
    take(input);
  }
  const auto end = std::chrono::steady_clock::now() + kTime;
  Damage damage;
  int count = 0;
  for (; std::chrono::steady_clock::now() < end; ++count) {
    const std::string& other = inputs[damage.up_to(inputs.size() - 1)];
    take(damage.of(inputs[static_cast<std::size_t>(count) % inputs.size()], other));
  }
  EXPECT_GT(count, 0);
  RecordProperty("inputs", count);
  fmt::print("{} damaged inputs\n", count);
}

INSTANTIATE_TEST_SUITE_P(Of, FuzzTest, testing::ValuesIn(fuzz::fuzzers()),
                         [](const auto& fuzzer) { return fuzzer.param.name; });

}  // namespace
}  // namespace insonify::fuzz_test
