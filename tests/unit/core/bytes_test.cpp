// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <vantage/core/bytes.hpp>

namespace vantage {
namespace {

enum class Fruit : std::uint16_t { apple = 1, pear = 258 };

TEST(Bytes, WhatGoesInComesOut) {
  Sink sink;
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(3, 4);
  const Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> image =
      Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>::Random(5, 2);
  sink.put(std::uint8_t{200});
  sink.put(-1.5);
  sink.put(Fruit::pear);
  sink.put(true);
  sink.put(std::vector<int>{1, -2, 3});
  sink.put(std::vector<double>{});
  sink.put("text with \0 inside");
  sink.put(matrix);
  sink.put(image);
  sink.put(std::numeric_limits<double>::quiet_NaN());

  Source source(sink.bytes());
  EXPECT_EQ(source.get<std::uint8_t>(), 200);
  EXPECT_EQ(source.get<double>(), -1.5);
  EXPECT_EQ(source.get<Fruit>(), Fruit::pear);
  EXPECT_TRUE(source.get<bool>());
  std::vector<int> ints = {9, 9};
  source.get(ints);
  EXPECT_EQ(ints, (std::vector<int>{1, -2, 3}));
  std::vector<double> doubles = {1};
  source.get(doubles);
  EXPECT_TRUE(doubles.empty());
  std::string text;
  source.get(text);
  EXPECT_EQ(text, "text with ");
  Eigen::MatrixXd m;
  source.get(m);
  EXPECT_EQ(m, matrix);
  Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> i;
  source.get(i);
  EXPECT_TRUE((i == image).all());
  EXPECT_TRUE(std::isnan(source.get<double>()));
  EXPECT_EQ(source.left(), 0u);
  EXPECT_NO_THROW(source.done());
}

TEST(Bytes, AreLittleEndian) {
  Sink sink;
  sink.put(std::uint32_t{0x01020304});
  ASSERT_EQ(sink.bytes().size(), 4u);
  EXPECT_EQ(sink.bytes()[0], std::byte{4});
  EXPECT_EQ(sink.bytes()[3], std::byte{1});
}

TEST(Bytes, EveryCutIsNoticed) {
  Sink sink;
  sink.put(3.0);
  sink.put(std::vector<int>{1, 2, 3});
  sink.put(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  const auto read = [](Source& source) {
    (void)source.get<double>();
    std::vector<int> v;
    source.get(v);
    Eigen::MatrixXd m;
    source.get(m);
    source.done();
  };
  for (std::size_t n = 0; n < sink.bytes().size(); ++n) {
    Source cut(sink.bytes().first(n), "the file");
    EXPECT_THROW(read(cut), Error) << n;
  }
  Source whole(sink.bytes());
  EXPECT_NO_THROW(read(whole));
}

TEST(Bytes, HostileSizesAllocateNothing) {
  const auto source_of = [](auto... words) {
    Sink sink;
    (sink.put(static_cast<std::uint64_t>(words)), ...);
    return std::move(sink).take();
  };
  const std::uint64_t huge = ~std::uint64_t{0};
  std::vector<double> v;
  std::string text;
  Eigen::MatrixXd m;
  for (const auto& bytes : {source_of(huge), source_of(std::uint64_t{1} << 61), source_of(2, 1)}) {
    Source a(bytes);
    EXPECT_THROW(a.get(v), Error);
  }
  for (const auto& bytes : {source_of(huge, huge), source_of(std::uint64_t{1} << 32, std::uint64_t{1} << 32),
                            source_of(huge, 0), source_of(0, huge), source_of(2, 2, 0, 0, 0)}) {
    Source a(bytes);
    EXPECT_THROW(a.get(m), Error);
  }
  const auto long_text = source_of(9, 0);
  Source a(long_text);
  EXPECT_THROW(a.get(text), Error);
}

TEST(Bytes, ErrorsNameTheSourceAndTheByte) {
  const std::vector<std::byte> four(4);
  Source source(four, "mission.checkpoint");
  try {
    (void)source.get<double>();
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("mission.checkpoint"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("byte 4"), std::string::npos);
  }
  EXPECT_THROW(source.done(), Error);
}

TEST(Bytes, WhatAPartSavesIsAVector) {
  struct Part {
    void save(Sink& sink) const { sink.put(std::uint32_t{7}); }
  };
  Sink sink;
  sink.put_saved(Part{});
  sink.put(true);
  Source copied(sink.bytes()), in_place(sink.bytes());
  std::vector<std::byte> bytes;
  copied.get(bytes);
  ASSERT_EQ(bytes.size(), 4U);
  EXPECT_TRUE(std::ranges::equal(in_place.get_bytes(), bytes));
  EXPECT_EQ(in_place.left(), 1U);
  EXPECT_THROW((void)in_place.get_bytes(), Error);
}

TEST(Bytes, Fnv1aIsFnv1a) {  // the published vectors
  EXPECT_EQ(fnv1a({}), 0xcbf29ce484222325ull);
  const char a = 'a';
  EXPECT_EQ(fnv1a(std::as_bytes(std::span(&a, 1))), 0xaf63dc4c8601ec8cull);
  const std::string foobar = "foobar";
  EXPECT_EQ(fnv1a(std::as_bytes(std::span(foobar))), 0x85944171f73967e8ull);
}

}  // namespace
}  // namespace vantage
