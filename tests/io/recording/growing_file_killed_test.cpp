// growing_file_killed_test.cpp -- a growing file is valid whenever its writer is killed.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <random>

#include "io/growing_rows.h"
#include "support/message_of.h"

namespace insonify::growing_file_killed_test {
namespace {

// Progress of a writer process, in memory shared with it.
struct Progress {
  std::atomic<std::uint64_t> started{0}, added{0};
};

// Runs a writer in a process of its own, and kills it some microseconds after it has begun a given number of rows.
template <typename Write>
void write_and_kill(Progress& progress, std::uint64_t rows_before, useconds_t moment, const Write& write) {
  const pid_t writer = fork();
  ASSERT_GE(writer, 0);
  if (writer == 0) {
    write();
    _exit(0);
  }
  while (progress.started < rows_before) {
    usleep(50);
  }
  usleep(moment);
  kill(writer, SIGKILL);
  int status = 0;
  waitpid(writer, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
}

class KilledTest : public testing::TestWithParam<Kind> {
 protected:
  KilledTest() {
    void* shared = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    EXPECT_NE(shared, MAP_FAILED);
    progress_ = new (shared) Progress;
  }
  ~KilledTest() override { munmap(progress_, sizeof(Progress)); }

  Progress* progress_;
};
INSTANTIATE_TEST_SUITE_P(Kinds, KilledTest, testing::ValuesIn(kKinds), [](const auto& test) {
  return std::string(test.param == Kind::kPlain ? "Plain" : "Compressed");
});

TEST_P(KilledTest, FileIsWholeWheneverItsWriterIsKilled) {
  constexpr int kKills = 60;
  constexpr std::uint64_t kMost = 3'000'000;  // Cells still fit 32 bits.
  const std::string folder = GetParam() == Kind::kPlain ? "killed" : "killed_compressed";
  std::mt19937 random(20240607);
  int killed_while_recording = 0;
  for (int kill_number = 0; kill_number < kKills; ++kill_number) {
    const auto path = place_for(folder);
    progress_->started = progress_->added = 0;
    const std::uint64_t rows_before =
        random() % 8 == 0 ? 0 : random() % 200;  // Some writers die while the file is being created.
    const auto moment = static_cast<useconds_t>(random() % 2000);
    write_and_kill(*progress_, rows_before, moment, [&] {
      GrowingFile file = make_file(path, GetParam());
      Row row(0);
      for (std::uint64_t number = 0; number < kMost; ++number) {
        row.set(number);
        progress_->started = number + 1;
        row.append_to(file);
        progress_->added = number + 1;
      }
    });
    const bool is_there = std::filesystem::exists(path);
    EXPECT_TRUE(is_there || progress_->started == 0);
    if (is_there) {
      const std::uint64_t rows = whole_rows(path, GetParam());
      EXPECT_GE(rows, progress_->added);
      EXPECT_LE(rows, progress_->started);
      // No larger than its contents and the hole at its end.
      EXPECT_LT(std::filesystem::file_size(path), 300'000 + (rows + 1) * (7208 + 2 * 2 * 64));
      ++killed_while_recording;
    }
    ASSERT_FALSE(HasFailure()) << "kill " << kill_number << " after " << progress_->added << " rows";
  }
  EXPECT_GT(killed_while_recording, kKills / 2);
}

// An existing file stays; new rows are in a file beside it.
TEST_P(KilledTest, EarlierFileStaysWheneverTheWriterOfTheNextIsKilled) {
  const std::string folder = GetParam() == Kind::kPlain ? "killed_over" : "killed_over_compressed";
  std::mt19937 random(8);
  for (int kill_number = 0; kill_number < 30; ++kill_number) {
    const auto path = place_for(folder);
    record(path, 3, GetParam());
    progress_->started = progress_->added = 0;
    write_and_kill(*progress_, random() % 50, static_cast<useconds_t>(random() % 2000), [&] {
      GrowingFile file = make_file(path, GetParam(), true);
      for (std::uint64_t number = 0;; ++number) {
        progress_->started = number + 1;
        Row(number).append_to(file);
        progress_->added = number + 1;
      }
    });
    EXPECT_EQ(whole_rows(path, GetParam()), 3U);
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
      if (entry.path() != path && progress_->started > 0) {
        EXPECT_GE(whole_rows(entry.path(), GetParam()), progress_->added);
      }
    }
    ASSERT_FALSE(HasFailure()) << "kill " << kill_number;
  }
}

// Consecutive recordings of a few rows, some killed while the last one is being closed. Each replaces the one before,
// or takes a free path and is readable there while it grows.
TEST_P(KilledTest, FileIsWholeWhileItIsBeingClosed) {
  constexpr int kKills = 40;
  const auto path = place_for(GetParam() == Kind::kPlain ? "closing" : "closing_compressed");
  record(path, 66, GetParam());
  std::mt19937 random(7);
  for (int kill_number = 0; kill_number < kKills; ++kill_number) {
    progress_->started = 0;
    const bool replace = kill_number % 2 == 0;
    write_and_kill(*progress_, 66 + random() % 100, static_cast<useconds_t>(random() % 3000), [&] {
      for (;;) {
        if (!replace) {
          std::filesystem::remove(path);
        }
        GrowingFile file = make_file(path, GetParam(), replace);
        for (std::uint64_t number = 0; number < 66; ++number) {  // Two nodes of the index: closing links them.
          Row(number).append_to(file);
          ++progress_->started;
        }
        file.close();
      }
    });
    if (std::filesystem::exists(path)) {
      const std::uint64_t rows = whole_rows(path, GetParam());
      EXPECT_TRUE(replace ? rows == 66 : rows <= 66) << rows;
    } else {
      EXPECT_FALSE(replace);
      record(path, 66, GetParam());
    }
    ASSERT_FALSE(HasFailure()) << "kill " << kill_number;
  }
}

}  // namespace
}  // namespace insonify::growing_file_killed_test
