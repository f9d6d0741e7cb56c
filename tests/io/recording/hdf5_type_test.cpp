// hdf5_type_test.cpp -- datatypes that HDF5 writes pass, and none that is cut or does not fit.

#include "io/file/hdf5_type.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::hdf5_type_test {
namespace {

H5Handle own(hid_t type) {
  return {type, H5Tclose};
}

struct Pair {
  double level;
  std::int16_t beam;
};

// A type of every class that has parts, and some that have none.
std::vector<std::pair<std::string, H5Handle>> types() {
  std::vector<std::pair<std::string, H5Handle>> all;
  all.emplace_back("integer", own(H5Tcopy(H5T_STD_U16BE)));
  all.emplace_back("float", own(H5Tcopy(H5T_IEEE_F32LE)));
  all.emplace_back("bits", own(H5Tcopy(H5T_STD_B8LE)));
  all.emplace_back("reference", own(H5Tcopy(H5T_STD_REF_OBJ)));
  H5Handle text = own(H5Tcopy(H5T_C_S1));
  H5Tset_size(text.get(), 7);
  all.emplace_back("text", std::move(text));
  H5Handle texts = own(H5Tcopy(H5T_C_S1));
  H5Tset_size(texts.get(), H5T_VARIABLE);
  H5Handle opaque = own(H5Tcreate(H5T_OPAQUE, 5));
  H5Tset_tag(opaque.get(), "a tag");
  all.emplace_back("opaque", std::move(opaque));
  H5Handle words = own(H5Tenum_create(H5T_STD_I16LE));
  for (const std::int16_t value : {std::int16_t{1}, std::int16_t{-7}, std::int16_t{300}}) {
    H5Tenum_insert(words.get(), ("word number " + std::to_string(value)).c_str(), &value);
  }
  const hsize_t shape[] = {3, 2};
  H5Handle array = own(H5Tarray_create2(words.get(), 2, shape));
  H5Handle compound = own(H5Tcreate(H5T_COMPOUND, sizeof(Pair)));
  H5Tinsert(compound.get(), "level", HOFFSET(Pair, level), H5T_NATIVE_DOUBLE);
  H5Tinsert(compound.get(), "beam", HOFFSET(Pair, beam), H5T_NATIVE_INT16);
  H5Handle with_array = own(H5Tcreate(H5T_COMPOUND, 400));
  H5Tinsert(with_array.get(), "grid", 100, array.get());
  H5Tinsert(with_array.get(), "pair", 300, compound.get());
  all.emplace_back("words", std::move(words));
  all.emplace_back("array", std::move(array));
  all.emplace_back("list", own(H5Tvlen_create(compound.get())));
  all.emplace_back("compound", std::move(compound));
  all.emplace_back("compound of an array", std::move(with_array));
  all.emplace_back("texts", std::move(texts));
  return all;
}

// The message of a type, as a file has it.
std::vector<char> message_of_type(const H5Handle& type) {
  std::size_t size = 0;
  H5Tencode(type.get(), nullptr, &size);
  std::vector<char> bytes(size);
  H5Tencode(type.get(), bytes.data(), &size);
  return {bytes.begin() + 2, bytes.end()};  // After a number for "datatype" and a version.
}

TEST(DatatypeFaultTest, WhatHdf5WritesHasNone) {
  for (const auto& [name, type] : types()) {
    if (name != "texts") {  // In memory they are pointers; CheckObjectTest has them in a file.
      EXPECT_EQ(datatype_fault(message_of_type(type)), "") << name;
    }
  }
}

TEST(DatatypeFaultTest, WhatIsCutHasOne) {
  for (const auto& [name, type] : types()) {
    const std::vector<char> whole = message_of_type(type);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      EXPECT_NE(datatype_fault(std::span(whole).first(length)), "") << name << ", " << length;
    }
  }
}

// Whatever a byte is: a fault or none, within the message. The address sanitizer would see more.
TEST(DatatypeFaultTest, ChangedBytesAreReadWithinTheMessage) {
  int faults = 0;
  for (const auto& [name, type] : types()) {
    std::vector<char> bytes = message_of_type(type);
    for (char& byte : bytes) {
      const char before = byte;
      for (int value = 0; value < 256; ++value) {
        byte = static_cast<char>(value);
        faults += datatype_fault(bytes).empty() ? 0 : 1;
      }
      byte = before;
    }
  }
  EXPECT_GT(faults, 1000);
}

TEST(DatatypeFaultTest, PartsMustFit) {
  // An integer of 2 bytes that begins at bit 5 of 16: 5 + 16 bits. Class and version, 3 bytes, size, offset, precision.
  std::vector<char> integer = {0x10, 0, 0, 0, 2, 0, 0, 0, 5, 0, 16, 0};
  EXPECT_EQ(datatype_fault(integer), "a number has more bits than its type");
  integer[8] = 0;
  EXPECT_EQ(datatype_fault(integer), "");
  integer[7] = 1;
  EXPECT_EQ(datatype_fault(integer), "a number has more than 64 bytes");
  integer[7] = 0;
  integer[4] = 0;
  EXPECT_EQ(datatype_fault(integer), "its type has no size");
  // An enumeration of a word "ab" whose numbers have 2 bytes, and itself 4.
  std::vector<char> words = {0x18, 1, 0, 0,  4, 0,   0,   0, 0x10, 0, 0, 0, 2, 0, 0,
                             0,    0, 0, 16, 0, 'a', 'b', 0, 0,    0, 0, 0, 0, 7, 0};
  EXPECT_EQ(datatype_fault(words), "its words are not numbers of their type");
  words[4] = 2;
  EXPECT_EQ(datatype_fault(words), "");
  // Lists of lists of lists ...
  std::vector<char> deep;
  for (int i = 0; i < 9; ++i) {
    deep.insert(deep.end(), {0x19, 0, 0, 0, 16, 0, 0, 0});
  }
  EXPECT_EQ(datatype_fault(deep), "its type is nested too deeply");
}

TEST(CheckObjectTest, PassesDatasetsOfAllTypesAndTheirAttributes) {
  const WorkingFolder folder;
  {
    const H5Handle file(H5Fcreate("a.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    const hsize_t length = 2;
    const H5Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
    for (const auto& [name, type] : types()) {
      const H5Handle set(
          H5Dcreate2(file.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
          H5Dclose);
      const H5Handle note(H5Acreate2(set.get(), "note", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      ASSERT_TRUE(set && note) << name;
    }
  }
  const H5Handle file = h5_open_to_read("a.h5");
  for (const auto& [name, type] : types()) {
    EXPECT_EQ(message_of([&] { check_object(file.get(), name, "a.h5"); }), "no error") << name;
  }
}

}  // namespace
}  // namespace insonify::hdf5_type_test
