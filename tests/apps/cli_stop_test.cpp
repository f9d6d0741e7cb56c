// cli_stop_test.cpp -- runs that are stopped or killed keep what they have.

#include <sys/stat.h>

#include <random>

#include "apps/cli.h"
#include "io/h5_read.h"

namespace insonify::cli_stop_test {
namespace {

using testing::ElementsAre;

class CliStopTest : public CliTest {
 protected:
  static std::uint64_t recorded(const std::filesystem::path& file) { return H5Reader(file).shape("time").at(0); }

  static void wait_for_pings(const std::filesystem::path& file) {
    Process::wait_until([&] { return std::filesystem::exists(file) && recorded(file) > 1; });
  }
};

TEST_F(CliStopTest, CtrlCEndsARunAndDrawsTheLastPing) {
  const Process process({"run", "fan.yaml", "-o", "out", "--pings", "100000", "--pictures", "1", "--no-view"});
  wait_for_pings("out/ahead.h5");
  process.send(SIGINT);
  const Outcome outcome = process.end();
  EXPECT_EQ(outcome.status, 1);
  const std::uint64_t pings = recorded("out/ahead.h5");
  EXPECT_EQ(outcome.err, fmt::format("insonify: stopped after {} of 100000 pings; they are kept\n", pings));
  EXPECT_THAT(files("out"), ElementsAre("ahead.h5", fmt::format("ahead_fan_{:04}.png", pings - 1),
                                        fmt::format("ahead_polar_{:04}.png", pings - 1)));
  // Per ping 40 x 16 cells of 12 bytes, a time, a pose and their chunk index; about 90 kB for everything of fixed size.
  EXPECT_LT(std::filesystem::file_size("out/ahead.h5"), 120'000 + pings * 9000);
}

TEST_F(CliStopTest, AForcedRunThatIsStoppedReplacesTheEarlierOne) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q").status, 0);
  const Process process({"run", "fan.yaml", "-o", "out", "--pings", "100000", "--no-pictures", "--force"});
  const auto beside = [this] {
    for (const std::string& file : files("out")) {
      if (file.ends_with(".new") && std::filesystem::is_regular_file("out/" + file)) {
        return std::filesystem::path("out") / file;
      }
    }
    return std::filesystem::path();
  };
  // Seven pictures and a recording of the earlier run, a recording of some forty pings and a folder of this one.
  Process::wait_until([&] { return files("out").size() == 10 && std::filesystem::file_size(beside()) > 500'000; });
  EXPECT_EQ(recorded("out/ahead.h5"), 3U);
  process.send(SIGINT);
  const Outcome outcome = process.end();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(files("out"), ElementsAre("ahead.h5"));
  EXPECT_EQ(outcome.err,
            fmt::format("insonify: stopped after {} of 100000 pings; they are kept, instead of the earlier run's\n",
                        recorded("out/ahead.h5")));
}

// Each ping of this scenario would take many seconds.
TEST_F(CliStopTest, CtrlCEndsAPingThatTakesLong) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-8, 8);
  std::string mesh;
  for (int i = 0; i < 6'000; ++i) {
    mesh += fmt::format("v {:.3f} {:.3f} {:.3f}\n", place(random), place(random), place(random));
  }
  for (int i = 1; i < 6'000; i += 3) {
    mesh += fmt::format("f {} {} {}\n", i, i + 1, i + 2);
  }
  folder.write("dense.obj", mesh);
  const std::vector<std::vector<std::string>> heavy = {
      {"--engine", "reference", "--set", "world=dense.obj", "--set", "sampling={columns_per_beam: 64, rows: 2000}"},
      {"--engine", "cpu", "--set", "world=dense.obj", "--set", "sampling={columns_per_beam: 256, rows: 8192}"}};
  for (std::size_t i = 0; i < heavy.size(); ++i) {
    const std::filesystem::path out = fmt::format("out_{}", i);
    std::vector<std::string> words = {"run", "fan.yaml", "-o", out, "--no-pictures"};
    words.insert(words.end(), heavy[i].begin(), heavy[i].end());
    const Process process(words);
    Process::wait_until([&] { return std::filesystem::exists(out / "ahead.h5"); });
    usleep(500'000);
    process.send(SIGINT);
    const Outcome outcome = process.end();
    EXPECT_EQ(outcome.status, 1);
    // It would say "stopped after 1 of 3 pings" if the ping had been made to its end.
    EXPECT_TRUE(outcome.err.ends_with("insonify: interrupted before the first ping\n")) << outcome.err;
    EXPECT_TRUE(std::filesystem::is_empty(out));
  }
}

// Pings are made in the order of their times: each sonar has made all before the time of the stop, and none after it.
TEST_F(CliStopTest, RecordingsOfSeveralSonarsThatAreStoppedEndAtTheSameTime) {
  const std::vector<double> periods = {0.3, 0.05, 1};
  std::string yaml = "world: floor.obj\nsonars:\n";
  for (std::size_t i = 0; i < periods.size(); ++i) {
    yaml += fmt::format(
        "  - {{name: s{}, beam_count: 16, bin_count: 40, max_range: 12, orientation_deg: [0, 20, 0], ping_period: {}, "
        "sampling: {{columns_per_beam: 2, rows: 20}}}}\n",
        i, periods[i]);
  }
  folder.write("three.yaml", yaml);
  const Process process({"run", "three.yaml", "-o", "out", "--pings", "100000", "--no-pictures", "-q"});
  wait_for_pings("out/s2.h5");
  Process::wait_until([&] { return recorded("out/s2.h5") > 3; });
  process.send(SIGINT);
  EXPECT_EQ(process.end().status, 1);
  const double next = static_cast<double>(recorded("out/s1.h5")) * periods[1];
  EXPECT_GT(next, 2.9);
  for (std::size_t i = 0; i < periods.size(); ++i) {
    const double next_of_sonar = static_cast<double>(recorded(fmt::format("out/s{}.h5", i))) * periods[i];
    EXPECT_NEAR(next_of_sonar, next, periods[i] + 1e-6) << i;
  }
}

TEST_F(CliStopTest, CtrlCLeavesWhatAHeadHasSeen) {
  const Process process({"run", "scan.yaml", "-o", "out", "--pings", "100000", "--pictures", "1", "--no-view"});
  wait_for_pings("out/around.h5");
  process.send(SIGINT);
  EXPECT_EQ(process.end().status, 1);
  EXPECT_THAT(files("out"), ElementsAre("around.h5", "around_polar.png", "around_scan.png"));
}

// A pipe without a writer stands in for a world that takes long to load.
TEST_F(CliStopTest, CtrlCWhileLoadingEndsAtOnce) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::filesystem::remove("pipe");
    ASSERT_EQ(mkfifo("pipe", 0600), 0);
    const Process process({"run", "pipe", "-o", "out"});
    Process::wait_until([] { return text_of("process.out") == "reading the scenario from pipe, a pipe\n"; });
    process.send(signal);
    const Outcome outcome = process.end();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err, "insonify: interrupted before the first ping\n");
    EXPECT_FALSE(std::filesystem::exists("out"));
  }
}

