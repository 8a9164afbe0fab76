// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <vantage/core/error.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/io/frame_pictures.hpp>

namespace vantage {

/// One frame of a recording: from where, with what camera, and where its pictures are.
struct RecordedFrame {
  View view;
  Camera camera;
  std::filesystem::path colour, depth, labels;               ///< empty: the sensor had no such channel
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not told
};

/// A sequence of posed pictures on disk. Small: poses and names are in memory, pictures are read when asked for.
class Recording {
 public:
  /// `where` names the recording in errors; `depth_unit_m` is what 1 means in an integer depth picture, > 0. Throws
  /// Error if there is no frame, a frame has no picture, a pose is not rigid, a camera is bad, or a picture is missing
  /// (named: the recording was cut short).
  Recording(std::string where, std::vector<RecordedFrame> frames, double depth_unit_m = 0.001,
            std::vector<std::string> notes = {})
      : where_(std::move(where)), frames_(std::move(frames)), depth_unit_m_(depth_unit_m), notes_(std::move(notes)) {
    Check check(where_);
    check.positive("depth_unit_m", depth_unit_m_);
    check.done();
    if (frames_.empty()) throw Error(where_, "the recording has no frame", "at least one");
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const RecordedFrame& f = frames_[i];
      const std::string name = concat(where_, " (frame ", i, ")");
      check_view(f.view, name);
      f.camera.validate(name);
      if (f.colour.empty() && f.depth.empty()) throw Error(name, "neither colour nor depth", "a picture");
      for (const std::filesystem::path* file : {&f.colour, &f.depth, &f.labels})
        if (std::error_code e; !file->empty() && !std::filesystem::is_regular_file(*file, e))
          throw Error(name, concat("there is no file ", file->string()), "all pictures that the recording lists");
    }
  }

  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] std::size_t size() const { return frames_.size(); }
  [[nodiscard]] const std::vector<RecordedFrame>& frames() const { return frames_; }
  [[nodiscard]] double depth_unit_m() const { return depth_unit_m_; }
  /// What a reader had to leave out or assume, a sentence each.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// The pose of each frame.
  [[nodiscard]] std::vector<View> views() const {
    std::vector<View> out;
    out.reserve(frames_.size());
    for (const RecordedFrame& f : frames_) out.push_back(f.view);
    return out;
  }
  /// Reads the pictures of a frame. A depth of 0 is no value. Throws Error, naming the file, if one cannot be read, is
  /// of another kind or not of the camera's size. Const members may run concurrently.
  [[nodiscard]] Frame frame(std::size_t index) const {
    if (index >= frames_.size()) throw Error(where_, concat("frame ", index), concat("below ", frames_.size()));
    const RecordedFrame& f = frames_[index];
    Frame out{f.camera, f.view, {}, {}, {}};
    if (!f.colour.empty()) out.colour = read_colour(f.colour, f.camera);
    if (!f.depth.empty()) out.depth = read_depth(f.depth, f.camera, depth_unit_m_);
    if (!f.labels.empty()) out.labels = read_labels(f.labels, f.camera);
    return out;
  }

 private:
  std::string where_;
  std::vector<RecordedFrame> frames_;
  double depth_unit_m_;
  std::vector<std::string> notes_;
};

/// The view of a 4 x 4 matrix of camera points to world points, whose rotation was rounded when it was written: the
/// nearest rotation. Throws Error if it is not finite, its last row is not 0 0 0 1, or it is no rotation to 1e-3.
inline View rigid_view(const Eigen::Matrix4d& T, std::string_view where) {
  if (!T.allFinite()) throw Error(where, "the pose is not finite", "finite numbers");
  if ((T.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-6)
    throw Error(where, concat("the pose's last row is ", T.row(3)), "0 0 0 1");
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  if ((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 1e-3 || R.determinant() < 0)
    throw Error(where, "the pose is no rigid transform", "a rotation with determinant 1 (to 1e-3) and a translation");
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  View view;
  view.T_W_C.linear() = svd.matrixU() * svd.matrixV().transpose();
  view.T_W_C.translation() = T.topRightCorner<3, 1>();
  return view;
}

/// The same of a unit quaternion, rounded when it was written, and a translation. Throws Error if the quaternion's
/// length is not 1 (to 1e-2).
inline Eigen::Isometry3d rigid_transform(const Eigen::Quaterniond& q, const Eigen::Vector3d& t,
                                         std::string_view where) {
  if (!(std::abs(q.norm() - 1) <= 1e-2))
    throw Error(where, concat("a quaternion of length ", q.norm()), "1: a rotation");
  return Eigen::Translation3d(t) * q.normalized();
}

}  // namespace vantage
