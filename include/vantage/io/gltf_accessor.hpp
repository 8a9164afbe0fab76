// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <tiny_gltf.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <vantage/core/error.hpp>

namespace vantage {

/// The numbers of a glTF accessor, bounds checked once.
class GltfAccessor {
 public:
  GltfAccessor(const tinygltf::Model& model, int index, const std::string& where)
      : where_(concat(where, ": accessor ", index)) {
    if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size())
      throw Error(where_, "there is none of this index", concat("below ", model.accessors.size()));
    const tinygltf::Accessor& a = model.accessors[static_cast<std::size_t>(index)];
    if (a.sparse.isSparse) throw Error(where_, "it is sparse", "all of its values in a buffer view");
    if (a.bufferView < 0 || static_cast<std::size_t>(a.bufferView) >= model.bufferViews.size())
      throw Error(where_, concat("buffer view ", a.bufferView), concat("below ", model.bufferViews.size()));
    const tinygltf::BufferView& v = model.bufferViews[static_cast<std::size_t>(a.bufferView)];
    if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= model.buffers.size())
      throw Error(where_, concat("buffer ", v.buffer), concat("below ", model.buffers.size()));
    const std::vector<unsigned char>& bytes = model.buffers[static_cast<std::size_t>(v.buffer)].data;
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.componentType));
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type));
    if (size < 1 || components < 1 || components > 4)
      throw Error(where_, "a type that is not known", "scalars or vectors of numbers");
    type_ = a.componentType;
    normalised_ = a.normalized;
    components_ = static_cast<std::size_t>(components);
    component_bytes_ = static_cast<std::size_t>(size);
    const std::size_t element = components_ * component_bytes_;
    stride_ = v.byteStride == 0 ? element : v.byteStride;
    count_ = a.count;
    // The view within the buffer, then the elements within the view.
    if (v.byteOffset > bytes.size() || v.byteLength > bytes.size() - v.byteOffset)
      throw Error(where_, concat("its view ends at byte ", v.byteOffset, " + ", v.byteLength, " of a buffer"),
                  concat("at most ", bytes.size()));
    if (stride_ < element || stride_ > 65536)
      throw Error(where_, concat("a stride of ", stride_, " bytes"), concat(element, " or more"));
    if (count_ == 0 || a.byteOffset > v.byteLength || element > v.byteLength - a.byteOffset ||
        (count_ - 1) > (v.byteLength - a.byteOffset - element) / stride_)
      throw Error(where_, concat(count_, " elements of ", stride_, " bytes from byte ", a.byteOffset),
                  concat("1 or more within ", v.byteLength, " bytes"));
    data_ = bytes.data() + v.byteOffset + a.byteOffset;
  }

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] std::size_t components() const { return components_; }
  /// A whole number, of an index accessor.
  [[nodiscard]] std::uint32_t index(std::size_t element) const {
    const unsigned char* p = data_ + element * stride_;
    if (type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *p;
    if (type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load<std::uint16_t>(p);
    if (type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return load<std::uint32_t>(p);
    throw Error(where_, concat("indices of component type ", type_), "unsigned byte, short or int");
  }
  /// A number; of normalised integers, in [0, 1] or [-1, 1] (glTF 2.0, 3.11).
  [[nodiscard]] float number(std::size_t element, std::size_t component) const {
    const unsigned char* p = data_ + element * stride_ + component * component_bytes_;
    const auto scaled = [&](float value, float most) { return normalised_ ? std::max(value / most, -1.0F) : value; };
    switch (type_) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return scaled(load<std::int8_t>(p), 127);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return scaled(*p, 255);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return scaled(load<std::int16_t>(p), 32767);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return scaled(load<std::uint16_t>(p), 65535);
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return load<float>(p);
      default:
        throw Error(where_, concat("numbers of component type ", type_), "bytes, shorts or floats");
    }
  }

 private:
  template <class T>
  static T load(const unsigned char* p) {
    T value;
    std::memcpy(&value, p, sizeof value);
    return value;
  }
  std::string where_;
  const unsigned char* data_ = nullptr;
  int type_ = 0;
  bool normalised_ = false;
  std::size_t components_ = 0, component_bytes_ = 0, stride_ = 0, count_ = 0;
};

}  // namespace vantage