// Half a million triangles as large as the scene, one behind the other: a view of them takes minutes.
TEST_F(CliStopTest, CtrlCWhileTheSceneIsDrawnEndsAtOnce) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-20, 20);
  std::string mesh;
  for (int i = 0; i < 6'000; ++i) {
    mesh += fmt::format("v {:.3f} {:.3f} {:.3f}\n", place(random), place(random), place(random));
  }
  for (int i = 1; i < 6'000; i += 3) {
    mesh += fmt::format("f {} {} {}\n", i, i + 1, i + 2);
  }
  folder.write("dense.obj", mesh);
  const Process process({"run", "fan.yaml", "-o", "out", "--set", "world=dense.obj", "--height", "8192"});
  Process::wait_until([] { return std::filesystem::exists("out"); });
  process.send(SIGINT);
  const Outcome outcome = process.end();
  EXPECT_EQ(outcome.status, 1);
  // A slow start may have warned before of the edges that are too many.
  EXPECT_TRUE(outcome.err.ends_with("insonify: interrupted before the first ping\n")) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_empty("out"));
}

TEST_F(CliStopTest, ASecondRunIntoTheSameFolderIsRefused) {
  const Process first({"run", "fan.yaml", "-o", "out", "--pings", "100000", "--no-pictures"});
  wait_for_pings("out/ahead.h5");
  EXPECT_EQ(shell("insonify run fan.yaml -o out").status, 2);
  const Outcome second = shell("insonify run fan.yaml -o out --force");
  EXPECT_EQ(second.status, 1);
  EXPECT_EQ(second.err, "insonify: out/ahead.h5: cannot create: another run is writing it; choose another folder\n");
  first.send(SIGINT);
  EXPECT_EQ(first.end().status, 1);
  EXPECT_THAT(files("out"), ElementsAre("ahead.h5"));
  EXPECT_EQ(shell("insonify run fan.yaml -o out -q --force").status, 0);
}

