// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vantage/io/npy.hpp>

namespace {

using namespace vantage;

TEST(Npy, FormatOneZero) {
  Image<double> values(2, 3);
  values << 1, 2, 3, 4, 5, 6.5;
  const std::vector<std::byte> bytes = encode_npy(values);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_EQ(text.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t header = static_cast<unsigned char>(text[8]) + 256u * static_cast<unsigned char>(text[9]);
  EXPECT_EQ((10 + header) % 64, 0u);  // numpy asks for data on a multiple of 64 bytes
  const std::string dictionary = text.substr(10, header);
  EXPECT_EQ(dictionary.substr(0, dictionary.find(')')), "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3");
  EXPECT_EQ(dictionary.back(), '\n');
  ASSERT_EQ(bytes.size(), 10 + header + 6 * sizeof(double));
  double read[6];
  std::memcpy(read, bytes.data() + 10 + header, sizeof read);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(read[i], values.data()[i]);
}

TEST(Npy, AnEmptyRasterHasAHeaderOnly) {
  const std::vector<std::byte> bytes = encode_npy(Image<double>(0, 5));
  EXPECT_EQ(bytes.size() % 64, 0u);
}

}  // namespace
