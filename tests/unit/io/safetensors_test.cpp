// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/safetensors.hpp>

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace vantage {
namespace {

// As the format's own description lays a file out.
std::string file(const std::string& header, const std::string& data) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>(header.size() >> (8 * i)));
  return bytes + header + data;
}

TEST(Safetensors, ReadsAFileMadeByHand) {
  const std::string header =
      R"({"__metadata__":{"format":"pt"},"w":{"dtype":"F32","shape":[2,1],"data_offsets":[0,8]},)"
      R"("h":{"dtype":"F16","shape":[2],"data_offsets":[8,12]},)"
      R"("b":{"dtype":"BF16","shape":[],"data_offsets":[12,14]}}  )";
  using namespace std::string_literals;
  const Safetensors f = decode_safetensors(file(header, "\0\0\x80\x3F\0\0\0\xC0\0\x3C\x01\0\x80\x3F"s), "a");
  EXPECT_EQ(f.metadata.at("format"), "pt");
  EXPECT_EQ(f.tensors.at("w").values<float>("w"), (std::vector<float>{1, -2}));
  EXPECT_EQ(f.tensors.at("h").values<double>("h"), (std::vector<double>{1, 0x1p-24}));  // the smallest half
  EXPECT_EQ(f.tensors.at("b").values<float>("b"), std::vector<float>{1});
}

TEST(Safetensors, ComesBackAndRepeatsItself) {
  Safetensors f;
  f.metadata["made by"] = "test";
  f.tensors["layer.0"] = Tensor::of<float>({1, 2, 3, 4}, {2, 2});
  f.tensors["ids"] = Tensor::of<std::int64_t>({-1, 7}, {2});
  f.tensors["none"] = Tensor::of<double>({}, {0, 3});
  const test::TemporaryFolder folder;
  write_safetensors(folder.path() / "w.safetensors", f);
  const Safetensors again = read_safetensors(folder.path() / "w.safetensors");
  EXPECT_EQ(again.metadata, f.metadata);
  ASSERT_EQ(again.tensors.size(), 3u);
  EXPECT_EQ(again.tensors.at("layer.0").image<float>("a")(1, 0), 3);
  EXPECT_EQ(again.tensors.at("ids").values<int>("a"), (std::vector<int>{-1, 7}));
  EXPECT_EQ(again.tensors.at("none").shape, (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(encode_safetensors(again), encode_safetensors(f));
  f.tensors["\xFF"] = Tensor::of<int>({1}, {1});
  EXPECT_REFUSED(encode_safetensors(f), "no text");
}

TEST(Safetensors, NamesTheByteWhereATruncatedFileEnds) {
  const std::string whole = file(R"({"w":{"dtype":"U8","shape":[4],"data_offsets":[0,4]}})", "abcd");
  EXPECT_EQ(decode_safetensors(whole, "a").tensors.size(), 1u);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_REFUSED(decode_safetensors(whole.substr(0, size), "a.st"), concat("a.st: ends at byte ", size));
}

TEST(Safetensors, RefusesPlacesThatDoNotFit) {
  const auto said = [](const std::string& header, const std::string& data) {
    return test::message_of([&] { return decode_safetensors(file(header, data), "a"); });
  };
  const auto holds = [](const std::string& all, std::string_view part) {
    EXPECT_NE(all.find(part), std::string::npos) << "'" << all << "'";
  };
  holds(said(R"({"w":{"dtype":"F32","shape":[2],"data_offsets":[0,4]}})", "abcd"),
        "/w/data_offsets: 4 bytes; expected 8");
  holds(said(R"({"w":{"dtype":"U8","shape":[2],"data_offsets":[4,2]}})", "abcd"), "/w/data_offsets/0: 4");
  holds(said(R"({"w":{"dtype":"U8","shape":[2],"data_offsets":[2,4]}})", "abcd"), "leave a hole at byte");
  holds(
      said(
          R"({"v":{"dtype":"U8","shape":[3],"data_offsets":[0,3]},"w":{"dtype":"U8","shape":[2],"data_offsets":[2,4]}})",
          "abcd"),
      "overlap");
  holds(said(R"({"w":{"dtype":"U8","shape":[2],"data_offsets":[0,2]}})", "abcd"), "2 bytes after the last tensor");
  holds(said(R"({"w":{"dtype":"F4","shape":[2],"data_offsets":[0,2]}})", "ab"), "/w/dtype: type 'F4'");
  holds(said(R"({"w":{"dtype":"U8","shape":[281474976710656,281474976710656],"data_offsets":[0,2]}})", "ab"),
        "a shape of more values than there are bytes");
  holds(said(R"({"w":{"dtype":"U8","shape":[-2],"data_offsets":[0,2]}})", "ab"), "/w/shape/0: -2");
  holds(said(R"({"w":{"dtype":"U8","shape":[2]}})", "ab"), "/w: no 'data_offsets'");
  holds(said(R"({"w":[]})", ""), "/w: a value of kind array; expected an object");
  holds(said(R"({"w":{{)", ""), "header:1: ends at byte 7");
  holds(said("[[[[[[1]]]]]]", ""), "nested deeper than 4 at byte 4");
  EXPECT_REFUSED(decode_safetensors(std::string(8, '\xFF'), "a"), "at most 100 MB");
}

}  // namespace
}  // namespace vantage