TEST_F(CliStopTest, ARunWhoseFolderIsRemovedFails) {
  for (const std::string gone : {"rm -r out", "mv out elsewhere"}) {
    const Process process({"run", "fan.yaml", "-o", "out", "--pings", "100000", "--no-pictures"});
    wait_for_pings("out/ahead.h5");
    ASSERT_EQ(shell(gone).status, 0);
    const Outcome outcome = process.end();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(
        outcome.err,
        "insonify: out/ahead.h5: no longer exists: it was removed, moved or replaced while it was being written\n");
  }
}

// Ignored, as in a background job of a shell. To open the pipe waits until the program reads from it.
TEST_F(CliStopTest, CtrlCThatWasIgnoredStaysSo) {
  const Outcome outcome =
      shell("mkfifo pipe; (trap '' INT; exec bash -c 'exec \"$0\" run pipe -o out --no-pictures' " INSONIFY_CLI
            ") & exec 3> pipe; kill -INT $!; cat fan.yaml >&3; exec 3>&-; wait $!");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(CliStopTest, ARunThatIsKilledAtAnyMomentLeavesARecordingThatOpens) {
  std::mt19937 random(20250117);
  const std::filesystem::path recording = "out/ahead.h5";
  for (int i = 0; i < 30; ++i) {
    // Kills runs at random moments: over an earlier recording, which must stay, and while a new one grows.
    const bool grows = i % 3 != 0;
    if (grows) {
      std::filesystem::remove(recording);
    }
    std::vector<std::string> words = {"run", "fan.yaml", "-q", "-o", "out", "--no-pictures", "--pings", "100000"};
    if (i % 2 == 0) {
      words.emplace_back("--compress");
    }
    if (!grows) {
      words.emplace_back("--force");
    }
    const Process process(words);
    if (grows) {
      wait_for_pings(recording);
    }
    usleep(static_cast<useconds_t>(random() % 6'000));
    process.send(SIGKILL);
    EXPECT_EQ(process.end().status, -1);
    if (!std::filesystem::exists(recording)) {
      EXPECT_FALSE(grows);
      continue;
    }
    const H5Reader file(recording);
    const std::uint64_t pings = file.shape("time").at(0);
    EXPECT_GE(pings, grows ? 1U : 0U);
    EXPECT_EQ(file.shape("intensity"), (std::vector<hsize_t>{pings, 40, 16}));
    EXPECT_EQ(file.shape("instance"), (std::vector<hsize_t>{pings, 40, 16}));
    EXPECT_EQ(file.shape("world_from_sonar"), (std::vector<hsize_t>{pings, 7}));
    if (pings > 0) {
      // The last ping is complete: the floor fills the same bins in every ping.
      EXPECT_EQ(file.row<std::uint16_t>("instance", pings - 1), file.row<std::uint16_t>("instance", 0));
      EXPECT_EQ(file.row<double>("world_from_sonar", pings - 1), file.row<double>("world_from_sonar", 0));
    }
  }
}

}  // namespace
}  // namespace insonify::cli_stop_test
