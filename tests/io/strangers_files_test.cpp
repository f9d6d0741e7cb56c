// strangers_files_test.cpp -- what crashes, hangs or swells over a file is a process of its own; here it is an Error.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "insonify/files.h"
#include "insonify/recorded_pings.h"
#include "io/file/hdf5.h"
#include "io/file/reader_process.h"
#include "io/mesh_texts.h"
#include "support/message_of.h"
#include "support/picture_files.h"
#include "support/sanitized.h"
#include "support/working_folder.h"

namespace insonify::strangers_files_test {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

// Sets a variable of the environment for as long as it lives.
class Setting {
 public:
  Setting(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Setting() { unsetenv(name_); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
};

// Children of this thread, also those that have ended and were not waited for.
std::vector<pid_t> children() {
  std::ifstream list("/proc/thread-self/children");
  return {std::istream_iterator<pid_t>(list), {}};
}

std::size_t open_files() {
  const std::filesystem::directory_iterator files("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// COLLADA files on which assimp 5.2 reads beyond its memory; 5.4 sees that.
TEST(StrangersFilesTest, ACrashIsOneMessage) {
  if (kSanitized) {
    GTEST_SKIP() << "A sanitizer ends the reader by an exit status, and has no limit of memory";
  }
  const WorkingFolder folder;
  const std::size_t files_before = open_files();
  const std::string crash = "a.dae: the reader of DAE files crashed (SIGSEGV)";
  for (const std::string& text : {changed(dae_text(), "stride=\"3\"", "stride=\"1000000\""),
                                  changed(dae_text(), "source=\"#a\" count=", "source=\"#a\" offset=\"100000\" count="),
                                  changed(dae_text(), "id=\"a\" count=\"12\"", "id=\"a\" count=\"0\"")}) {
    folder.write("a.dae", text);
    EXPECT_THAT(message_of([] { (void)load_mesh("a.dae"); }),
                AnyOf(crash, "a.dae: cannot be read: Not enough data for accessor"));
  }
  EXPECT_THAT(children(), IsEmpty());
  EXPECT_EQ(open_files(), files_before);
}

TEST(StrangersFilesTest, TheNextFileIsReadByANewProcess) {
  if (kSanitized) {
    GTEST_SKIP() << "A sanitizer ends the reader by an exit status, and has no limit of memory";
  }
  const WorkingFolder folder;
  const Setting limits("INSONIFY_LIMITS", "memory=5e8");
  folder.write("bad.dae", changed(dae_text(), "<p>0 2 1", "<p>0 1 x"));
  folder.write("good.dae", dae_text());
  const std::size_t files_before = open_files();
  {
    const SharedReader reader;
    EXPECT_EQ(load_mesh("good.dae").triangles.size(), 4U);
    const std::vector<pid_t> first = children();
    EXPECT_EQ(load_mesh("good.dae").triangles.size(), 4U);
    EXPECT_EQ(children(), first);
    EXPECT_EQ(message_of([] { (void)load_mesh("bad.dae"); }),
              "bad.dae: the reader of DAE files needed more than 0.5 GB");
    EXPECT_EQ(load_mesh("good.dae").triangles.size(), 4U);
    EXPECT_EQ(children().size(), 1U);
    EXPECT_NE(children(), first);
  }
  EXPECT_THAT(children(), IsEmpty());
  EXPECT_EQ(open_files(), files_before);
}

TEST(StrangersFilesTest, MemoryHasALimit) {
  if (kSanitized) {
    GTEST_SKIP() << "A sanitizer ends the reader by an exit status, and has no limit of memory";
  }
  const WorkingFolder folder;
  const Setting limits("INSONIFY_LIMITS", "memory=5e8");
  folder.write("a.dae", changed(dae_text(), "<p>0 2 1", "<p>0 1 x"));
  EXPECT_EQ(message_of([] { (void)load_mesh("a.dae"); }), "a.dae: the reader of DAE files needed more than 0.5 GB");
}

// assimp looks each of many materials up in a list of them.
TEST(StrangersFilesTest, ProcessorTimeHasALimit) {
  const WorkingFolder folder;
  std::string materials, obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 60'000; ++i) {
    materials += fmt::format("newmtl a_long_name_of_a_material_{}\n", i);
    obj += fmt::format("usemtl a_long_name_of_a_material_{}\nf 1 2 3\n", i);
  }
  folder.write("a.mtl", materials);
  folder.write("a.obj", obj);
  const Setting limits("INSONIFY_LIMITS", "memory=4e9 seconds=1");
  EXPECT_THAT(message_of([] { (void)load_mesh("a.obj"); }),
              AnyOf("a.obj: the reader of OBJ files took longer than 2 s of processor time",
                    "a.obj: the reader of OBJ files took longer than 20 s"));  // Where ten others compute.
}

TEST(StrangersFilesTest, LimitsMustBeNumbers) {
  const WorkingFolder folder;
  folder.write("a.obj", obj_text());
  for (const std::string word :
       {"much", "memory", "memory=", "memory=0", "memory=-1", "memory=1x", "memory=nan", "memory=1e19", "rooms=4"}) {
    const Setting limits("INSONIFY_LIMITS", "seconds=9 " + word);
    EXPECT_EQ(message_of([] { (void)load_mesh("a.obj"); }), "INSONIFY_LIMITS: " + word +
                                                                " must be KEY=NUMBER, with a number from 1 to 1e18 and "
                                                                "a key of bytes, pixels, nodes, instances, triangles, "
                                                                "memory, seconds");
  }
}

TEST(StrangersFilesTest, EndlessFilesAreRefused) {
  if (kSanitized) {
    GTEST_SKIP() << "A sanitizer ends the reader by an exit status, and has no limit of memory";
  }
  const WorkingFolder folder;
  const Setting limits("INSONIFY_LIMITS", "memory=4e8 seconds=5");
  for (const char* name : {"a.obj", "a.stl", "a.dae", "a.ply", "a.gltf", "a.glb", "a.png", "a.bag", "a.asc", "a.h5"}) {
    std::filesystem::create_symlink("/dev/zero", name);
    EXPECT_THAT(message_of([&] {
                  if (std::string(name) == "a.h5") {
                    (void)RecordedPings(name);
                  } else {
                    (void)load_scene(name);
                  }
                }),
                StartsWith(std::string(name) + ": "));
  }
  EXPECT_THAT(message_of([] { (void)load_grey_picture("a.png"); }), StartsWith("a.png: "));
}

// Whatever happens to the process: programs that stand for it.
TEST(StrangersFilesTest, TheEndOfTheProcessIsTold) {
  const WorkingFolder folder;
  folder.write("a.obj", obj_text());
  const auto message_with = [&](const std::string& program) {
    folder.write("reader", "#!/bin/sh\n" + program + "\n");
    std::filesystem::permissions("reader", std::filesystem::perms::owner_all);
    const Setting reader("INSONIFY_READER", (folder.path() / "reader").string());
    return message_of([] { (void)load_mesh("a.obj"); });
  };
  EXPECT_EQ(message_with("kill -9 $$"), "a.obj: the reader of OBJ files was killed (SIGKILL)");
  EXPECT_EQ(message_with("kill -ABRT $$"), "a.obj: the reader of OBJ files crashed (SIGABRT)");
  EXPECT_EQ(message_with("exit 3"), "a.obj: the reader of OBJ files did not work: insonify-read ended with status 3");
  const Setting reader("INSONIFY_READER", "/none/insonify-read");
  EXPECT_EQ(message_of([] { (void)load_mesh("a.obj"); }),
            "a.obj: the reader of OBJ files, /none/insonify-read, cannot be started: No such file or directory");
  EXPECT_THAT(children(), IsEmpty());
}

// ---------------------------------------------------------------- Recordings

TEST(StrangersRecordingTest, IsReadAgainAfterItsReaderWasKilled) {
  const WorkingFolder folder;
  write_intensity("a.h5", {2, 1, 3}, H5T_STD_U8LE, {0, 100, 255, 1, 2, 3});
  const std::size_t files_before = open_files();
  {
    const RecordedPings pings("a.h5");
    EXPECT_THAT(pings.intensity(1), ElementsAre(1, 2, 3));
    ASSERT_EQ(children().size(), 1U);
    kill(children().front(), SIGKILL);
    EXPECT_EQ(message_of([&] { (void)pings.intensity(1); }), "a.h5: the reader of HDF5 files was killed (SIGKILL)");
    EXPECT_THAT(pings.intensity(0), ElementsAre(0, 100, 255));
  }
  EXPECT_THAT(children(), IsEmpty());
  EXPECT_EQ(open_files(), files_before);
}

TEST(StrangersRecordingTest, IsReadInAForkOfTheProcess) {
  const WorkingFolder folder;
  write_intensity("a.h5", {2, 1, 3}, H5T_STD_U8LE, {0, 100, 255, 1, 2, 3});
  const RecordedPings pings("a.h5");
  const pid_t fork_of_this = fork();
  if (fork_of_this == 0) {
    _exit(pings.intensity(1) == std::vector<double>{1, 2, 3} ? 7 : 8);
  }
  EXPECT_THAT(pings.intensity(0), ElementsAre(0, 100, 255));
  int status = 0;
  waitpid(fork_of_this, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST(StrangersRecordingTest, ThreadsTakeTurns) {
  const WorkingFolder folder;
  write_intensity("a.h5", {2, 1, 3}, H5T_STD_U8LE, {0, 100, 255, 1, 2, 3});
  const RecordedPings pings("a.h5");
  const auto read_often = [&](std::uint64_t ping, const std::vector<double>& wanted) {
    for (int i = 0; i < 200; ++i) {
      ASSERT_EQ(pings.intensity(ping), wanted);
    }
  };
  std::thread other([&] { read_often(1, {1, 2, 3}); });
  read_often(0, {0, 100, 255});
  other.join();
}

// HDF5 would read the values of a dataset from whatever file that names.
TEST(StrangersRecordingTest, OtherFilesAreNotOpened) {
  const WorkingFolder folder;
  folder.write("secret", "abc");
  write_intensity("secret.h5", {1, 1, 3}, H5T_STD_U8LE, {1, 2, 3});
  const hsize_t shape[] = {1, 1, 3};
  const H5Handle space(H5Screate_simple(3, shape, nullptr), H5Sclose);
  const auto message_with = [&](const std::function<void(hid_t file, hid_t layout)>& make) {
    {
      const H5Handle file(H5Fcreate("a.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
      const H5Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      make(file.get(), layout.get());
    }
    return message_of([] { (void)RecordedPings("a.h5"); });
  };
  const auto set = [&](hid_t file, hid_t layout) {
    H5Dclose(H5Dcreate2(file, "intensity", H5T_STD_U8LE, space.get(), H5P_DEFAULT, layout, H5P_DEFAULT));
  };
  const std::string elsewhere = "a.h5: intensity has its values in other files, which are not read";
  EXPECT_EQ(message_with([&](hid_t file, hid_t layout) {
              H5Pset_external(layout, "secret", 0, 3);
              set(file, layout);
            }),
            elsewhere);
  EXPECT_EQ(message_with([&](hid_t file, hid_t layout) {
              H5Pset_virtual(layout, space.get(), "secret.h5", "intensity", space.get());
              set(file, layout);
            }),
            elsewhere);
  EXPECT_EQ(message_with([&](hid_t file, hid_t) {
              H5Lcreate_external("secret.h5", "intensity", file, "intensity", H5P_DEFAULT, H5P_DEFAULT);
            }),
            "a.h5: intensity is a link to another file, which is not read");
  EXPECT_THAT(message_with([&](hid_t file, hid_t) {
                H5Lcreate_external("secret.h5", "/", file, "other", H5P_DEFAULT, H5P_DEFAULT);
                H5Lcreate_soft("other/intensity", file, "intensity", H5P_DEFAULT, H5P_DEFAULT);
              }),
              StartsWith("a.h5: cannot "));
}

TEST(StrangersRecordingTest, OtherFilesAreNotOpenedForAGridEither) {
  const WorkingFolder folder;
  {
    const H5Handle file(H5Fcreate("a.bag", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    H5Lcreate_external("secret.bag", "BAG_root", file.get(), "BAG_root", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_EQ(message_of([] { (void)load_height_grid("a.bag"); }),
            "a.bag: /BAG_root/elevation is a link to another file, which is not read");
}

}  // namespace
}  // namespace insonify::strangers_files_test
