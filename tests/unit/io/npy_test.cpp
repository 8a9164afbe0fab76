// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/npy.hpp>

#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/io/npz.hpp>

#include "message_of.hpp"
#include "temporary_folder.hpp"
#include "unit/io/reference_files.hpp"

namespace vantage {
namespace {

using test::reference_file;

std::string text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(Npy, FormatOneZero) {
  Image<double> values(2, 3);
  values << 1, 2, 3, 4, 5, 6.5;
  const std::string bytes = text(encode_npy(values));
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t header = static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + header) % 64, 0u);  // numpy asks for data on a multiple of 64 bytes
  const std::string dictionary = bytes.substr(10, header);
  EXPECT_EQ(dictionary.substr(0, dictionary.find(')')), "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3");
  EXPECT_EQ(dictionary.back(), '\n');
  ASSERT_EQ(bytes.size(), 10 + header + 6 * sizeof(double));
  double read[6];
  std::memcpy(read, bytes.data() + 10 + header, sizeof read);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(read[i], values.data()[i]);
}

TEST(Npy, AnEmptyRasterHasAHeaderOnly) { EXPECT_EQ(encode_npy(Image<double>(0, 5)).size() % 64, 0u); }

// What numpy wrote; see reference_files.hpp.
TEST(Npy, ReadsWhatNumpyWrote) {
  const auto quarter = decode_npy(reference_file("npy_f32"), "a").image<float>("a");
  const auto eighth = decode_npy(reference_file("npy_f64_fortran"), "a").image<double>("a");
  const auto big = decode_npy(reference_file("npy_big_endian"), "a").image<double>("a");
  const auto bytes = decode_npy(reference_file("npy_v2"), "a").image<std::uint8_t>("a");
  for (const auto& size : {quarter.rows(), eighth.rows(), big.rows(), bytes.rows()}) ASSERT_EQ(size, 2);
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      const int value = 3 * row + column;
      EXPECT_EQ(quarter(row, column), static_cast<float>(value) / 4);
      EXPECT_EQ(eighth(row, column), value / 8.0);
      EXPECT_EQ(big(row, column), value);
      EXPECT_EQ(bytes(row, column), value);
    }
  const Tensor cube = decode_npy(reference_file("npy_i16_3d"), "a");
  EXPECT_EQ(cube.shape, (std::vector<std::size_t>{2, 3, 4}));
  const std::vector<int> values = cube.values<int>("a");
  for (int i = 0; i < 24; ++i) EXPECT_EQ(values[static_cast<std::size_t>(i)], i - 12);
  const Tensor scalar = decode_npy(reference_file("npy_bool_scalar"), "a");
  EXPECT_TRUE(scalar.shape.empty());
  EXPECT_EQ(scalar.values<int>("a"), std::vector<int>{1});
}

// Ours is numpy's, byte by byte.
TEST(Npy, WritesWhatNumpyWrites) {
  for (const char* name : {"npy_f32", "npy_i16_3d", "npy_bool_scalar"})
    EXPECT_EQ(text(encode_npy(decode_npy(reference_file(name), name))), reference_file(name)) << name;
  EXPECT_NE(text(encode_npy(Tensor::of<int>({1, 2}, {2}))).find("'shape': (2,), }"), std::string::npos);
}

TEST(Npy, EveryTypeComesBack) {
  const auto round_trip = [](auto sample) {
    const std::vector<decltype(sample)> values = {sample, 0, 1, 100};
    const Tensor again = decode_npy(text(encode_npy(Tensor::of(values, {2, 1, 2}))), "a");
    EXPECT_EQ(again.values<decltype(sample)>("a"), values);
    EXPECT_EQ(again.shape, (std::vector<std::size_t>{2, 1, 2}));
  };
  round_trip(std::int8_t{-128});
  round_trip(std::int16_t{-32768});
  round_trip(std::int32_t{-5});
  round_trip(std::numeric_limits<std::int64_t>::min());
  round_trip(std::uint8_t{255});
  round_trip(std::uint16_t{65535});
  round_trip(std::uint32_t{4000000000});
  round_trip(std::numeric_limits<std::uint64_t>::max());
  round_trip(1.5F);
  round_trip(1e300);
}

TEST(Npy, NamesTheByteWhereATruncatedFileEnds) {
  for (const char* name : {"npy_f32", "npy_f64_fortran"}) {
    const std::string whole = reference_file(name);
    for (std::size_t size = 6; size < whole.size(); ++size)
      EXPECT_REFUSED(decode_npy(whole.substr(0, size), "a.npy"), concat("a.npy: ends at byte ", size));
  }
}

TEST(Npy, RefusesWhatIsNoArrayOfNumbers) {
  const auto with_header = [](const std::string& header) {
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header +
           std::string(64, '\0');
  };
  EXPECT_REFUSED(decode_npy(reference_file("npy_objects"), "a"), "values of type '|O' at byte");
  EXPECT_REFUSED(decode_npy("PK\3\4", "a"), "no npy file");
  EXPECT_REFUSED(decode_npy(reference_file("npy_f32") + "x", "a"), "1 bytes after the last value at byte 128");
  EXPECT_REFUSED(
      decode_npy(with_header("{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296), }"), "a"),
      "a shape of more values than there are bytes");
  EXPECT_REFUSED(
      decode_npy(with_header("{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999,), }"), "a"),
      "expected a size");
  EXPECT_REFUSED(decode_npy(with_header("{'descr': '<f8', 'fortran_order': 0, 'shape': (8,), }"), "a"),
                 "True or False");
  EXPECT_REFUSED(decode_npy(with_header("{'descr': '<f8', 'shape': (8,), }"), "a"), "a header that lacks a key");
  EXPECT_REFUSED(decode_npy(with_header("{'shape': (8,), 'shape': (8,)}"), "a"), "key 'shape'");
  EXPECT_REFUSED(decode_npy(with_header("{'descr': '<f8"), "a"), "a quote is not closed");
  EXPECT_REFUSED(decode_npy(reference_file("npy_f32"), "a", {.bytes = 20}), "at most 20");
}

TEST(Tensor, RefusesNumbersThatATypeCannotHold) {
  EXPECT_REFUSED(Tensor::of<int>({1, 300}, {2}).values<std::uint8_t>("weights"), "weights: value 1 is 300");
  EXPECT_REFUSED(Tensor::of<double>({1.5}, {1}).values<int>("a"), "value 0 is 1.5");
  EXPECT_REFUSED(Tensor::of<double>({-1}, {1}).values<std::uint16_t>("a"), "value 0 is -1");
  EXPECT_REFUSED(Tensor::of<double>({std::nan("")}, {1}).values<int>("a"), "value 0 is nan");
  EXPECT_REFUSED(Tensor::of<double>({9223372036854775808.0}, {1}).values<std::int64_t>("a"), "value 0");
  EXPECT_EQ(Tensor::of<double>({-9223372036854775808.0}, {1}).values<std::int64_t>("a")[0], INT64_MIN);
  EXPECT_REFUSED(Tensor::of<int>({1, 2}, {3}), "2 values for a shape of 3");
  EXPECT_REFUSED(Tensor::of<int>({1, 2}, {2}).image<int>("a"), "1 axes; expected two");
}

TEST(Npz, ReadsWhatNumpyWrote) {
  const Tensors stored = decode_npz(reference_file("npz_stored"), "a.npz");
  ASSERT_EQ(stored.size(), 2u);
  EXPECT_TRUE((stored.at("pose").image<double>("a") == Image<double>(Eigen::Matrix4d::Identity())).all());
  EXPECT_EQ(stored.at("ids").values<int>("a"), (std::vector<int>{0, 1, 2}));
  const Tensors deflated = decode_npz(reference_file("npz_deflated"), "a.npz");
  EXPECT_EQ(deflated.at("pose").image<float>("a")(2, 2), 1);
  EXPECT_EQ(deflated.at("zeros").size(), 1600u);
}

TEST(Npz, ComesBackAndRepeatsItself) {
  Tensors tensors;
  tensors["a"] = Tensor::of<float>({1, 2, 3}, {3});
  tensors["b/c"] = Tensor::of<std::uint16_t>({}, {0, 4});
  const test::TemporaryFolder folder;
  write_npz(folder.path() / "t.npz", tensors);
  const Tensors again = read_npz(folder.path() / "t.npz");
  ASSERT_EQ(again.size(), 2u);
  EXPECT_EQ(again.at("a").values<float>("a"), (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(again.at("b/c").shape, (std::vector<std::size_t>{0, 4}));
  EXPECT_EQ(encode_npz(again), encode_npz(tensors));
}

TEST(Npz, RefusesWhatIsTruncatedDamagedOrTooLarge) {
  const std::string whole = reference_file("npz_deflated");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_REFUSED(decode_npz(whole.substr(0, size), "a.npz"), concat("a.npz: ends at byte ", size));
  std::string damaged = reference_file("npz_stored");
  damaged[damaged.find("NUMPY") + 140] ^= 4;
  EXPECT_REFUSED(decode_npz(damaged, "a.npz"), "a damaged entry at byte");
  EXPECT_REFUSED(decode_npz(whole, "a.npz", {.bytes = 3000}), "bytes when unpacked");
  EXPECT_REFUSED(decode_npz(whole, "a.npz", {.tensors = 1}), "2 entries; expected at most 1");
  std::string bomb = whole;  // its directory says 4 GB - 2
  const std::size_t entry = bomb.find("PK\1\2");
  bomb.replace(entry + 24, 4, "\xFE\xFF\xFF\xFF");
  EXPECT_REFUSED(decode_npz(bomb, "a.npz", {.bytes = std::size_t{8} << 30}), "at most 1032 times as many");
}

}  // namespace
}  // namespace vantage
